"""The moving mechanism as one page for a browser, of any family: from parts, instances and motion alone."""

from mechwright_cad.animation.page import MOTION, motion_html, page_of

__all__ = ["MOTION", "motion_html", "page_of"]
