"""How the links stand: on one ground plate, or between two that posts hold apart.

One plate carries both pivots from below. Where the ground is the shortest link, each pivot lies inside the
circle of the other one's link, so that the higher of crank and follower sends its shaft through the lower: no
order of layers is free. Then A0 stays in the first plate and B0 goes into a second one. Their four posts
stand outside everything that moves.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

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
    web_link,
)
from mechwright_four_bar.joints import HEAD, bosses, joints
from mechwright_four_bar.params import FourBarParams

FILLET = 5.0
"""Radius between web and boss, mm: end mills up to 10 mm go round it. Links too short for it get none."""

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
    posts
        Axes of the posts between two ground plates, x + i y in the ground's frame, mm; none with one plate.
    """

    outlines: Mapping[str, Outline]
    stack: Stack
    posts: tuple[complex, ...] = ()

    @property
    def sides(self) -> int:
        """On how many sides of the links a ground plate stands."""
        return 2 if self.posts else 1


def laid_out(params: FourBarParams, poses: Mapping[str, Poses], sides: int) -> Layout:
    """Plates and their layers with ground plates on that many sides.

    Parameters
    ----------
    poses
        Of all bodies over the motion, the ground's at rest in the origin.

    Raises
    ------
    GeometryError
        The bend of the coupler does not fit, the bores of the ground plate run into each other, or no order
        of layers keeps all plates apart.
    """
    own = bosses(params, sides)
    if sides == 1:
        one, two = own["ground"]
        if abs(two.centre - one.centre) < (one.bore + two.bore) / 2 + params.rim:
            raise GeometryError("the bores of one ground plate leave less than a rim between them")
    outlines = {name: link_outline(params, name, own[name]) for name in MOVING}
    plates = [Plate(name, name, outline, params.thickness) for name, outline in outlines.items()]
    low, high = _corners(params, own)
    if sides == 2:
        _, y0, _, y1 = Closeness(plates, (), poses, params.clearance).swept(MOVING)
        # The posts stand on whole millimetres outside of it.
        corner = _corner(params)
        low = complex(low.real, math.floor(min(y0 - corner, low.imag + corner)) - corner)
        high = complex(high.real, math.ceil(max(y1 + corner, high.imag - corner)) + corner)
    screws = _screws(params, low, high)
    holes = [Boss(at, _corner(params), params.pin_diameter, "screw") for at in screws]
    bodies = ("ground", "ground-2")[:sides]
    for name in bodies:
        outlines[name] = rectangle(low, high, _corner(params), (*own[name], *holes))
        layers = (0,) if name == "ground" else ()
        plates.append(Plate(name, "ground", outlines[name], params.ground_thickness, layers))
    posts = screws if sides == 2 else ()
    found = stack(plates, _spindles(params, posts), poses, params.clearance, params.washer)
    return Layout(outlines, found, posts)


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


def _spindles(params: FourBarParams, posts: Sequence[complex]) -> list[Spindle]:
    radius, head = params.pin_diameter / 2, HEAD * params.pin_diameter / 2
    found = []
    for name, one in joints(params, 2 if posts else 1).items():
        # What goes on above its plates covers others there as a head does.
        above = head if one.head else radius if one.above else 0.0
        found.append(Spindle(name, one.body, one.place, radius, one.plates, above))
    for number, at in enumerate(posts, start=1):
        found.append(Spindle(f"post-{number}", "ground", at, _corner(params), ("ground", "ground-2"), head))
    return found


def link_outline(params: FourBarParams, name: str, bosses: tuple[Boss, ...]) -> Outline:
    """Crank and follower straight, the coupler straight, bent or about its point."""
    if name != "coupler" or (params.coupler_bend == 0 and len(bosses) == 2):
        return _straight(bosses, params.web_width)
    if params.coupler_bend != 0:
        one, two = bosses
        elbow = complex(params.coupler / 2, params.coupler_bend)
        return bent_link(one, two, elbow, params.web_width, FILLET, BEND * params.web_width)
    return hull_link(bosses)


def _straight(bosses: tuple[Boss, ...], width: float) -> Outline:
    """A web between two bosses, or the hull where there is no room for its fillets."""
    one, two = bosses
    half, least = width / 2, min(one.radius, two.radius)
    if half < least:
        taken = sum(math.sqrt((boss.radius + FILLET) ** 2 - (half + FILLET) ** 2) for boss in (one, two))
        if taken < abs(two.centre - one.centre):
            return web_link(one, two, width, FILLET)
    return hull_link((one, two))


def _corner(params: FourBarParams) -> float:
    """Radius of a ground plate's corners about the bores for screws, and of the posts, mm."""
    return params.pin_diameter / 2 + params.rim


def _corners(params: FourBarParams, own: Mapping[str, tuple[Boss, ...]]) -> tuple[complex, complex]:
    """A plate under both pivots, with a bore for a screw of the pins' diameter in each corner."""
    corner = _corner(params)
    reach = max(boss.radius for boss in own["ground"])
    low = complex(-reach - 2 * corner, -reach - corner)
    return low, complex(params.ground, 0) - low


def _screws(params: FourBarParams, low: complex, high: complex) -> tuple[complex, ...]:
    corner = _corner(params)
    return tuple(
        complex(x, y)
        for x in (low.real + corner, high.real - corner)
        for y in (low.imag + corner, high.imag - corner)
    )
