"""Programs of touches, read back word by word: they may do little, and all else is refused by name."""

import re
from abc import ABC, abstractmethod

from mechwright.designs.inches import FACTORS
from mechwright.errors import ProofError
from mechwright_cam.controls.contract import Control
from mechwright_cam.proof.scene import ROUNDED
from mechwright_cam.setup.job import Job

MODES = frozenset({"G17", "G20", "G21", "G40", "G49", "G61", "G80", "G90", "G91", "G91.1", "G94", "M5", "M9"})
NEEDED = ("G40", "G49", "G80", "G90", "G94", "M5")
"""What has to be said before anything moves."""
FEED_ROUNDED = 0.051
"""Feeds have one decimal of their unit."""
ROOM = 2.0
"""Between tip and setter, or stock, where a rapid ends, where both heights are known, mm."""


class ByWords(ABC):
    """One program, line by line; lengths in mm."""

    def __init__(self, name: str, job: Job, control: Control) -> None:
        self.name, self.job, self.control = name, job, control
        self.top = control.upper_end(job.settings.machine)
        self.scale, self.said = 1.0, set[str]()
        self.ended, self.number = False, 0

    def read(self, text: str) -> None:
        """Obey all lines; raises ProofError for the first that is none of such a program's, or has no end."""
        for number, line in enumerate(text.splitlines(), start=1):
            self.number = number
            code = re.sub(r"\([^()]*\)", "", line).replace(" ", "")
            if code and self.ended:
                raise self.bad("stands behind the end of the program; take it out")
            if code:
                self.obey(code)
        self.finish()

    def check_ends(self, axis: str, value: float) -> None:
        """Refuse a machine coordinate of an axis, mm, that lies outside of its travel."""
        low, high = self.job.settings.machine.ends(axis.lower())
        if not low - ROUNDED <= value <= high + ROUNDED:
            raise self.bad(f"goes to machine {axis} {value:g}, and {axis} travels from {low:g} to {high:g}")

    def bad(self, why: str) -> ProofError:
        """The error of the line that is read."""
        return ProofError(f"{self.name}: line {self.number}: {why}")

    @abstractmethod
    def obey(self, code: str) -> None:
        """Obey a line without its comments and blanks, or refuse it."""

    def finish(self) -> None:
        """Refuse a program that does not end."""
        if not self.ended:
            raise self.bad("the program has no end; write M30")

    def modes(self, names: list[str]) -> None:
        """Words of state."""
        self.said |= set(names)
        for one, other in (("G90", "G91"), ("G91", "G90")):
            if one in names:
                self.said.discard(other)
        if {"G20", "G21"} & set(names):
            self.scale = FACTORS["mm"] if "G20" in names else 1.0

    def check_modes(self, missing: list[str]) -> None:
        """Refuse a move before words that it needs."""
        if missing:
            raise self.bad(f"moves before {' '.join(missing)}")

    def check_up(self, what: str, *, up: bool) -> None:
        """Refuse what is done elsewhere than at the machine's upper end."""
        if not up:
            raise self.bad(f"{what} below machine Z {self.top:g}; retract first")
