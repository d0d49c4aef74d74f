"""Setup sheets: HTML pages that a machinist prints and takes to the mill, and one of the whole job."""

from mechwright_cam.pages.setup_sheet.sheet import setup_html
from mechwright_cam.pages.setup_sheet.summary import SHEET, summary_html

__all__ = ["SHEET", "setup_html", "summary_html"]
