"""The page of the parts as made: their outlines drawn and kept, and what the mechanism does with them."""

from mechwright_cam.pages.as_made.page import AsMadeFiles

__all__ = ["AsMadeFiles"]
