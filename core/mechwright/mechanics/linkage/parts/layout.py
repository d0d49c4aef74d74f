"""How a linkage stands: which plates there are, what they look like, and their layers.

Schemes are tried in this order, and the first that has layers is taken: one ground plate; two, the upper one
with as many of the ground's eyes as go; then the same with one link as two plates on a shared pin.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace

import numpy as np

from mechwright.contracts.motion import Poses
from mechwright.errors import GeometryError
from mechwright.geometry import Outline
from mechwright.mechanics.linkage import Boss, Closeness, Plate, Spindle, Stack, rectangle, stack
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.parts.axes import Axis, axes_of, number
from mechwright.mechanics.linkage.parts.outlines import (
    Eyes,
    check_room,
    eyes_of,
    ground_rectangle,
    link_outline,
    path_eye,
)
from mechwright.mechanics.linkage.parts.pins import Pin, pins_of
from mechwright.mechanics.linkage.parts.scheme import GROUND_PLATES, Scheme, Split, splits, uppers
from mechwright.mechanics.linkage.parts.sizes import Sizes
from mechwright.mechanics.linkage.parts.slides import Guided, Slot, guided_blocks, slots_of
from mechwright.mechanics.linkage.slots import SAME_PLACE
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.rigid import BodyMotion

TRIED = {"auto": (1, 2), "one": (1,), "two": (2,)}
"""On how many sides of the links ground plates are tried; fewer need fewer parts."""


@dataclass(frozen=True)
class Layout:
    """What a linkage is made of, and where it stands.

    Parameters
    ----------
    linkage, sizes
        What it was made for.
    scheme
        Which plates each link consists of.
    pins, slots
        All of them.
    outlines
        Plate to its outline in the frame of its link.
    stack
        The layers.
    screws
        Axes of the holes in the ground plates' corners, x + i y, mm.
    raised
        By how much plates stand over their layers' undersides, for the heads of studs below them, mm.
    spares
        Frame of a turning bore without a pin, for another phase of the machine, to its link and its place
        there, mm.
    """

    linkage: Linkage
    sizes: Sizes
    scheme: Scheme
    pins: tuple[Pin, ...]
    slots: tuple[Slot, ...]
    outlines: Mapping[str, Outline]
    stack: Stack
    screws: tuple[complex, ...]
    raised: Mapping[str, float] = field(default_factory=dict)
    spares: Mapping[str, tuple[str, complex]] = field(default_factory=dict)

    def bottom(self, plate: str) -> float:
        """Height of a plate's underside, mm."""
        return self.stack.bottom(plate) + self.raised.get(plate, 0.0)

    @property
    def posts(self) -> tuple[complex, ...]:
        """Axes of the posts between two ground plates; none with one plate."""
        return self.screws if self.scheme.sides == 2 else ()

    def link(self, plate: str) -> str:
        """The link of a plate."""
        return self.scheme.link(plate)


@dataclass(frozen=True)
class _Given:
    """What all schemes of a linkage share."""

    linkage: Linkage
    sizes: Sizes
    axes: tuple[Axis, ...]
    guided: tuple[Guided, ...]
    slots: tuple[Slot, ...]
    poses: Mapping[str, Poses]

    @property
    def moving(self) -> tuple[str, ...]:
        """Links with plates, the ground left out."""
        rolling = {block for axis in self.axes for block in axis.rollers}
        return tuple(link for link in self.linkage.machine.links if link not in rolling)

    def eyes(self, link: str) -> list[str]:
        """Names of the eyes of a link."""
        found = [axis.point for axis in self.axes if link in axis.places]
        found += [one.slide.name for one in self.guided if one.slide.block == link]
        found += [slot.slide for slot in self.slots if slot.link == link]
        pins = [axis.places[link] for axis in self.axes if link in axis.places]
        for name, (own, point) in self.linkage.traces.items():
            if own == link and all(
                abs(number(self.linkage.points[link][point]) - at) > SAME_PLACE for at in pins
            ):
                found.append(path_eye(name))
        return found


def layout_of(linkage: Linkage, sizes: Sizes, bodies: Mapping[str, BodyMotion]) -> Layout:
    """Plates, pins and their layers.

    Parameters
    ----------
    bodies
        Link to its motion (n,) over a period, both ends included, the ground among them.

    Raises
    ------
    GeometryError
        A link does not close, openings of a plate leave no rim, or no order of layers keeps the plates apart.
    """
    for link in (GROUND, *linkage.machine.links):
        open_at = ~np.isfinite(bodies[link].origin.position)
        if open_at.any():
            raise GeometryError(
                f"link {link} does not close at {open_at.sum()} of {open_at.size} positions; "
                "give the driven link less range"
            )
    axes = axes_of(linkage)
    guided = guided_blocks(linkage, axes, sizes)
    slots = slots_of(axes, guided, sizes, bodies)
    poses = {link: bodies[link].poses() for link in (GROUND, *linkage.machine.links)}
    given = _Given(linkage, sizes, axes, guided, slots, poses)
    first: GeometryError | None = None
    for scheme in _schemes(given):
        try:
            return _laid_out(given, scheme)
        except _LinkError:
            raise
        except GeometryError as error:
            first = first or error
    raise first or GeometryError("a linkage needs a pin or a slide on the ground")


class _LinkError(GeometryError):
    """A fault of a link, which it has in every scheme."""


def _schemes(given: _Given) -> Iterator[Scheme]:
    movable = {axis.point for axis in given.axes if GROUND in axis.places and not axis.shaft}
    movable |= {one.slide.name for one in given.guided if GROUND in one.slide.links}
    movable |= {slot.slide for slot in given.slots if slot.link == GROUND}
    pins = {
        link: [axis.point for axis in given.axes if link in axis.places]
        for link in given.moving
        if len(given.eyes(link)) > 2
    }
    ways: list[Split | None] = [None]
    ways += splits(pins, {link: given.eyes(link) for link in pins})
    for split in ways:
        for sides in TRIED[given.sizes.frame]:
            if sides == 1:
                yield Scheme(1, frozenset(), split)
                continue
            for upper in uppers(movable):
                # Without an eye in it a second plate serves nothing, unless it is wanted.
                if upper or given.sizes.frame == "two":
                    yield Scheme(2, upper, split)


def _laid_out(given: _Given, scheme: Scheme) -> Layout:
    linkage, sizes = given.linkage, given.sizes
    pins = pins_of(linkage, given.axes, given.guided, scheme)
    names = [plate for link in given.moving for plate in scheme.names(link)]
    grounds = GROUND_PLATES[: scheme.sides]
    eyes = {plate: eyes_of(linkage, sizes, scheme, pins, given.slots, plate) for plate in (*names, *grounds)}
    for plate, own in eyes.items():
        try:
            check_room(plate, own, sizes.rim)
        except GeometryError as error:
            raise error if plate in grounds else _LinkError(str(error)) from error
    outlines = {plate: link_outline(eyes[plate], sizes) for plate in names}
    plates = [Plate(name, scheme.link(name), outlines[name], sizes.thickness) for name in names]
    frame = ground_rectangle([disc for one in grounds for disc in eyes[one].discs(sizes.rim)], sizes)
    if scheme.sides == 2:
        _, y0, _, y1 = Closeness(plates, (), given.poses, sizes.clearance).swept(names)
        frame = frame.around(y0, y1)
    for name in grounds:
        outlines[name] = _ground_outline(frame.low, frame.high, sizes, eyes[name], frame.screws)
        layers = (0,) if name == GROUND else ()
        plates.append(Plate(name, GROUND, outlines[name], sizes.ground_thickness, layers))
    posts = frame.screws if scheme.sides == 2 else ()
    found, pins = _stacked(given, scheme, plates, pins, _posts(sizes, posts))
    return Layout(linkage, sizes, scheme, tuple(pins), given.slots, outlines, found, frame.screws)


def _ground_outline(
    low: complex, high: complex, sizes: Sizes, eyes: Eyes, screws: Sequence[complex]
) -> Outline:
    holes = [Boss(at, sizes.corner, sizes.hole, "screw") for at in screws]
    plate = rectangle(low, high, sizes.corner, (*eyes.bosses, *holes))
    return Outline(plate.outer, (*plate.inner, *(slot.loop() for slot in eyes.slots)))


def _posts(sizes: Sizes, posts: Sequence[complex]) -> list[Spindle]:
    head = HEAD * sizes.hole / 2
    return [
        Spindle(f"post-{count}", GROUND, at, sizes.corner, GROUND_PLATES, head)
        for count, at in enumerate(posts, start=1)
    ]


def _stacked(
    given: _Given, scheme: Scheme, plates: Sequence[Plate], pins: Sequence[Pin], posts: Sequence[Spindle]
) -> tuple[Stack, list[Pin]]:
    """The layers, and the pins: all that may have a head, or those that nothing covers."""
    sizes = given.sizes
    every = [replace(pin, head=not (pin.below or pin.above)) for pin in pins]
    spindles = [*(pin.spindle(sizes) for pin in pins), *posts]
    close = Closeness(plates, spindles, given.poses, sizes.clearance)

    def dealt(some: Sequence[Pin]) -> Stack:
        own = [*(pin.spindle(sizes) for pin in some), *posts]
        try:
            return stack(plates, own, given.poses, sizes.clearance, sizes.washer, measured=[close])
        except GeometryError as error:
            raise GeometryError(
                f"{error}; give the input less range, or make pin_diameter, rim or clearance smaller"
            ) from error

    found = None
    if scheme.sides == 1:
        with suppress(GeometryError):
            found = dealt(every)
    found = found or dealt(pins)
    return found, [_with_head(pin, found, close, sizes) for pin in pins]


def _with_head(pin: Pin, found: Stack, close: Closeness, sizes: Sizes) -> Pin:
    """A pin with a head below a slot in which it ends, else on top, where nothing is in the way of it."""
    if pin.below or pin.above:
        return pin
    low, high = found.spans[pin.name]
    height, head = HEAD_HEIGHT * sizes.pin_diameter, HEAD * sizes.pin_diameter / 2
    spindle = pin.spindle(sizes)
    near = [
        plate
        for plate in (course.plate for course in close.courses.values())
        if plate.name not in pin.plates and close.spindle(spindle, plate, head)
    ]
    lowest = min(pin.plates, key=found.bottom)
    over = any(found.bottom(plate.name) >= high for plate in near)
    under = any(low - height < found.bottom(plate.name) + plate.thickness <= low for plate in near)
    foot = not under and lowest in (plate for plate, _ in pin.rolling)
    return replace(pin, foot=foot, head=not foot and not over)
