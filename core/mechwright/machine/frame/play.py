"""The axial stacks of a frame: float of its shafts, play of its hubs, gap of the shafts in the coupling."""

from collections.abc import Iterator

from mechwright.contracts.axial_stack import AxialStack, StackLength
from mechwright.contracts.general_tolerances import general_length
from mechwright.contracts.turned import Turned
from mechwright.machine.frame.bracket import BRACKET_HEIGHT, HEIGHT, Bracket
from mechwright.machine.frame.coupled import PLATE
from mechwright.machine.frame.located_play import located_stacks
from mechwright.machine.frame.pillars import BETWEEN
from mechwright.machine.frame.pillars import HEIGHT as PILLAR_HEIGHT
from mechwright.machine.frame.plates import SEAT_DEPTH, seat_depth
from mechwright.machine.frame.seats import Seat
from mechwright.machine.frame.shafts import (
    COLLAR_EDGE,
    LOADED_WALL,
    RING,
    Levels,
    hub_ring,
    hub_room,
    ring_of,
)
from mechwright.machine.frame.shim_rings import shimming

FLOAT, RATTLE = (0.1, 0.31), 0.55
"""Play of a shaft between its bearings, mm, and the greatest without shim rings: it never binds."""

LEFT, HUB_LEFT = 0.12, 0.05
"""What shim rings leave at least of a measured float, and of the gap over a hub, mm."""

HUB_PLAY, HUB_RATTLE = 0.31, 0.9
"""Greatest play of a hub under its circlip with shim rings, as of a shaft, and without, mm."""

APART = 0.5
"""Least gap of both shafts in a coupling, mm."""

MOTOR_SHAFT = 0.5
"""Limit deviations of how far a motor's shaft stands out, plus and minus, mm; handbook."""

STUB = "shaft below its bearing"
"""Name of the length that the gap in the coupling follows from."""

FLOATS = 0.1
"""How far the float of a shaft moves its end, plus and minus, mm: shim rings leave so much."""


def shaft_stacks(seat: Seat, shaft: Turned, levels: Levels) -> Iterator[AxialStack]:
    """The float of a shaft between its bearings, and the play of its hub."""
    if seat.located:
        yield from located_stacks(seat, shaft, levels)
    else:
        yield _float(seat, shaft, levels)
    yield _hub(seat, shaft)


def _float(seat: Seat, shaft: Turned, levels: Levels) -> AxialStack:
    bearing, ring, name = seat.bearing, ring_of(seat), f"shaft-{seat.spindle.name}"
    part = f"bearing-{bearing.name.replace('/', '_')}"
    lengths = (
        *(
            StackLength(f"depth of the {side} seat", 1, bearing.width, *SEAT_DEPTH, part=f"{side}-plate")
            for side in ("lower", "upper")
        ),
        StackLength(BETWEEN, 1, levels.height, -PILLAR_HEIGHT, PILLAR_HEIGHT, part="pillar"),
        StackLength.of(shaft.length_of(COLLAR_EDGE), -1, name),
        *(
            StackLength(f"width of the {side} bearing", -1, bearing.width, -bearing.narrower, 0.0, True, part)
            for side in ("lower", "upper")
        ),
    )
    where = "between the outer ring of the upper bearing and the floor of its seat"
    return AxialStack(
        f"float of {name}",
        lengths,
        0.0 if ring is None else FLOAT[0],
        RATTLE if ring is None else FLOAT[1],
        None if ring is None else shimming(ring, RING, where, LEFT),
        COLLAR_EDGE,
    )


def _hub(seat: Seat, shaft: Turned) -> AxialStack:
    hub, circlip, name = seat.spindle.hub, seat.circlip, f"shaft-{seat.spindle.name}"
    ring, where = hub_ring(seat), "between the hub and its circlip"
    copy = (f"spindle-{seat.spindle.name}", hub.high + hub_room(seat))
    lengths = (
        StackLength.of(shaft.length_of(LOADED_WALL), 1, name),
        StackLength("circlip", -1, circlip.thickness, -circlip.thinner, 0.0, True, circlip.part_name, copy),
        *(
            StackLength(f"hub{f', part {count}' if hub.pieces else ''}, ISO 2768-m", -1, one, -off, off)
            for count, one in enumerate(hub.stacked, start=1)
            for off in (general_length(one, "medium"),)
        ),
    )
    return AxialStack(
        f"play of the hub on {name}",
        lengths,
        0.0,
        HUB_RATTLE if ring is None else HUB_PLAY,
        None if ring is None else shimming(ring, hub_room(seat), where, HUB_LEFT),
        LOADED_WALL,
        hub_on=name,
    )


def coupling_stack(bracket: Bracket, seat: Seat, inner: float, thickness: float) -> AxialStack:
    """The gap of motor's shaft and driven shaft in their coupling, with the motor on a bracket.

    ``inner`` is the height of the inner face of the bearing plate above, mm.
    """
    height = inner - thickness - bracket.top
    general = (
        ("floor under the lower bearing", 1, thickness - seat_depth(seat, upper=False), "lower-plate"),
        (STUB, -1, bracket.stub[1], f"shaft-{seat.spindle.name}"),
        ("motor plate", 1, PLATE, "motor-plate"),
    )
    out = bracket.motor.face.shaft_length
    return AxialStack(
        "gap of the shafts in the coupling",
        (
            StackLength(BRACKET_HEIGHT, 1, height, -HEIGHT, HEIGHT, part="motor-pillar"),
            *(
                StackLength(
                    name,
                    sign,
                    size,
                    -general_length(size, "medium"),
                    general_length(size, "medium"),
                    part=part,
                )
                for name, sign, size, part in general
            ),
            StackLength(
                "shaft of the motor over its face", -1, out, -MOTOR_SHAFT, MOTOR_SHAFT, True, "motor"
            ),
            StackLength("float of the shaft", -1, 0.0, -FLOATS, FLOATS),
        ),
        APART,
        adjustable=STUB,
        measurable=False,
    )
