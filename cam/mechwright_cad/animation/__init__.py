"""The moving mechanism as one page for a browser, of any family: from parts, instances and motion alone."""

from mechwright_cad.animation.page import MOTION, motion_html
from mechwright_cad.animation.scene import PAGE_SAMPLES

__all__ = ["MOTION", "PAGE_SAMPLES", "motion_html"]
