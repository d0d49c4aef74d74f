"""The motion as tables."""

import io
import json
from collections.abc import Iterable, Iterator

import numpy as np

from mechwright.build.build import Build
from mechwright.build.page import Page
from mechwright.contracts.motion import Motion

ROWS = 1_000
"""Rows of a table that are written together."""


class MotionTables(Page):
    """``motion.csv`` and ``summary.json``."""

    name = "motion-tables"
    commands = frozenset({"solve", "build"})
    doing = "motion"

    def files(self, build: Build) -> dict[str, str | Iterable[bytes]]:
        """The channels over the motion and its figures by name with units; none of what stands still."""
        if not build.design.family.moves:
            return {}
        scalars = build.motion.scalars.items()
        figures = {name: {"value": scalar.value, "unit": scalar.unit} for name, scalar in scalars}
        return {"motion.csv": motion_csv(build.motion), "summary.json": json.dumps(figures, indent=2) + "\n"}


def motion_csv(motion: Motion) -> Iterator[bytes]:
    """The channels as CSV, one row per sample, twelve significant digits, header ``name [unit]``.

    It comes in pieces: the text of a million samples takes more memory than the motion.
    """
    yield (",".join(motion.arrays) + "\n").encode()
    columns = list(motion.arrays.values())
    for first in range(0, motion.samples, ROWS):
        text = io.StringIO()
        table = np.column_stack([values[first : first + ROWS] for values in columns])
        np.savetxt(text, table, fmt="%.12g", delimiter=",", comments="")
        yield text.getvalue().encode()
