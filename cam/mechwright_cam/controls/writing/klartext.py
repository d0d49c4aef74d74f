"""Klartext blocks, of the words in which a program is walked through.

Glossary
--------
block
    A numbered line, with the lines that ``~`` joins to it.
CC
    Centre of the arcs that follow, and pole of polar coordinates.
CP
    Arc by its angle: with a height it is a helix, which has no other block.
"""

import math
import re
from decimal import Decimal

from mechwright_cam.controls.reading.arcs import rotated
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Program

FULL_TURN = Decimal(360)
ANGLE = Decimal("0.0001")
"""The last decimal of an angle, degrees."""
_WORD = re.compile(r"([GMTXYZIJF])(-?\d+(?:\.\d+)?)")


def signed(value: "Decimal | str") -> str:
    """A coordinate with its sign, as the control shows it.

    >>> signed("5"), signed("-0.25"), signed(Decimal("10.500"))
    ('+5', '-0.25', '+10.5')
    """
    text = f"{Decimal(value):f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    text = "0" if text in {"-0", ""} else text
    return text if text.startswith("-") else "+" + text


class KlartextWriter(Writer):
    """Writes each line of words as a block: ``G1 X5 F90`` as ``L X+5 F90``.

    Lines that are none of these words are blocks already. Every feed is stated anew behind a rapid, and every
    rapid has R0, so that a reader of any block knows both; every arc has its centre before it.
    """

    def __init__(self, program: Program, decimals: int, scale: float = 1.0) -> None:
        super().__init__(program, decimals, point=False, scale=scale)
        self._motion = ""
        self._feed = ""
        self._stated = False
        """Whether the block before has a feed in force that this one may leave out."""
        self._place: dict[str, Decimal | None] = dict.fromkeys("XYZ")
        self._real: tuple[float, float] | None = None
        """Where an arc by its angle has really ended, beside the place that the text knows; None if there."""

    def line(self, *words: str) -> None:
        """Write the block, or the blocks, of these words; empty ones are left out."""
        pieces = " ".join(filter(None, words)).split()
        found = [_WORD.fullmatch(piece) for piece in pieces]
        known = [match for match in found if match is not None]
        if not pieces:
            return
        if len(known) < len(pieces):
            super().line(*words)
            return
        codes = {(match[1], match[2]) for match in known if match[1] in "GM"}
        values = {match[1]: match[2] for match in known if match[1] not in "GM"}
        if "T" in values:
            super().line(f"TOOL DEF {values['T']}")
            return
        axes = {axis: Decimal(values[axis]) for axis in "XYZ" if axis in values}
        functions = [f"M{value}" for letter, value in sorted(codes) if letter == "M"]
        for letter, value in codes:
            if letter == "G" and value in {"0", "1", "2", "3"}:
                self._motion = f"G{value}"
        if not axes:
            super().line(*functions)
            return
        if ("G", "53") in codes:
            self._rapid(axes, "M91")
            self._place.update(dict.fromkeys(axes))
            return
        self._fed(axes, values) if self._motion != "G0" else self._rapid(self._in_full(axes), *functions)

    def lost_height(self) -> None:
        """The tool stands at the machine's upper end, whose z the text does not know."""
        super().lost_height()
        self._place["Z"] = None
        self._stated = False

    def lost_place(self) -> None:
        """The next section states place, motion and feed itself."""
        super().lost_place()
        self._place.update(X=None, Y=None)
        self._stated = False

    def _rapid(self, axes: dict[str, Decimal], *functions: str) -> None:
        self._place.update(axes)
        self._stated = False
        super().line("L", *(axis + signed(value) for axis, value in axes.items()), "R0", "FMAX", *functions)

    def _in_full(self, axes: dict[str, Decimal]) -> dict[str, Decimal]:
        """The axes, both of the plane where the last arc has ended beside its place and one moves."""
        if self._real is None or not {"X", "Y"} & set(axes):
            return axes
        self._real = None
        both = {axis: self._place[axis] for axis in "XY"}
        return {axis: value for axis, value in (both | axes).items() if value is not None}

    def _fed(self, axes: dict[str, Decimal], values: dict[str, str]) -> None:
        if "F" in values:
            tenths = 1 if self.scale == 1.0 else 10
            self._feed = "F" + signed(Decimal(values["F"]) * tenths).removeprefix("+")
            self._stated = False
        feed = "" if self._stated else self._feed
        self._stated = True
        if self._motion == "G1":
            axes = self._in_full(axes)
            self._place.update(axes)
            super().line("L", *(axis + signed(value) for axis, value in axes.items()), feed)
            return
        self._turn(axes, Decimal(values["I"]), Decimal(values["J"]), feed)

    def _turn(self, axes: dict[str, Decimal], i: Decimal, j: Decimal, feed: str) -> None:
        """An arc: C by its end, or CP by its angle where it goes up or down."""
        x, y, z = (self._place[axis] for axis in "XYZ")
        assert x is not None  # noqa: S101 - an arc is written from a place that the text has stated
        assert y is not None  # noqa: S101
        centre, side = (x + i, y + j), "DR+" if self._motion == "G3" else "DR-"
        super().line("CC", "X" + signed(centre[0]), "Y" + signed(centre[1]))
        self._place.update(axes)
        if "Z" not in axes:
            self._real = None
            super().line("C", "X" + signed(axes["X"]), "Y" + signed(axes["Y"]), side, feed)
            return
        assert z is not None  # noqa: S101
        whole = (axes["X"], axes["Y"]) == (x, y)
        around = float(centre[0]), float(centre[1])
        start = self._real or (float(x), float(y))
        end = float(axes["X"]), float(axes["Y"])
        angle = FULL_TURN if whole else self._angle(start, end, around)
        turn = angle if side == "DR+" else -angle
        super().line("CP", "IPA" + signed(turn), "IZ" + signed(axes["Z"] - z), side, feed)
        if whole:
            return
        self._real = real = rotated(start, around, float(turn))
        # What is off by a last decimal would add up from arc to arc.
        if math.hypot(real[0] - end[0], real[1] - end[1]) > 10.0**-self.decimals / 2:
            both = self._in_full({axis: axes[axis] for axis in "XY"})
            super().line("L", *(axis + signed(value) for axis, value in both.items()))

    def _angle(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        centre: tuple[float, float],
    ) -> Decimal:
        """From start to end in the direction of the arc, degrees above 0."""
        first, last = (math.atan2(place[1] - centre[1], place[0] - centre[0]) for place in (start, end))
        way = last - first if self._motion == "G3" else first - last
        return Decimal(math.degrees(way % math.tau)).quantize(ANGLE)


def numbered(lines: list[str]) -> list[str]:
    """Blocks with their numbers, from 0 on; what ``~`` joins to a block has none.

    >>> numbered(["BEGIN PGM A MM", "CYCL DEF 247 DATUM SETTING ~", "Q339=+1 ;DATUM NUMBER", "M30"])
    ['0 BEGIN PGM A MM', '1 CYCL DEF 247 DATUM SETTING ~', '  Q339=+1 ;DATUM NUMBER', '2 M30']
    """
    found, count, joined = [], 0, False
    for line in lines:
        found.append(f"  {line}" if joined else f"{count} {line}")
        count += not joined
        joined = line.endswith("~")
    return found
