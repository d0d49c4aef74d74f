"""Building: what is made of a design, each thing once, and the contracts of what judges and shows it."""

from mechwright.build.build import Build, Wanted
from mechwright.build.inspection import Inspection
from mechwright.build.page import FileName, Page
from mechwright.build.stock import Blank, RawStock

__all__ = ["Blank", "Build", "FileName", "Inspection", "Page", "RawStock", "Wanted"]
