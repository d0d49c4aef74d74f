"""Play of a pair whose flanks are not where the rack would put them: closed form at the points of contact.

With the pitch point at arc s, every flank of the driver that crosses the pitch curve within reach touches its
mate on the flank's normal through the pitch point. Of what stands there beyond the exact flanks, d2 on the
driver and d4 on the driven gear, the normal gap is

    g = j cos α / 2 - (d2 + d4) + v·n,

v being how far the driven gear's axis is off its place and n the normal, from driver to driven gear. The
driven gear may turn by g over the lever of n about its axis until that flank meets. All is of first order in
d and v: on 20 µm it is right to a tenth of a micrometre.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.mechanics.gearing.mesh import swing
from mechwright.mechanics.gearing.pair import Pair
from mechwright.mechanics.gearing.rack import SIDES
from mechwright.mechanics.gearing.teeth import Teeth
from mechwright.mechanics.gearing.zone import turned


@dataclass(frozen=True)
class Gaps:
    """What stands between the flanks of a pair over the run until the same teeth meet again.

    Arrays are over contacts (m,), several at each position.

    Parameters
    ----------
    theta
        θ1 (n,) of the positions, rad.
    position
        Index of a contact's position.
    gap
        Normal gap, mm; below 0 the outlines stand in each other.
    lever
        Of the normal about the driven gear's axis, mm: below 0 the flank stops a turn ahead, which is
        counter-clockwise, above 0 one behind.
    normal
        (m, 2) unit vectors from driver to driven gear; x from the driver's axis to the other.
    """

    theta: Array
    position: NDArray[np.int64]
    gap: Array
    lever: Array
    normal: Array

    def play(self, shift: tuple[float, float] | Array = (0.0, 0.0), more: float = 0.0) -> tuple[Array, Array]:
        """Play (n,) ahead and behind, rad.

        Parameters
        ----------
        shift
            By how much the driven gear's axis is off, mm: one vector, or one at each position (n, 2).
        more
            Added to every gap, mm.
        """
        v = np.broadcast_to(np.asarray(shift, dtype=float), (self.theta.size, 2))[self.position]
        turn = (self.gap + more + (v * self.normal).sum(axis=1)) / np.abs(self.lever)
        ahead, behind = np.full(self.theta.size, np.inf), np.full(self.theta.size, np.inf)
        for play, which in ((ahead, self.lever < 0), (behind, self.lever > 0)):
            np.minimum.at(play, self.position[which], turn[which])
        return ahead, behind


@dataclass(frozen=True)
class Contacts:
    """Where exact flanks touch, at positions as those of :func:`mesh`; arrays are those of :class:`Gaps`.

    ``driver`` and ``driven`` are the points (m, 2), mm, each in the body frame of its gear; ``room`` is the
    normal gap that the backlash leaves, mm.
    """

    theta: Array
    position: NDArray[np.int64]
    driver: Array
    driven: Array
    lever: Array
    normal: Array
    room: float

    @classmethod
    def of(
        cls, pair: Pair, driver: Teeth, positions: int | None = None, mate: Teeth | None = None
    ) -> "Contacts":
        """Those of a pair; ``driver`` tells where its flanks cross the pitch curve.

        ``mate`` are the teeth of the driven gear, where a pitch curve is hollow and tips reach farther.
        """
        rack, curve = driver.rack, pair.driver
        arc = pair.run(driver.wheel, positions)
        theta1, theta2 = pair.angles(arc)
        sin, cos = math.sin(rack.pressure_angle), math.cos(rack.pressure_angle)
        # How far a flank may cross from the pitch point to touch below the tips of both gears.
        reach = rack.addendum / (sin * cos)
        if mate is not None:
            reach = max(reach, driver.tip_reach, mate.tip_reach)
        away = (arc[:, None, None] - driver.meeting_arcs) % curve.perimeter
        away -= np.where(away > curve.perimeter / 2, curve.perimeter, 0.0)
        position, tooth, side = np.nonzero(np.abs(away) <= reach)
        start, sign = arc[position] - away[position, tooth, side], SIDES[side]
        frame = curve.frame_at(arc[position])
        points = rack.flank(frame, start, sign)
        outward = sin * frame.normal - (sign * cos)[:, None] * frame.tangent
        room = rack.backlash * cos / 2
        touching = turned(points + room * outward, theta1[position])
        normal = turned(outward, theta1[position])
        arm = touching - (pair.axis, 0.0)
        lever = arm[:, 0] * normal[:, 1] - arm[:, 1] * normal[:, 0]
        return cls(theta1, position, points, turned(arm, -theta2[position]), lever, normal, room)

    def gaps(self, depth: Array | float) -> Gaps:
        """The gaps with flanks that stand out by ``depth`` (m,), mm, on both gears together."""
        return Gaps(self.theta, self.position, self.room - depth + 0 * self.lever, self.lever, self.normal)

    def between(self, driver: Array, driven: Array) -> Gaps:
        """The gaps between outlines (n, 2) and (k, 2), mm, material on the left, each in its body frame."""
        return self.gaps(signed_depth(driver, self.driver) + signed_depth(driven, self.driven))


def signed_depth(outline: Array, points: Array) -> Array:
    """Distance (n,) of points from a closed outline, mm: positive in the material, negative outside.

    The material lies on the left of the outline, which is an opening where it runs clockwise.

    Examples
    --------
    >>> square = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])
    >>> signed_depth(square, np.array([[1.0, 2.0], [5.0, 2.0]])).tolist()
    [1.0, -1.0]
    >>> signed_depth(square[::-1], np.array([[1.0, 2.0], [5.0, 2.0]])).tolist()
    [-1.0, 1.0]
    """
    import shapely

    edges = shapely.linestrings(np.stack((outline, np.roll(outline, -1, axis=0)), axis=1))
    _, distance = shapely.STRtree(edges).query_nearest(
        shapely.points(points), return_distance=True, all_matches=False
    )
    whole = shapely.Polygon(outline)
    shapely.prepare(whole)
    inside = shapely.contains_xy(whole, points[:, 0], points[:, 1]) == shapely.is_ccw(whole.exterior)
    signed: Array = np.where(inside, distance, -distance)
    return signed


def error_of(play: tuple[Array, Array]) -> float:
    """Transmission error, rad: peak to peak of the play of one flank, the larger of both."""
    return max(map(swing, play))
