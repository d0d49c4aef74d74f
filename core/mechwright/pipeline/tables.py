"""The motion as tables."""

import io
import json
from collections.abc import Iterable, Iterator

import numpy as np

from mechwright.contracts.motion import Motion
from mechwright.pipeline.build import Build, Wanted
from mechwright.pipeline.page import FileName, Page

TABLE, SUMMARY = "motion.csv", "summary.json"
"""The files."""

DIGITS = "%.10g"
"""Of numbers in both: the last digits that a sum of sines has are those of the processor."""

NOTHING = 1e-15
"""A figure below this is what rounding leaves of 0, whatever its unit."""

ROWS = 1_000
"""Rows of a table that are written together."""


class MotionTables(Page):
    """``motion.csv`` and ``summary.json``."""

    name = "motion-tables"
    commands = frozenset({"solve", "build"})
    doing = "motion"

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """Both files."""
        return (
            [FileName(name, "the motion") for name in (TABLE, SUMMARY)] if build.design.family.moves else []
        )

    def files(self, build: Build) -> dict[str, str | Iterable[bytes]]:
        """The channels over the motion and its figures by name with units; none of what stands still."""
        if not build.design.family.moves:
            return {}
        stretches = build.stretches()
        first = next(stretches)
        figures = {
            name: {"value": shown(scalar.value), "unit": scalar.unit}
            for name, scalar in first.scalars.items()
        }
        return {
            TABLE: motion_csv(first, stretches),
            SUMMARY: json.dumps(figures, indent=2) + "\n",
        }


def shown(value: float) -> float:
    """A figure as the summary has it: ten significant digits.

    >>> shown(1 / 3), shown(-2.1e-18), shown(2e-9)
    (0.3333333333, 0.0, 2e-09)
    """
    return 0.0 if abs(value) < NOTHING else float(DIGITS % value)


def motion_csv(motion: Motion, more: Iterable[Motion] = ()) -> Iterator[bytes]:
    """The channels as CSV, one row per sample, ten significant digits, header ``name [unit]``.

    ``more`` are stretches that follow. The table comes in pieces: the text of a million samples takes more
    memory than the motion, and the motion more than a stretch.
    """
    yield (",".join(motion.arrays) + "\n").encode()
    yield from _rows(motion)
    del motion  # whoever asks for a stretch needs the memory of the one before
    for stretch in more:
        yield from _rows(stretch)


def _rows(motion: Motion) -> Iterator[bytes]:
    columns = list(motion.arrays.values())
    for first in range(0, motion.samples, ROWS):
        text = io.StringIO()
        table = np.column_stack([values[first : first + ROWS] for values in columns])
        np.savetxt(text, table, fmt=DIGITS, delimiter=",", comments="")
        yield text.getvalue().encode()
