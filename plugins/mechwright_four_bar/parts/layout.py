"""How the links stand: on one ground plate, or between two that posts hold apart.

One plate carries both pivots from below. Where the ground is the shortest link, each pivot lies inside the
circle of the other one's link, so that the higher of crank and follower sends its shaft through the lower: no
order of layers is free. Then A0 stays in the first plate and B0 goes into a second one. Their four posts
stand outside everything that moves.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from mechwright import GeometryError, Outline, Poses
from mechwright.mechanics.linkage import (
    Boss,
    Closeness,
    Plate,
    Spindle,
    Stack,
    bent_link,
    hull_link,
    rectangle,
    stack,
    straight_link,
)
from mechwright.mechanics.linkage.outlines import FILLET
from mechwright.mechanics.linkage.turned import HEAD
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.joints import bosses, joints, raised
from mechwright_four_bar.parts.phases import clamp_of_design, set_joints

BEND = 2.0
"""Radius of the bent coupler's middle line, in web widths: its inner edge keeps 1.5 of them."""

MOVING = ("crank", "follower", "coupler")


@dataclass(frozen=True)
class Layout:
    """What the plates look like and where they stand.

    Parameters
    ----------
    outlines
        Plate to its outline in its body's frame: origin in its first joint, x to its second.
    stack
        The layers.
    screws, hole
        Axes of the holes in the ground plates' corners, x + i y in the ground's frame, and their diameter,
        mm.
    sides
        On how many sides of the links a ground plate stands.
    raised
        By how much plates stand over their layers' undersides, mm.
    """

    outlines: Mapping[str, Outline]
    stack: Stack
    screws: tuple[complex, ...]
    hole: float
    sides: int
    raised: Mapping[str, float] = field(default_factory=dict)

    def bottom(self, plate: str) -> float:
        """Height of a plate's underside, mm: over its layer's by the heads of studs below it."""
        return self.stack.bottom(plate) + self.raised.get(plate, 0.0)

    @property
    def posts(self) -> tuple[complex, ...]:
        """Axes of the posts between two ground plates; none with one plate."""
        return self.screws if self.sides == 2 else ()


def laid_out(params: FourBarParams, phases: Sequence[Mapping[str, Poses]], sides: int) -> Layout:
    """Plates and their layers with ground plates on that many sides.

    Parameters
    ----------
    phases
        Poses of all bodies over the motion of each phase, the ground's at rest in the origin.

    Raises
    ------
    GeometryError
        The bend of the coupler does not fit, the bores of the ground plate run into each other, no order of
        layers keeps all plates apart, or a second ground plate would lie over clamps.
    """
    own, up = bosses(params, sides), raised(params)
    if sides == 2 and any(up.values()):
        raise GeometryError("clamps of the coupler are set from above, where a second ground plate would lie")
    if sides == 1:
        one, two = own["ground"]
        if abs(two.centre - one.centre) < (one.bore + two.bore) / 2 + params.rim:
            raise GeometryError("the bores of one ground plate leave less than a rim between them")
    outlines = {name: link_outline(params, name, own[name]) for name in MOVING}
    plates = [
        Plate(name, name, outline, params.thickness + up.get(name, 0.0)) for name, outline in outlines.items()
    ]
    hole = params.screw_hole or params.pin_diameter
    corner = hole / 2 + params.rim
    low, high = _corners(params, own, corner)
    if sides == 2:
        bounds = [Closeness(plates, (), one, params.clearance).swept(MOVING) for one in phases]
        y0, y1 = min(one[1] for one in bounds), max(one[3] for one in bounds)
        # The posts stand on whole millimetres outside of it.
        low = complex(low.real, math.floor(min(y0 - corner, low.imag + corner)) - corner)
        high = complex(high.real, math.ceil(max(y1 + corner, high.imag - corner)) + corner)
    screws = _screws(corner, low, high)
    holes = [Boss(at, corner, hole, "screw") for at in screws]
    bodies = ("ground", "ground-2")[:sides]
    for name in bodies:
        outlines[name] = rectangle(low, high, corner, (*own[name], *holes))
        layers = (0,) if name == "ground" else ()
        plates.append(Plate(name, "ground", outlines[name], params.ground_thickness, layers))
    posts = screws if sides == 2 else ()
    dealt = _dealt(params, plates, _spindles(params, posts, hole), phases)
    return Layout(outlines, dealt, screws, hole, sides, up)


def _dealt(
    params: FourBarParams,
    plates: Sequence[Plate],
    spindles: Sequence[Spindle],
    phases: Sequence[Mapping[str, Poses]],
) -> Stack:
    """Layers of plates; a coupler with clamps is on top."""
    if not any(raised(params).values()):
        return stack(plates, spindles, phases, params.clearance, params.washer)
    faults: list[GeometryError] = []
    for top in range(2, len(MOVING) + 1):
        layers = {"coupler": (top,), "crank": tuple(range(1, top)), "follower": tuple(range(1, top))}
        dealt = [replace(plate, layers=layers.get(plate.name, plate.layers)) for plate in plates]
        try:
            return stack(dealt, spindles, phases, params.clearance, params.washer)
        except GeometryError as error:
            faults.append(error)
    raise faults[-1]


def hidden(
    params: FourBarParams, layout: Layout, poses: Mapping[str, Poses], point: complex
) -> tuple[str, str] | None:
    """What stands over and under a pin in the coupler at some time; None where one way out is always free."""
    plates = [
        Plate(name, name if name in MOVING else "ground", outline, 1.0)
        for name, outline in layout.outlines.items()
    ]
    pin = Spindle("point", "coupler", point, params.pin_diameter / 2, ("coupler",))
    close = Closeness(plates, (pin,), poses, params.clearance)
    own = layout.stack.layer["coupler"]
    over, under = "", ""
    for plate in plates:
        layer = layout.stack.layer[plate.name]
        if layer != own and close.spindle(pin, plate, pin.radius):
            over, under = (plate.name, under) if layer > own else (over, plate.name)
    return (over, under) if over and under else None


def _spindles(params: FourBarParams, posts: Sequence[complex], hole: float) -> list[Spindle]:
    """Pins and shafts, and posts about bolts of a diameter, mm."""
    radius, head = params.pin_diameter / 2, HEAD * params.pin_diameter / 2
    clamp, found = clamp_of_design(params), []
    for name, one in joints(params, 2 if posts else 1).items():
        # What goes on above its plates covers others there as a head does.
        above = head if one.head else radius if one.above else 0.0
        if one.stud and clamp is not None:
            above = clamp.reach
        found.append(Spindle(name, one.body, one.place, radius, one.plates, above))
    corner, head = hole / 2 + params.rim, HEAD * hole / 2
    for number, at in enumerate(posts, start=1):
        found.append(Spindle(f"post-{number}", "ground", at, corner, ("ground", "ground-2"), head))
    return found


def link_outline(params: FourBarParams, name: str, bosses: tuple[Boss, ...]) -> Outline:
    """Crank and follower straight, the coupler straight, bent or about its point."""
    tags = [boss.tag for boss in bosses]
    if name != "coupler" or (params.coupler_bend == 0 and tags == ["A", "B"]):
        one, two = bosses
        return straight_link(one, two, params.web_width)
    if params.coupler_bend != 0:
        one, two = bosses
        elbow = complex(params.coupler / 2, params.coupler_bend)
        return bent_link(one, two, elbow, params.web_width, FILLET, BEND * params.web_width)
    hull = hull_link(bosses)
    slots = (one.slot.loop(f"{key}-slot") for key, one in set_joints(params).items() if one.slot is not None)
    return Outline(hull.outer, (*hull.inner, *slots))


def _corners(
    params: FourBarParams, own: Mapping[str, tuple[Boss, ...]], corner: float
) -> tuple[complex, complex]:
    """A plate under both pivots, with a hole for a screw in each corner, whose radius is ``corner``, mm."""
    reach = max(boss.radius for boss in own["ground"])
    # With a rim between the two holes of one end, which may be large.
    aside = max(reach, params.screw_offset or 0.0, corner - params.rim / 2)
    low = complex(-reach - 2 * corner, -aside - corner)
    return low, complex(params.ground, 0) - low


def _screws(corner: float, low: complex, high: complex) -> tuple[complex, ...]:
    return tuple(
        complex(x, y)
        for x in (low.real + corner, high.real - corner)
        for y in (low.imag + corner, high.imag - corner)
    )
