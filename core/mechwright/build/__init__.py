"""From a design to files: what is made of it, each thing once, and what judges and shows it."""

from mechwright.build.build import Build, Wanted
from mechwright.build.inspection import Inspection
from mechwright.build.page import FileName, Page
from mechwright.build.run import Run
from mechwright.build.stock import Blank, RawStock
from mechwright.build.work import LOOK, PROGRAMS, SOLIDS, WORK, Work, work_to

__all__ = [
    "LOOK",
    "PROGRAMS",
    "SOLIDS",
    "WORK",
    "Blank",
    "Build",
    "FileName",
    "Inspection",
    "Page",
    "RawStock",
    "Run",
    "Wanted",
    "Work",
    "work_to",
]
