"""The wheel's outline: rim, concave arcs, and, where they are cut through, slots and islands."""

import math
from dataclasses import dataclass
from functools import cached_property

from mechwright import Arc, Loop, Point, Segment
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.parts.slot_outline import Slot, backwards


@dataclass(frozen=True)
class Wheel:
    """The wheel of a mechanism, in its own frame: concave arc 0 on +x, slot 0 at -θw0."""

    mechanism: Mechanism

    @cached_property
    def slot(self) -> Slot:
        """Slot 0 as it is cut, clearance included."""
        return Slot(self.mechanism)

    def _bite(self) -> Segment:
        """Concave arc 0, from its lower horn to its upper one."""
        m = self.mechanism
        return Arc((m.axes, 0.0), m.arc, math.pi + m.arc_half, -2 * m.arc_half, "lock")

    def _rim(self, start: float, end: float) -> Segment:
        return Arc((0.0, 0.0), self.mechanism.rim, start, end - start, "rim")

    def disc(self) -> Loop:
        """The outside without slots: rim and concave arcs, counter-clockwise."""
        step, psi = 2 * self.mechanism.wheel_half, self.mechanism.horn_angle
        pieces: list[Segment] = []
        for k in range(self.mechanism.slots):
            pieces += [self._bite().moved(0, 0, k * step), self._rim(k * step + psi, (k + 1) * step - psi)]
        return Loop(tuple(pieces))

    def _wall(self, side: int) -> tuple[list[Segment], float]:
        """A wall from its mouth at the smaller polar angle inwards and out again, and its deviation."""
        if self.mechanism.straight:
            left, right = (self.slot.wall(one, trimmed=True) for one in (LEFT, RIGHT))
            return [*left.segments, *backwards(right.segments)], 0.0
        wall = self.slot.wall(side, trimmed=True)
        forwards = self.mechanism.side < 0
        return list(wall.segments) if forwards else backwards(wall.segments), wall.deviation

    def slotted(self) -> tuple[Loop, float]:
        """The outside with the slots cut through and the islands gone, and its deviation."""
        step, psi = 2 * self.mechanism.wheel_half, self.mechanism.horn_angle
        wall, deviation = self._wall(-self.mechanism.side)
        low, high = _angle(wall[0].start), _angle(wall[-1].end)
        sector = [self._bite().moved(0, 0, -step), self._rim(psi - step, low), *wall, self._rim(high, -psi)]
        return Loop(
            tuple(s.moved(0, 0, k * step) for k in range(self.mechanism.slots) for s in sector)
        ), deviation

    def island(self) -> tuple[Loop, float]:
        """Island 0, counter-clockwise, and its deviation."""
        wall, deviation = self._wall(self.mechanism.side)
        rim = self._rim(_angle(wall[0].start), _angle(wall[-1].end))
        return Loop((rim, *backwards(wall))), deviation


def _angle(point: Point) -> float:
    return math.atan2(point[1], point[0])
