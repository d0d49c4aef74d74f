"""The axial stacks of a shaft with a locating and a free bearing."""

from collections.abc import Iterator
from typing import Literal

from mechwright.contracts.axial_stack import AxialStack, StackLength
from mechwright.contracts.turned import Turned
from mechwright.machine.frame.located import (
    ABOVE,
    BELOW,
    LEAST_WAY,
    circlip_heights,
    circlip_of,
    drawn_ring,
    inner_shim,
    thermal_way,
)
from mechwright.machine.frame.pillars import BETWEEN, HEIGHT
from mechwright.machine.frame.plates import SEAT_DEPTH, seat_depth
from mechwright.machine.frame.seats import Seat
from mechwright.machine.frame.shafts import COLLAR_EDGE, AxialLocation, Levels
from mechwright.machine.frame.shim_rings import shimming

Side = Literal["lower", "upper"]

CLAMPED = (0.01, 0.25)
"""By how much a bearing stands out of its seat under its retainer, mm: that never rests on the plate."""

PLAY, RATTLE = 0.25, 0.4
"""Greatest play of an inner ring between its shoulder and its circlip, mm, with shim rings and without."""

LEFT = 0.03
"""What shim rings leave of it at least, mm."""


def located_stacks(seat: Seat, shaft: Turned, levels: Levels) -> Iterator[AxialStack]:
    """The clamped outer ring, both inner rings, and the way of the free bearing to either side."""
    of = _Lengths(seat, shaft, levels)
    yield AxialStack(
        f"height of the lower bearing of {of.name} over its plate",
        (of.width("lower", 1), of.depth("lower", -1)),
        *CLAMPED,
    )
    lower, upper = of.inner("lower"), of.inner("upper")
    yield from (lower, upper)
    plays = (
        StackLength("play of the shaft", -1, 0.0, 0.0, round(lower.play[1], 6)),
        StackLength("play of the free bearing", -1, 0.0, 0.0, round(upper.play[1], 6)),
    )
    least = round(LEAST_WAY + thermal_way(levels.height), 3)
    outwards = (of.depth("lower", 1), of.pillars(1), of.depth("upper", 1), of.width("lower", -1))
    yield AxialStack(
        f"way of the free bearing of {of.name} outwards",
        (*outwards, of.shoulders(-1), of.width("upper", -1), *plays),
        least,
        adjustable="depth of the upper seat",
        measurable=False,
    )
    yield AxialStack(
        f"way of the free bearing of {of.name} inwards",
        (of.width("lower", 1), of.shoulders(1), of.depth("lower", -1), of.pillars(-1)),
        least,
        adjustable=COLLAR_EDGE,
        measurable=False,
    )


class _Lengths:
    """The lengths of one shaft's stacks."""

    def __init__(self, seat: Seat, shaft: Turned, levels: Levels) -> None:
        self.seat, self.shaft, self.levels = seat, shaft, levels
        self.name, self.held = f"shaft-{seat.spindle.name}", AxialLocation.of(seat, levels)

    def width(self, side: Side, sign: int) -> StackLength:
        """Of a bearing."""
        of = self.seat.bearing
        at = self.held.lower if side == "lower" else self.held.upper
        return StackLength(
            f"width of the {side} bearing",
            sign,
            of.width,
            -of.narrower,
            0.0,
            bought=True,
            part=f"bearing-{of.name.replace('/', '_')}",
            copy=(f"axis-{self.seat.spindle.name}", at),
        )

    def depth(self, side: Side, sign: int) -> StackLength:
        """Of a bearing's seat."""
        deep = seat_depth(self.seat, upper=side == "upper")
        return StackLength(f"depth of the {side} seat", sign, deep, *SEAT_DEPTH, part=f"{side}-plate")

    def pillars(self, sign: int) -> StackLength:
        """Between the plates."""
        return StackLength(BETWEEN, sign, self.levels.height, -HEIGHT, HEIGHT, part="pillar")

    def shoulders(self, sign: int) -> StackLength:
        """Between both shoulders."""
        return StackLength.of(self.shaft.length_of(COLLAR_EDGE), sign, self.name)

    def inner(self, side: Side) -> AxialStack:
        """An inner ring between its shoulder and its circlip."""
        bearing, ring = self.seat.bearing, circlip_of(self.seat.bearing)
        wall, shim = (BELOW, inner_shim(bearing)) if side == "lower" else (ABOVE, None)
        at = circlip_heights(bearing, self.held.shoulders)[0 if side == "lower" else 1]
        circlip = StackLength(
            "circlip",
            -1,
            ring.thickness,
            -ring.thinner,
            0.0,
            bought=True,
            part=ring.part_name,
            copy=(f"spindle-{self.seat.spindle.name}", at),
        )
        where = "between the inner ring of the lower bearing and its circlip"
        return AxialStack(
            f"play of {self.name} in its {side} bearing",
            (StackLength.of(self.shaft.length_of(wall), 1, self.name), self.width(side, -1), circlip),
            0.0,
            RATTLE if shim is None else PLAY,
            None if shim is None else shimming(shim, drawn_ring(bearing), where, LEFT),
            wall,
        )
