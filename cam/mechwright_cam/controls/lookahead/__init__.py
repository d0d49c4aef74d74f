"""How controls run through the moves of a program: how fast, and how far off the programmed path."""

from mechwright_cam.controls.lookahead.contract import Lookahead, Motion
from mechwright_cam.controls.lookahead.default import DEFAULT_LOOKAHEAD

__all__ = ["DEFAULT_LOOKAHEAD", "Lookahead", "Motion"]
