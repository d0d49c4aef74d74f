"""From a design to files: what is made of it, each thing once, and what judges and shows it."""

from mechwright.pipeline.build import Build, Wanted
from mechwright.pipeline.inspection import Inspection
from mechwright.pipeline.page import FileName, Page
from mechwright.pipeline.run import Run
from mechwright.pipeline.stock import Blank, Feedstock, RawStock
from mechwright.pipeline.work import LOOK, PROGRAMS, SOLIDS, WORK, Work, work_to

__all__ = [
    "LOOK",
    "PROGRAMS",
    "SOLIDS",
    "WORK",
    "Blank",
    "Build",
    "Feedstock",
    "FileName",
    "Inspection",
    "Page",
    "RawStock",
    "Run",
    "Wanted",
    "Work",
    "work_to",
]
