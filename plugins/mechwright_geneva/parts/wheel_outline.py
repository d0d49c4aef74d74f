"""The wheel's outline: rim, concave arcs, and, where they are cut through, slots and islands."""

import math
from dataclasses import dataclass
from functools import cached_property

from mechwright import Arc, GeometryError, Loop, Point, Segment
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.parts.slot_outline import Slot


@dataclass(frozen=True)
class Wheel:
    """The wheel of a mechanism, in its own frame: concave arc 0 on +x, slot 0 at -θw0."""

    mechanism: Mechanism

    @cached_property
    def slot(self) -> Slot:
        """Slot 0 as it is cut, clearance included."""
        return Slot(self.mechanism, self.mechanism.groove)

    @property
    def horn_angle(self) -> float:
        """Polar angle ψ_L of the corner between concave arc and rim from the middle of the arc."""
        m = self.mechanism
        if not 0 < m.horn_angle < math.pi:
            raise GeometryError(
                f"a locking disc of {m.lock:.3f} mm does not reach the wheel, whose axis is {m.axes:.3f} mm "
                f"away and whose radius is {m.rim:.3f} mm"
            )
        return m.horn_angle

    def _bite(self) -> Segment:
        """Concave arc 0, from its lower horn to its upper one."""
        half = self.mechanism.arc_half
        return Arc((self.mechanism.axes, 0.0), self.mechanism.arc, math.pi + half, -2 * half, "lock")

    def _rim(self, start: float, end: float) -> Segment:
        return Arc((0.0, 0.0), self.mechanism.rim, start, end - start, "rim")

    def disc(self) -> Loop:
        """The outside without slots: rim and concave arcs, counter-clockwise."""
        step = 2 * self.mechanism.wheel_half
        pieces: list[Segment] = []
        for k in range(self.mechanism.slots):
            bite = self._bite().moved(0, 0, k * step)
            pieces += [bite, self._rim(k * step + self.horn_angle, (k + 1) * step - self.horn_angle)]
        return Loop(tuple(pieces))

    def _hub_wall(self) -> tuple[list[Segment], float]:
        """The wall on the hub's side, counter-clockwise about the wheel, and its deviation."""
        m = self.mechanism
        if m.straight:
            left, right = (self.slot.wall(side, trimmed=True) for side in (LEFT, RIGHT))
            return [*left.segments, *(s.reversed() for s in right.segments[::-1])], 0.0
        wall = self.slot.wall(-m.side, trimmed=True)
        if m.side < 0:
            return list(wall.segments), wall.deviation
        return [segment.reversed() for segment in wall.segments[::-1]], wall.deviation

    def slotted(self) -> tuple[Loop, float]:
        """The outside with the slots cut through and the islands gone, and its deviation."""
        step, psi = 2 * self.mechanism.wheel_half, self.horn_angle
        wall, deviation = self._hub_wall()
        low, high = _angle(wall[0].start), _angle(wall[-1].end)
        sector = [self._bite().moved(0, 0, -step), self._rim(psi - step, low), *wall, self._rim(high, -psi)]
        return Loop(
            tuple(s.moved(0, 0, k * step) for k in range(self.mechanism.slots) for s in sector)
        ), deviation

    def island(self) -> tuple[Loop, float]:
        """Island 0, counter-clockwise, and its deviation."""
        m = self.mechanism
        wall = self.slot.wall(m.side, trimmed=True)
        segments = list(wall.segments)
        if m.side > 0:
            segments = [segment.reversed() for segment in segments[::-1]]
        # Now from the mouth at the smaller polar angle inwards and out again: clockwise about the island.
        rim = self._rim(_angle(segments[0].start), _angle(segments[-1].end))
        return Loop((rim, *(segment.reversed() for segment in segments[::-1]))), wall.deviation


def _angle(point: Point) -> float:
    return math.atan2(point[1], point[0])
