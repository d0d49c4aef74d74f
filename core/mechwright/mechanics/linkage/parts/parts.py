"""The parts of a linkage: plates, pins, bushings, and posts between two ground plates."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from mechwright.contracts.details import Detail
from mechwright.contracts.part import Colour, Instance, Part
from mechwright.contracts.turned import Step, Turned
from mechwright.errors import GeometryError
from mechwright.mechanics.linkage import PIN_MATERIAL, bushing_part, pin_part
from mechwright.mechanics.linkage.clamp import screw_parts, stud_part
from mechwright.mechanics.linkage.parts.frames import frame_of, roller_place
from mechwright.mechanics.linkage.parts.layout import Layout
from mechwright.mechanics.linkage.parts.pins import Pin
from mechwright.mechanics.linkage.parts.retention import UNDER, Retention, retention_of
from mechwright.mechanics.linkage.parts.scheme import GROUND_PLATES, UPPER
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT, STEEL
from mechwright.mechanics.planar.dynamics import GROUND

BOLT = 1.5
"""Length of a post's bolt under the lower plate, in its diameters: for a nut, or the machine's bed."""

THREAD = 5.0
"""Of the end under the lower plate where ``screw_hole`` is given, mm: it goes into a frame's pillars."""

GREY: Colour = (0.62, 0.64, 0.66)
COLOURS: tuple[Colour, ...] = (
    (0.78, 0.36, 0.30), (0.36, 0.55, 0.76), (0.88, 0.72, 0.34), (0.45, 0.68, 0.46),
    (0.60, 0.44, 0.68), (0.90, 0.55, 0.30), (0.30, 0.64, 0.66), (0.86, 0.56, 0.66),
    (0.55, 0.42, 0.32), (0.66, 0.74, 0.34), (0.32, 0.38, 0.60), (0.62, 0.80, 0.86),
    (0.56, 0.24, 0.36), (0.20, 0.44, 0.36), (0.80, 0.78, 0.62), (0.76, 0.62, 0.84),
)  # fmt: skip
"""Of the moving links, in their order; a drawn linkage has at most 15."""


def parts_of(
    layout: Layout,
    colours: Mapping[str, Colour] | None = None,
    details: Mapping[str, tuple[Detail, ...]] | None = None,
) -> tuple[Part, ...]:
    """All parts, plates first, each standing in the mechanism.

    Parameters
    ----------
    colours
        Links to theirs, where they are not :data:`COLOURS`.
    details
        Plates to what is engraved in them.

    Raises
    ------
    GeometryError
        Two parts have one name.
    DesignError
        The name of a link or point cannot be a file name.
    """
    found = (
        *_plates(layout, colours or {}, details or {}),
        *_pins(layout),
        *_bushings(layout),
        *_clamps(layout),
        *_posts(layout),
    )
    names = [part.name for part in found]
    if twice := next((name for name in names if names.count(name) > 1), None):
        raise GeometryError(f"two parts are named {twice}; rename a link or a point")
    return found


FRAME_PARTS = frozenset(
    {
        "base-plate",
        "coupling",
        "foot",
        "leg",
        "motor",
        "motor-pillar",
        "motor-plate",
        "pillar",
        "plain-pillar",
    }
)
"""Names of parts that a frame around the linkage may have."""


def part_name(plate: str) -> str:
    """The name of a plate's part: a file name that no part of a frame has.

    >>> part_name("Rod"), part_name("foot")
    ('rod', 'foot-link')
    """
    name = plate.lower()
    return f"{name}-link" if name in FRAME_PARTS else name


def pin_span(layout: Layout, pin: Pin) -> tuple[float, float]:
    """Heights of a pin's ends, mm, heads left out; a stud ends under the plate with its slot."""
    low, high = layout.stack.spans[pin.name]
    size = layout.sizes.pin_diameter
    if pin.clamp is not None:
        return low + HEAD_HEIGHT * size, layout.bottom(pin.body)
    return low - pin.below * size, high + pin.above * size


@dataclass(frozen=True)
class Bushing:
    """A bushing: its frame, the plate in whose bore or slot it is, its link, and its place there, mm.

    It stands out ``below`` its plate or ``above`` it, mm, on the side of the link that the pin is pressed
    into: links lie on bushings, and not on each other.
    """

    frame: str
    plate: str
    link: str
    place: complex
    below: float = 0.0
    above: float = 0.0

    def length(self, layout: Layout) -> float:
        """Over all, mm."""
        return layout.sizes.thickness_of(self.plate) + self.below + self.above


def bushed(layout: Layout) -> Iterator[Bushing]:
    """Every bushing."""
    if layout.sizes.bushing_wall > 0:
        out: dict[str, tuple[float, float]] = {}
        for pin in layout.pins:
            for plate, link in pin.turning:
                below, above = _protrusion(layout, pin, plate)
                out.setdefault(link, (below, above))
                place = roller_place(layout, pin, link)
                yield Bushing(frame_of(pin, link, place), plate, link, place, below, above)
            for plate, link in pin.rolling:
                place = roller_place(layout, pin, link)
                yield Bushing(frame_of(pin, link, place), plate, link, place)
        for frame, (link, place) in layout.spares.items():
            yield Bushing(frame, link, link, place, *out.get(link, (0.0, 0.0)))


def _protrusion(layout: Layout, pin: Pin, plate: str) -> tuple[float, float]:
    """How far the bushing of a plate reaches below it and above it, mm: to the next plate of a fixed pin."""
    if pin.clamp is not None or pin.rolling or not pin.pressed:
        return 0.0, 0.0
    sizes, low = layout.sizes, layout.bottom(plate)
    high = low + sizes.thickness_of(plate)
    fixed = min(layout.bottom(one) for one in pin.pressed)
    others = [one for one in pin.plates if one != plate]
    tops = [layout.bottom(one) + sizes.thickness_of(one) for one in others]
    if fixed < low:
        gap = min((low - top for top in tops if top <= low), default=0.0)
        return (sizes.washer, 0.0) if math.isclose(gap, sizes.washer, abs_tol=UNDER) else (0.0, 0.0)
    gap = min((layout.bottom(one) - high for one in others if layout.bottom(one) >= high), default=0.0)
    return (0.0, sizes.washer) if math.isclose(gap, sizes.washer, abs_tol=UNDER) else (0.0, 0.0)


def _plates(
    layout: Layout, colours: Mapping[str, Colour], details: Mapping[str, tuple[Detail, ...]]
) -> Iterator[Part]:
    sizes, links = layout.sizes, layout.linkage.machine.links
    grounds = [plate for plate in GROUND_PLATES if plate in layout.outlines]
    moving = [plate for plate in layout.outlines if plate not in GROUND_PLATES]
    for plate in (*grounds, *moving):
        link = layout.link(plate)
        own = GREY if link == GROUND else COLOURS[links.index(link) % len(COLOURS)]
        at, thickness = Instance(link, layout.bottom(plate)), sizes.thickness_of(plate)
        yield Part(
            part_name(plate),
            layout.outlines[plate],
            thickness,
            sizes.material,
            (at,),
            colours.get(link, own),
            details=details.get(plate, ()),
        )


def _pins(layout: Layout) -> Iterator[Part]:
    size = layout.sizes.pin_diameter
    head = (HEAD * size, HEAD_HEIGHT * size)
    held = retention_of(layout)
    for pin in layout.pins:
        low, high = pin_span(layout, pin)
        frame = frame_of(pin, pin.body, pin.place)
        if held is not None and held.pin is pin:
            at = Instance(frame, low)
            yield Part(pin.name, None, 0.0, PIN_MATERIAL, (at,), STEEL, turned=held.form)
            yield _circlip(layout, held, frame)
            continue
        if pin.clamp is not None:
            yield stud_part(pin.name, size, high - low, head, pin.clamp, Instance(frame, low - head[1]))
            continue
        if pin.foot:
            form = Turned((Step(*head), Step(size, high - low)))
            at = Instance(frame, low - head[1])
            yield Part(pin.name, None, 0.0, PIN_MATERIAL, (at,), STEEL, turned=form)
            continue
        at = Instance(frame, low)
        yield pin_part(pin.name, size, high - low, (at,), *(head if pin.head else (0.0, 0.0)))


def _circlip(layout: Layout, held: Retention, frame: str) -> Part:
    """The circlip under the ground plate; its play is the float of the shaft."""
    at, ring = (Instance(frame, held.wall),), held.ring
    play = layout.sizes.washer + UNDER
    return Part(ring.part_name, None, 0.0, PIN_MATERIAL, at, STEEL, bought=ring.bought, play=play)


def _bushings(layout: Layout) -> Iterator[Part]:
    sizes = layout.sizes
    bore = sizes.pin_diameter + sizes.running_fit
    alike: dict[tuple[bool, float], list[Instance]] = {}
    # What rolls in a slot is held by the plates over and under it, with the air of a washer.
    loose = sizes.washer if any(pin.rolling for pin in layout.pins) else 0.0
    for one in bushed(layout):
        ground = sizes.thickness_of(one.plate) != sizes.thickness
        at = Instance(one.frame, layout.bottom(one.plate) - one.below)
        alike.setdefault((ground, round(one.length(layout), 6)), []).append(at)
    spare = ("bore",) if layout.spares else ()
    names: dict[str, int] = {}
    for (ground, length), places in sorted(alike.items(), key=lambda item: item[0][0]):
        name = "bushing-ground" if ground else "bushing"
        names[name] = names.get(name, 0) + 1
        if names[name] > 1:
            name = f"{name}-{names[name]}"
        plain = sizes.ground_thickness if ground else sizes.thickness
        out = round(length - plain, 6)
        ring = bushing_part(name, bore, sizes.roller, length, places, spaces=out)
        yield replace(ring, play=max(loose, out), vacant=() if ground else spare)


def _clamps(layout: Layout) -> Iterator[Part]:
    """Screws and washers on the plates with slots."""
    studs = [pin for pin in layout.pins if pin.clamp is not None]
    if studs and (clamp := studs[0].clamp) is not None:
        thickness = layout.sizes.thickness
        seats = [
            Instance(frame_of(pin, pin.body, pin.place), layout.bottom(pin.body) + thickness) for pin in studs
        ]
        yield from screw_parts("clamp", clamp, seats)


def _posts(layout: Layout) -> Iterator[Part]:
    """Tubes that hold two ground plates apart, and bolts that go through both and into what they stand on."""
    if not layout.posts:
        return
    sizes, size = layout.sizes, layout.sizes.hole
    frames = [f"{GROUND}-post-{count}" for count in range(1, len(layout.posts) + 1)]
    under, over = layout.stack.bottom(GROUND) + sizes.ground_thickness, layout.stack.bottom(UPPER)
    low, high = layout.stack.spans["post-1"]
    end = low - BOLT * size
    posts = [Instance(frame, under) for frame in frames]
    bolts = [Instance(frame, end) for frame in frames]
    yield bushing_part("post", size, size + 2 * sizes.rim, over - under, posts, sizes.material)
    head = (HEAD * size, HEAD_HEIGHT * size)
    if sizes.screw_hole is None or size <= THREAD:
        yield pin_part("bolt", size, high - end, bolts, *head)
        return
    note = (
        f"thread M{THREAD:g} on the lower end, {low - end:g} long; two flats {1.3 * size:.1f} across the head"
    )
    form = Turned((Step(THREAD, low - end), Step(size, high - low), Step(*head)), note=note)
    yield Part("bolt", None, 0.0, PIN_MATERIAL, tuple(bolts), STEEL, turned=form)
