"""Round parts of a train, which are turned or bought: shafts, pins, spacers, dowels; and the keys.

They are solids of their own and get no milling program.
"""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from mechwright import Colour, Instance, Part
from mechwright.geometry.keyway import Opening
from mechwright_elliptic_gears.layout import (
    AXIAL_PLAY,
    DOWELS,
    HEAD,
    HEAD_HEIGHT,
    PHASE_PIN,
    PIN_HEAD,
    RUNNING,
    SPACER,
    STUB,
    Layout,
)

if TYPE_CHECKING:
    import cadquery as cq

MATERIAL = "steel"
"""Of all round parts."""

_STEEL, _BRASS, _DARK = (0.78, 0.79, 0.81), (0.80, 0.66, 0.36), (0.36, 0.38, 0.42)


def round_parts(
    layout: Layout,
    opening: Opening,
    *,
    keyed: bool,
    dowelled: bool,
    phase_pin: float | None = None,
) -> tuple[Part, ...]:
    """Everything that is no plate.

    ``keyed`` and ``dowelled`` say whether keys or dowels join gears 3 and 4, ``phase_pin`` is the diameter,
    mm, of the pin that joins them by a dividing circle; where nothing does, a clamp has its own spacer there.
    """
    joined = keyed or dowelled or phase_pin is not None
    shaft = layout.bore - RUNNING
    low, high, t = layout.lower, layout.upper, layout.thickness
    foot = layout.base + STUB * layout.bore
    # Seats are open at the upper end of the shaft, so that gears and keys can be put on from there.
    seat = (opening.bore / 2 - opening.seat_depth, opening.width) if opening.has_keyway else None
    parts = [
        _part(
            "shaft-2",
            partial(_shaft, shaft, foot + low + t, t, seat),
            (Instance("gear-2", -foot),),
            _STEEL,
        ),
        _part(
            "shaft-4",
            partial(_shaft, shaft, layout.base + high + t, high - low + t, seat if keyed else None),
            (Instance("gear-3" if keyed else "base", -layout.base),),
            _STEEL,
        ),
        _part(
            "shaft-5",
            partial(_shaft, shaft, layout.base + high + t, 0.0, None),
            (Instance("axis-5", -layout.base),),
            _STEEL,
        ),
        _part(
            "hub-spacer",
            partial(_ring, layout.bore, layout.spacer, layout.gap),
            (
                Instance("axis-2"),
                Instance("base"),
                *((Instance("base", low + layout.thickness),) if joined else ()),
            ),
            _BRASS,
        ),
        _part(
            "hub-spacer-5", partial(_ring, layout.bore, layout.spacer, high), (Instance("axis-5"),), _BRASS
        ),
        _part(
            "joint-spacer",
            partial(_ring, layout.pin, SPACER * layout.pin, layout.crown),
            tuple(Instance(body, high + layout.thickness) for body in ("joint-j", "joint-k")),
            _BRASS,
        ),
        _part(
            "joint-pin",
            partial(_pin, layout.pin, layout.thickness, layout.crown + layout.coupler + AXIAL_PLAY),
            tuple(Instance(body, high) for body in ("joint-j", "joint-k")),
            _DARK,
        ),
    ]
    if opening.has_keyway:
        keys = [Instance("gear-2", low)]
        if keyed:
            keys += [Instance("gear-3", low), Instance("gear-3", high)]
        key = partial(_box, opening.bore / 2 - opening.seat_depth, opening.key_top, opening.width, t)
        parts.append(_part("key", key, tuple(keys), _DARK))
    if phase_pin is not None:
        pin = partial(headed, phase_pin, HEAD * layout.dowel, high - low + t, PIN_HEAD * layout.gap)
        parts.append(_part(PHASE_PIN, pin, (Instance(PHASE_PIN, low),), _DARK))
    elif dowelled:
        at = tuple(Instance(body, low) for body in DOWELS)
        parts.append(_part("dowel", partial(_cylinder, layout.dowel, high - low + t), at, _DARK))
    return tuple(parts)


def _part(
    name: str, build: "Callable[[], cq.Solid]", instances: tuple[Instance, ...], colour: Colour
) -> Part:
    return Part(name, None, 0.0, MATERIAL, instances=instances, colour=colour, build=build)


def _cylinder(diameter: float, height: float) -> "cq.Solid":
    import cadquery as cq

    return cq.Solid.makeCylinder(diameter / 2, height)


def _box(x0: float, x1: float, width: float, height: float, z: float = 0.0) -> "cq.Solid":
    """From x0 to x1, ``width`` wide about the x axis."""
    import cadquery as cq

    return cq.Solid.makeBox(x1 - x0, width, height, cq.Vector(x0, -width / 2, z))


def _shaft(
    diameter: float, length: float, seat_length: float, seat: tuple[float, float] | None
) -> "cq.Solid":
    """A cylinder; with a key seat (its floor's x, its width) over the upper ``seat_length``."""
    shaft = _cylinder(diameter, length)
    if seat is None:
        return shaft
    floor, width = seat
    return _cut(shaft, _box(floor, diameter, width, seat_length, length - seat_length))


def _ring(inner: float, outer: float, height: float) -> "cq.Solid":
    return _cut(_cylinder(outer, height), _cylinder(inner, height))


def headed(diameter: float, head: float, shank: float, height: float) -> "cq.Solid":
    """A cylinder with a head on its upper end."""
    import cadquery as cq

    top = cq.Solid.makeCylinder(head / 2, height, cq.Vector(0, 0, shank))
    return _cylinder(diameter, shank).fuse(top).Solids()[0]


def _pin(diameter: float, seat: float, running: float) -> "cq.Solid":
    """Seat, then the thinner part that turns, then the head, from below."""
    import cadquery as cq

    r, thin, head = diameter / 2, (diameter - RUNNING) / 2, HEAD * diameter / 2
    top = seat + running
    section = [(0, 0), (r, 0), (r, seat), (thin, seat), (thin, top), (head, top)]
    end = top + HEAD_HEIGHT * diameter
    points = [cq.Vector(x, 0, z) for x, z in (*section, (head, end), (0, end))]
    face = cq.Face.makeFromWires(cq.Wire.makePolygon(points, close=True))
    return cq.Solid.revolve(face, 360, cq.Vector(0, 0, 0), cq.Vector(0, 0, 1))


def _cut(solid: "cq.Solid", tool: "cq.Solid") -> "cq.Solid":
    return solid.cut(tool).Solids()[0]
