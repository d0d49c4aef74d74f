"""The setup sheet: an HTML page that a machinist prints and takes to the mill."""

from mechwright_cam.setup_sheet.sheet import setup_html

__all__ = ["setup_html"]
