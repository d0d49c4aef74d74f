"""Adjustable linkages: one set of links, several phases, set in one pose.

Glossary
--------
pose of setting
    The pose in which the machine is set from one phase to another. The path point is the same in all phases
    there: it is the first point of each. The crank angle is counted from it.
moving pivots
    a (crank and coupler) and c (coupler and follower): the joints of the coupler. Where they are set, the
    coupler is held, the crank turns about a0 and the follower about b1; the lengths of both stay.
fixed pivots
    a0 and b0. Where they are set, the coupler keeps its holes.
arm
    Of a geared five-bar, b0 to b1: it turns by ``ratio`` times the crank's angle. A four-bar has none: its b1
    is b0.
"""

from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.adjustable.counts import Moves
from mechwright.mechanics.adjustable.space import Points, Space


@dataclass(frozen=True, slots=True)
class Pins:
    """Pins (..., phases) of all phases in the pose of setting."""

    a0: Points
    a: Points
    b0: Points
    b1: Points
    c: Points
    p: Points

    def of(self, phase: "int | np.ndarray") -> "Pins":
        """The pins of one phase, or of the phases (n,) of n points."""
        return Pins(*(getattr(self, name)[..., phase] for name in self.__slots__))


@dataclass(frozen=True, slots=True)
class Unknowns:
    """What a fit may change, and the pins that follow from it.

    The links' lengths are common to all phases by construction, as their logarithms; the path point in the
    pose of setting is given.

    Parameters
    ----------
    space
        The plane or a sphere.
    bars
        4 or 5.
    moves
        Which pivots are set.
    phases
        How many phases.
    ratio
        Turns of the arm per turn of the crank; 0 for a four-bar.
    arm_turned
        Whether the arm is turned at the setting as well as the crank; else b1 stays.
    """

    space: Space
    bars: int
    moves: Moves
    phases: int
    ratio: float = 0.0
    arm_turned: bool = False

    @property
    def common(self) -> int:
        """Unknowns that all phases share."""
        links = self.bars - 2
        return links + (0 if self.moves == "both" else 4) + (self._arm == "kept")

    @property
    def own(self) -> int:
        """Unknowns of each phase; with fixed pivots the phases after the first have one more."""
        return 2 + (self._arm == "own") + 4 * (self.moves == "both")

    @property
    def size(self) -> int:
        """All unknowns."""
        return self.common + self.phases * self.own + (self.phases - 1) * (self.moves == "fixed")

    @property
    def _arm(self) -> str:
        if self.bars == 4:
            return "none"
        return "own" if self.arm_turned or self.moves != "moving" else "kept"

    def pins(self, x: Array) -> Pins:
        """Pins (..., phases) of unknowns (..., size)."""
        space, links, phases = self.space, self.bars - 2, self.phases
        common = [x[..., [k]] for k in range(self.common)]
        end = self.common + phases * self.own
        rows = x[..., self.common : end].reshape(*x.shape[:-1], phases, self.own)
        own = [rows[..., k] for k in range(self.own)]
        radii = [np.exp(one) for one in common[:links]]
        arm = self._arm_angle(common, own)
        if self.moves == "moving":
            a0, b0 = space.at(*common[links : links + 2]), space.at(*common[links + 2 : links + 4])
            a = space.around(a0, radii[0], own[0])
            b1 = b0 if arm is None else space.around(b0, radii[2], arm)
            c = space.around(b1, radii[1], own[1])
        else:
            places = common[links : links + 4] if self.moves == "fixed" else own[-4:]
            a, c = space.at(*places[:2]), space.at(*places[2:])
            if self.moves == "fixed":
                turned = np.concatenate([np.zeros_like(x[..., :1]), x[..., end:]], axis=-1)
                p = space.pose_point()
                p = p.reshape(p.shape + (1,) * (a.ndim - p.ndim))
                a, c = space.turn(p, turned, a), space.turn(p, turned, c)
            a0 = space.around(a, radii[0], own[0])
            b1 = space.around(c, radii[1], own[1])
            b0 = b1 if arm is None else space.around(b1, radii[2], arm)
        point = space.pose_point()
        point = point.reshape(point.shape + (1,) * (a.ndim - point.ndim))
        return Pins(*np.broadcast_arrays(a0, a, b0, b1, c, point))

    def _arm_angle(self, common: list[Array], own: list[Array]) -> Array | None:
        if self._arm == "none":
            return None
        return common[-1] if self._arm == "kept" else own[2]

    def of_pins(self, pins: Pins) -> Array:
        """The unknowns (..., size) nearest to given pins: mean lengths where these differ.

        Directions are taken as they are, so that pins of one set of links come back exactly.
        """
        space = self.space
        r1, alpha = space.polar(pins.a0, pins.a)
        r3, beta = space.polar(pins.b1, pins.c)
        radii, angles = [r1, r3], [alpha, beta]
        if self.moves != "moving":
            angles = [space.polar(pins.a, pins.a0)[1], space.polar(pins.c, pins.b1)[1]]
        arm = None
        if self.bars == 5:
            r4, out = space.polar(pins.b0, pins.b1)
            arm = out if self.moves == "moving" else space.polar(pins.b1, pins.b0)[1]
            radii.append(r4)
        common = [np.log(r.mean(axis=-1)) for r in radii]
        places = (pins.a0, pins.b0) if self.moves == "moving" else (pins.a, pins.c)
        if self.moves != "both":
            common += [xy[..., 0] for one in places for xy in space.coordinates(one)]
        if arm is not None and self._arm == "kept":
            common.append(arm[..., 0])
        own = [*angles, *([arm] if arm is not None and self._arm == "own" else [])]
        if self.moves == "both":
            own += [xy for one in places for xy in space.coordinates(one)]
        rows = np.stack(own, axis=-1)
        found = [np.stack(common, axis=-1), rows.reshape(*rows.shape[:-2], -1)]
        if self.moves == "fixed":
            seen = space.polar(pins.p, pins.a)[1]
            found.append(seen[..., 1:] - seen[..., :1])
        return np.concatenate(found, axis=-1)


def follow(space: Space, pins: Pins, ratio: float, theta: Array) -> tuple[Points, Array]:
    """Path points (..., n) and cosines (..., n) of the transmission angle.

    Parameters
    ----------
    pins
        One set (..., n) or (..., 1) per sample, in the pose of setting: ``Pins.of``.
    theta
        Crank angles (..., n) from the pose of setting, rad.
    """
    a = space.turn(pins.a0, theta, pins.a)
    b = pins.b1 if ratio == 0 else space.turn(pins.b0, ratio * theta, pins.b1)
    side = space.side(pins.a, pins.b1, pins.c)
    c, cosine = space.third(a, b, space.apart(pins.a, pins.c), space.apart(pins.b1, pins.c), side)
    return space.carried(pins.a, pins.c, pins.p, a, c), cosine
