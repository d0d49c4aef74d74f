"""What varies in a linkage, and how it changes the numbers of its machine.

Of each link these vary: the distance of its first two bores, two coordinates of each further bore and of each
traced point, and the offset of each slide's line. Of two ground plates each has its own, from the posts on. A
pin may stand off the middle of each bore in which it turns, a roller off the middle of its slot.
"""

import cmath
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mechwright.contracts.tolerance_settings import Tolerances
from mechwright.contracts.tolerances import Contributor
from mechwright.mechanics.linkage.parts.axes import Axis, number
from mechwright.mechanics.linkage.parts.outlines import path_eye
from mechwright.mechanics.linkage.slots import SAME_PLACE
from mechwright.mechanics.linkage.tolerance.plates import Plates
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Prismatic, Revolute
from mechwright.mechanics.planar.sensitivity import Change, Pose

WALLS = 2
"""Milled walls of a slot; the roller in it is turned."""


class Effect(Protocol):
    """What one unit of a deviation changes."""

    def at(self, poses: Mapping[str, Pose]) -> Change:
        """The change at poses of the links (d,)."""
        ...


@dataclass(frozen=True)
class Fixed:
    """A change that is the same in all positions."""

    change: Change

    def at(self, poses: Mapping[str, Pose]) -> Change:  # noqa: ARG002 - as every effect has it
        """That change."""
        return self.change


@dataclass(frozen=True)
class Play:
    """The bore of a link stands off its pin, along a direction of ``seen_from``, a complex number there.

    The displacement turns with the link that has the bore.
    """

    link: str
    joints: tuple[Revolute, ...]
    seen_from: str
    direction: complex

    def at(self, poses: Mapping[str, Pose]) -> Change:
        """The place in the link that is on the pin moves the other way."""
        off = self.direction * np.exp(1j * (poses[self.seen_from].angle - poses[self.link].angle))
        return Change({(joint.name, self.link): -off for joint in self.joints if self.link in joint.links})


@dataclass(frozen=True)
class Source:
    """A contributor, and the effect of each of its components."""

    contributor: Contributor
    effects: tuple[Effect, ...]


def sources_of(plates: Plates, tolerances: Tolerances) -> list[Source]:
    """All contributors of a design: links, pins, slides, traced points, the input.

    Raises DesignError for limits that make no sense.
    """
    found: list[Source] = []
    for link in plates.links:
        found += _lengths(plates, tolerances, link)
    for axis in plates.axes:
        found += _pins(plates, tolerances, axis)
    for slide in plates.slides:
        found += _gaps(plates, tolerances, slide)
    for name, (link, point) in plates.linkage.traces.items():
        found += _traced(plates, tolerances, name, link, number(plates.linkage.points[link][point]))
    for one in tolerances.input("input") if _turns(plates) else ():
        found.append(Source(one, (Fixed(Change(input=1.0)),)))
    return found


def length_name(link: str) -> str:
    """The contributor of the distance of a link's first two bores."""
    return link.lower()


def bore_names(link: str, point: str) -> tuple[str, str]:
    """Those of the coordinates of a further bore."""
    stem = f"{link}-{point}".lower()
    return f"{stem}-along", f"{stem}-across"


def line_name(slide: Prismatic, link: str) -> str:
    """That of the offset of a slide's line in a link."""
    return slide.name.lower() if link == slide.guide else f"{slide.name}-{link}".lower()


def pin_name(plates: Plates, axis: Axis, link: str) -> str:
    """That of the play of a pin in a link."""
    stem = "shaft" if axis.shaft else f"pin-{axis.point}".lower()
    own = stem if len(plates.turning(axis)) == 1 else f"{stem}-{link}".lower()
    return plates.table.tolerance_names.get(own, own)


def gap_names(plates: Plates, slide: Prismatic) -> tuple[str, ...]:
    """Those of the play of a slide: of its roller, or of both guide pins."""
    stem = f"{slide.name}-play".lower()
    rolls = any(one.name == slide.name for one in plates.rollers.values())
    return (stem,) if rolls else (f"{stem}-1", f"{stem}-2")


def gap_fits(plates: Plates) -> int:
    """Running fits between pin and slot: with a bushing there are two."""
    return 2 if plates.sizes.bushing_wall > 0 else 1


def _lengths(plates: Plates, tolerances: Tolerances, link: str) -> Iterator[Source]:
    """Sizes of a link; those between two ground plates, which posts bring in line, as halves in both."""
    for name, eye, value, change in _sizes(plates, link):
        if plates.in_datum_plate(link, eye):
            yield Source(tolerances.length(name, value), (Fixed(change),))
            continue
        for one in (name, f"{name}-2"):
            yield Source(tolerances.length(one, value / 2), (Fixed(change),))


def _sizes(plates: Plates, link: str) -> Iterator[tuple[str, str, float, Change]]:
    """Name, eye, value, mm, and change by a unit of every size of a link."""
    along, datum = plates.along(link), plates.datum(link)
    for count, axis in enumerate(plates.bores(link)[1:], start=1):
        place = (axis.places[link] - datum) / along
        if count == 1:
            yield length_name(link), axis.point, place.real, _moved_bore(plates, link, axis, along)
            continue
        first, second = bore_names(link, axis.point)
        yield first, axis.point, place.real, _moved_bore(plates, link, axis, along)
        yield second, axis.point, place.imag, _moved_bore(plates, link, axis, 1j * along)
    for slide in plates.measured(link):
        line = cmath.rect(1.0, number(slide.direction(link)).real)
        value = ((number(slide.place(link)) - datum) / line).imag
        yield line_name(slide, link), slide.name, value, Change({(slide.name, link): 1j * line})


def _moved_bore(plates: Plates, link: str, axis: Axis, way: complex) -> Change:
    """The bore of an axis in a link moves so, with what is traced there."""
    names = [joint.name for joint in axis.joints if link in joint.links]
    names += [path_eye(name) for name in plates.traced(link, axis.places[link])]
    return Change({(name, link): way for name in names})


def _pins(plates: Plates, tolerances: Tolerances, axis: Axis) -> Iterator[Source]:
    sizes, holder, turning = plates.sizes, plates.holder(axis), plates.turning(axis)
    for link in turning:
        carries = (link, holder) if len(turning) == 1 else (link,)
        pressed = [one for one in carries if plates.two_force(one)]
        seen_from = pressed[0] if pressed else link
        way = plates.along(seen_from)
        size = tolerances.pin(
            pin_name(plates, axis, link),
            sizes.pin_diameter,
            sizes.running_fit,
            member=bool(pressed),
            joint=next((one.name for one in axis.joints if link in one.links), ""),
        )
        ways = (way, 1j * way)[: size.components]
        yield Source(size, tuple(Play(link, axis.joints, seen_from, one) for one in ways))


def _gaps(plates: Plates, tolerances: Tolerances, slide: Prismatic) -> Iterator[Source]:
    """A roller moves the line; guide pins also turn the block."""
    sizes = plates.sizes
    line = 1j * cmath.rect(1.0, number(slide.line_angle).real)
    names = gap_names(plates, slide)
    turns = (0.0,) if len(names) == 1 else (1 / sizes.guide_length, -1 / sizes.guide_length)
    for name, turn in zip(names, turns, strict=True):
        size = tolerances.gap(name, gap_fits(plates) * sizes.running_fit, WALLS)
        change = Change({(slide.name, slide.guide): line / len(names)}, {slide.name: turn} if turn else {})
        yield Source(size, (Fixed(change),))


def _traced(plates: Plates, tolerances: Tolerances, name: str, link: str, place: complex) -> Iterator[Source]:
    if link == GROUND or any(abs(axis.places[link] - place) <= SAME_PLACE for axis in plates.bores(link)):
        return
    along = plates.along(link)
    seen = (place - plates.datum(link)) / along
    for part, value, way in (("along", seen.real, along), ("across", seen.imag, 1j * along)):
        own = f"{name}-{part}".lower()
        size = tolerances.length(plates.table.tolerance_names.get(own, own), value)
        yield Source(size, (Fixed(Change({(path_eye(name), link): way})),))


def _turns(plates: Plates) -> bool:
    machine = plates.machine
    return isinstance(machine.driven_joint(machine.drives[0]), Revolute)
