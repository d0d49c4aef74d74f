"""Where the stages of a chain stand in space: each about the shaft that turns it, in a plane of its own."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import GROUND, Joint, Vector
from mechwright.contracts.load import Load
from mechwright.contracts.motion import Poses, Rates
from mechwright.contracts.surroundings import turned
from mechwright.geometry.segments import Point
from mechwright.mechanics.chain.links import Link


@dataclass(frozen=True)
class Placed:
    """A stage in space: turned by ``angle``, rad, about z, then shifted by (x, y, ``level``), mm."""

    link: Link
    angle: float
    shift: Point
    level: float = 0.0

    @property
    def rotation(self) -> Array:
        """(3, 3)."""
        return np.asarray(turned(self.angle))

    def at(self, point: Point) -> Point:
        """Where a point of the stage's plane stands, mm."""
        x, y, _ = self.place((*point, 0.0))
        return x, y

    def place(self, point: Vector) -> Vector:
        """Where a point of the stage stands, mm."""
        x, y, z = (self.rotation @ np.asarray(point)).tolist()
        return x + self.shift[0], y + self.shift[1], z + self.level

    def direct(self, vector: Vector) -> Vector:
        """A direction of the stage in space."""
        x, y, z = (self.rotation @ np.asarray(vector)).tolist()
        return x, y, z

    def poses(self, given: Mapping[str, Poses]) -> dict[str, Poses]:
        """Bodies of the stage in space."""
        turn, shift = self.rotation, np.asarray((*self.shift, self.level))
        found = {}
        for name, one in given.items():
            rates = one.rates
            if rates is not None:
                rates = Rates(turn @ rates.first, turn @ rates.second)
            found[self.link.named(name)] = Poses(one.position @ turn.T + shift, turn @ one.rotation, rates)
        return found

    def joints(self, given: Mapping[str, Joint], driven: str) -> dict[str, Joint]:
        """Joints of the stage in space; ``driven`` is the body that turns its input, empty for its own drive.

        The shaft of a stage that is driven is held with that body.
        """
        found = {}
        for name, one in given.items():
            ground = one.one == GROUND
            said = replace(
                one,
                one=GROUND if ground else self.link.named(one.one),
                two=self.link.named(one.two),
                point=self.place(one.point) if ground else one.point,
                axis=self.direct(one.axis) if ground else one.axis,
            )
            if one.drives and driven:
                said = Joint("fixed", driven, said.two)
            found[self.link.named(name)] = said
        return found

    def loads(self, given: Mapping[str, Load]) -> dict[str, Load]:
        """Loads of the stage in space."""
        return {
            self.link.named(name): replace(
                one,
                body=self.link.named(one.body),
                force=self.direct(one.force),
                torque=self.direct(one.torque),
            )
            for name, one in given.items()
        }


def in_plan(links: tuple[Link, ...]) -> tuple[Placed, ...]:
    """The stages beside each other, all at their own heights: every input stands on the output before it."""
    found: list[Placed] = []
    for link in links:
        angle, port = math.radians(link.table.turned), link.transmission.input
        loose = Placed(link, angle, (0.0, 0.0))
        x, y = loose.at(port.point)
        if found and found[-1].link.transmission.output is not None:
            goal = found[-1].at(found[-1].link.transmission.output.point)
        else:
            goal = port.point
        found.append(replace(loose, shift=(goal[0] - x, goal[1] - y)))
    return tuple(found)
