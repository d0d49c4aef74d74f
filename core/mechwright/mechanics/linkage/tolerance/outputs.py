"""What is judged of a linkage: the angle or the way of its output, and its traced points."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.tolerances import Output
from mechwright.mechanics.linkage.kinematics.channels import turning_links
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.parts.axes import number
from mechwright.mechanics.linkage.parts.outlines import path_eye
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Prismatic
from mechwright.mechanics.planar.rigid import Plane
from mechwright.mechanics.planar.sensitivity import Change, Pose


class Judged(Protocol):
    """An output and its formulas."""

    @property
    def output(self) -> Output:
        """Its name and unit."""
        ...

    def value(self, poses: Mapping[str, Pose], change: Change) -> Array:
        """The output (c, d) at poses of a machine whose numbers are changed."""
        ...

    def rate(self, poses: Mapping[str, Pose], moved: Mapping[str, Pose], change: Change) -> Array:
        """Its derivative (c, d) by a change with which the links move so."""
        ...

    def error(self, made: Array, nominal: Array) -> Array:
        """Their difference (c, d)."""
        ...


@dataclass(frozen=True)
class Angle:
    """The angle of a link."""

    link: str
    output: Output

    def value(self, poses: Mapping[str, Pose], change: Change) -> Array:  # noqa: ARG002 - of its pose alone
        """Rad."""
        return poses[self.link].angle[None]

    def rate(self, poses: Mapping[str, Pose], moved: Mapping[str, Pose], change: Change) -> Array:  # noqa: ARG002
        """By the unit of the change."""
        return moved[self.link].angle[None]

    def error(self, made: Array, nominal: Array) -> Array:
        """Less than half a turn."""
        return np.asarray(np.angle(np.exp(1j * (made - nominal))))


@dataclass(frozen=True)
class Way:
    """The way of a block along a line of the ground."""

    slide: Prismatic
    output: Output

    def value(self, poses: Mapping[str, Pose], change: Change) -> Array:
        """From the line's own point, mm."""
        pose = poses[self.slide.block]
        point = self.slide.point + change.place(self.slide.name, self.slide.block)
        line = self.slide.line + change.place(self.slide.name, self.slide.guide)
        return self._along(pose.origin + point * pose.direction - line)[None]

    def rate(self, poses: Mapping[str, Pose], moved: Mapping[str, Pose], change: Change) -> Array:
        """By the unit of the change."""
        pose, own = poses[self.slide.block], moved[self.slide.block]
        point = change.place(self.slide.name, self.slide.block)
        line = change.place(self.slide.name, self.slide.guide)
        turn = 1j * self.slide.point * own.angle
        return self._along(own.origin + (turn + point) * pose.direction - line)[None]

    def error(self, made: Array, nominal: Array) -> Array:
        """In mm."""
        return made - nominal

    def _along(self, place: Plane) -> Array:
        return np.asarray((place * np.exp(-1j * np.asarray(self.slide.line_angle))).real)


@dataclass(frozen=True)
class Point:
    """A point of a link: a traced one by its ``eye``, or the origin."""

    link: str
    place: complex
    eye: str
    output: Output

    def value(self, poses: Mapping[str, Pose], change: Change) -> Array:
        """X and Y, mm."""
        pose = poses[self.link]
        return _parts(pose.origin + (self.place + change.place(self.eye, self.link)) * pose.direction)

    def rate(self, poses: Mapping[str, Pose], moved: Mapping[str, Pose], change: Change) -> Array:
        """By the unit of the change."""
        pose, own = poses[self.link], moved[self.link]
        lever = 1j * self.place * own.angle + change.place(self.eye, self.link)
        return _parts(own.origin + lever * pose.direction)

    def error(self, made: Array, nominal: Array) -> Array:
        """In mm."""
        return made - nominal


def _parts(place: Plane) -> Array:
    return np.stack([place.real, place.imag])


def outputs_of(linkage: Linkage, names: Mapping[str, str] | None = None) -> list[Judged]:
    """The output first, then the traced points; ``names`` replace those of outputs."""
    given = names or {}
    link, machine = linkage.output, linkage.machine
    slides = [one for one in machine.between(link, GROUND) if isinstance(one, Prismatic)]
    found: list[Judged] = []
    if link in turning_links(machine):
        found.append(Angle(link, Output(f"{link} angle".lower(), "rad")))
    elif slides and slides[0].block == link:
        found.append(Way(slides[0], Output(f"{link} position".lower(), "mm")))
    else:
        found.append(Point(link, 0j, "", Output(f"{link} position".lower(), "mm", 2)))
    for name, (own, point) in linkage.traces.items():
        place = number(linkage.points[own][point])
        found.append(
            Point(own, place, path_eye(name), Output(given.get(f"point {name}", f"point {name}"), "mm", 2))
        )
    return found
