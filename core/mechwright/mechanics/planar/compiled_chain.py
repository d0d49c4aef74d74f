"""Extremes and samples of a machine of dyads over its period, for many designs at once, compiled.

A chain lists what a machine computes as operations of :mod:`mechwright.mechanics.planar.compiled_dyads`, and
gives the rows in which places, turnings and ways stand. Only what leads to the rows that are asked for is
computed, up to the highest rate among them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.mechanics.planar import compiled_dyads as kinds
from mechwright.mechanics.planar.assembly_order import Driven, Dyad, Geared, Group, assembly_order
from mechwright.mechanics.planar.free_bodies import GROUND
from mechwright.mechanics.planar.machine import Machine, Prismatic, Revolute
from mechwright.mechanics.planar.outer_joints import neighbour, offset_across, offset_from_line

POINT_ROWS, TURNING_ROWS, WAY_ROWS = 8, 5, 4


@dataclass(frozen=True)
class Body:
    """Rows of a link: its turning, and its origin; and how its angle counts.

    ``angle`` are the numbers of :func:`mechwright.mechanics.planar.compiled_dyads.measure_angle`.
    """

    turning: int
    origin: int
    angle: tuple[Any, float, float]


class CompiledChain:
    """The operations of a machine with one drive.

    Parameters
    ----------
    machine
        Links and joints; numbers or columns (n, 1).
    order
        That of :func:`assembly_order`, where it is known.

    Raises
    ------
    NotImplementedError
        It has links that are found together, drives that stand on moving links, or gears that are not on the
        ground: those are moved by :func:`mechwright.mechanics.planar.positions.solve` alone.
    """

    def __init__(self, machine: Machine, order: Sequence[Group] | None = None) -> None:
        self.machine = machine
        self._ops: list[list[int]] = []
        self._inputs: list[tuple[int, ...]] = []
        self._numbers: list[Any] = []
        self._maker: dict[int, int] = {}
        self._order = dict.fromkeys(range(4), 0) | {row: row for row in range(4)}
        self._count = 4
        self._circles: dict[int, float] = {}
        self._known: dict[Any, int] = {}
        self._sines: dict[str, int] = {}
        ground = self._add(kinds.FIXED_TURNING, TURNING_ROWS, (), (0.0,))
        self.bodies = {GROUND: Body(ground, self._fixed(0j), (0.0, 0.0, 1.0))}
        for group in assembly_order(machine) if order is None else order:
            if isinstance(group, Driven):
                self._driven(group)
            elif isinstance(group, Geared):
                self._geared(group)
            elif isinstance(group, Dyad):
                self._dyad(group)
            else:
                raise NotImplementedError("links that are found together")

    def point(self, link: str, place: Any) -> int:
        """The first of the eight rows of a place of a link, x + i y, mm: x, y, and x and y of each rate."""
        key = ("point", link, id(place) if np.ndim(place) else complex(place))
        if key not in self._known:
            self._known[key] = self._placed(self.bodies[link], place, fixed=link == GROUND)
        return self._known[key]

    def turning(self, link: str) -> int:
        """The first of the five rows of a turning: cosine, sine, and three rates, rad/s and on."""
        return self.bodies[link].turning

    def angle(self, link: str) -> int:
        """The row of a link's angle, rad, counted as ``positions.solve`` counts it."""
        key = ("angle", link)
        if key not in self._known:
            self._known[key] = self._add(kinds.ANGLE, 1, (self.turning(link),), self.bodies[link].angle)
        return self._known[key]

    def way(self, slide: Prismatic) -> int:
        """The first of the four rows of the way of a slide's block along its guide, mm, with its rates."""
        key = ("way", slide.name)
        if key not in self._known:
            line, turning = self._line(slide, slide.guide)
            point = self.point(slide.block, slide.point)
            self._known[key] = self._add(kinds.WAY, WAY_ROWS, (point, line, turning), ())
        return self._known[key]

    def sine(self, joint: str) -> int:
        """The row of the sine of a dyad's transmission angle, by its inner joint; its cosine is the next one.

        Both have signs.
        """
        return self._sines[joint]

    @property
    def dyads(self) -> tuple[str, ...]:
        """The inner joints of all dyads."""
        return tuple(self._sines)

    def least_sine(self) -> int:
        """The row of the smallest size of the sines of all dyads, of which there must be one."""
        if "least sine" not in self._known:
            first, *rows = self._sines.values()
            found = self._add(kinds.SMALLER, 1, (first, first), ())
            for row in rows:
                found = self._add(kinds.SMALLER, 1, (found, row), ())
            self._known["least sine"] = found
        return self._known["least sine"]

    drive = kinds.DRIVE
    """The first of the four rows of the input, rad or mm, and its rates."""

    def extremes(self, drives: Array, wanted: Sequence[tuple[int, int]], samples: int) -> Array:
        """Least and greatest values (n, k, 2) over a period; NaN where the machine does not close.

        Parameters
        ----------
        drives
            (n, 5): start and travel of the input, rad or mm, whether it rocks, its acceleration ratio, and
            its speed, rad/s, as :class:`mechwright.mechanics.planar.course.Course` has them. The travels of
            those that do not rock differ in their signs alone.
        wanted
            Rows, and of how many of the samples one is taken.
        samples
            Over the period, both ends included.
        """
        from mechwright.mechanics.planar import compiled_run

        rows: NDArray[np.int64] = np.array(wanted, dtype=np.int64).reshape(-1, 2)
        found: Array = compiled_run.extremes(*self._asked(drives, samples, rows[:, 0], rows))
        return found

    def sampled(self, drives: Array, wanted: Sequence[int], samples: int) -> Array:
        """Values (n, k, samples) of rows; see :meth:`extremes`."""
        from mechwright.mechanics.planar import compiled_run

        rows: NDArray[np.int64] = np.array(wanted, dtype=np.int64)
        found: Array = compiled_run.sampled(*self._asked(drives, samples, rows, rows))
        return found

    def values(self, inputs: Array, wanted: Sequence[int]) -> Array:
        """Values (n, k, m) of rows at inputs (n, m), rad or mm, with rates per unit of the input."""
        from mechwright.mechanics.planar import compiled_run

        rows: NDArray[np.int64] = np.array(wanted, dtype=np.int64)
        ops, rates, _ = self._needed(rows)
        numbers = self._numbers_of(len(inputs))
        found: Array = compiled_run.valued(
            ops, numbers, np.ascontiguousarray(inputs, dtype=float), rows, rates, self._count
        )
        return found

    def _asked(
        self, drives: Array, samples: int, rows: NDArray[np.int64], wanted: NDArray[np.int64]
    ) -> tuple[Any, ...]:
        """The arguments of the compiled functions, for the operations that the rows need."""
        ops, rates, some = self._needed(rows)
        turning = drives[drives[:, kinds.ROCKS] == 0, kinds.TRAVEL]
        travel = abs(float(turning[0])) if turning.size else 2 * np.pi
        share = np.linspace(0.0, 1.0, samples)
        angles = [2 * np.pi * share]
        angles += [self._circles[op] * travel * share for op in some if op in self._circles]
        circles = np.ascontiguousarray([[np.cos(one), np.sin(one)] for one in angles])
        numbers, given = self._numbers_of(len(drives)), np.ascontiguousarray(drives, dtype=float)
        return ops, numbers, given, circles, wanted, rates, self._count

    def _needed(self, rows: NDArray[np.int64]) -> tuple[NDArray[np.int64], int, list[int]]:
        """The operations (j, 7) that rows need, the highest rate, and the numbers of the operations."""
        needed = {self._maker[row] for row in rows.tolist() if row in self._maker}
        for op in range(len(self._ops) - 1, -1, -1):
            if op in needed:
                needed |= {self._maker[row] for row in self._inputs[op] if row in self._maker}
        some = sorted(needed)
        ops = np.array([self._ops[op] for op in some], dtype=np.int64).reshape(-1, 7)
        return ops, max(self._order[row] for row in rows.tolist()), some

    def _numbers_of(self, size: int) -> Array:
        """The numbers of all designs (n, q)."""
        numbers = np.empty((size, max(len(self._numbers), 1)))
        for place, one in enumerate(self._numbers):
            numbers[:, place] = np.broadcast_to(np.ravel(one), size)
        return numbers

    def _add(
        self, kind: int, rows: int, inputs: tuple[int, ...], numbers: tuple[Any, ...], *more: int
    ) -> int:
        """An operation and its first row; ``more`` are further rows that it fills, of turnings."""
        out = self._count
        self._count += rows
        fields = (*inputs, *more, 0, 0, 0, 0)[:4]
        self._ops.append([kind, out, *fields, len(self._numbers)])
        self._numbers += numbers
        self._inputs.append(inputs)
        op = len(self._ops) - 1
        for row in range(rows):
            self._maker[out + row] = op
            pairs = {POINT_ROWS: row // 2, TURNING_ROWS: max(row - 1, 0), WAY_ROWS: row, 1: 0}
            self._order[out + row] = pairs.get(rows, row if row < WAY_ROWS else 0)
        for first in more:
            for row in range(TURNING_ROWS):
                self._maker[first + row], self._order[first + row] = op, max(row - 1, 0)
        return out

    def _turning_rows(self) -> int:
        self._count += TURNING_ROWS
        return self._count - TURNING_ROWS

    def _fixed(self, place: Any) -> int:
        return self._add(kinds.FIXED_POINT, POINT_ROWS, (), (np.real(place), np.imag(place)))

    def _placed(self, body: Body, place: Any, *, fixed: bool) -> int:
        if not np.any(place):
            return body.origin
        if fixed:
            return self._fixed(place)
        return self._add(
            kinds.POINT, POINT_ROWS, (body.origin, body.turning), (np.real(place), np.imag(place))
        )

    def _rotated(self, turning: int, angle: Any, *, fixed: bool = False) -> int:
        if not np.any(angle):
            return turning
        if fixed:
            return self._add(kinds.FIXED_TURNING, TURNING_ROWS, (), (angle,))
        return self._add(kinds.ROTATED, TURNING_ROWS, (turning,), (angle,))

    def _line(self, joint: Prismatic, link: str) -> tuple[int, int]:
        """Rows of the point and of the direction of a slide's line, as the link has it."""
        body, fixed = self.bodies[link], link == GROUND
        return self.point(link, joint.place(link)), self._rotated(
            body.turning, joint.direction(link), fixed=fixed
        )

    def _body(self, link: str, pin: int, place: Any, turning: int, angle: tuple[Any, float, float]) -> None:
        """A link that turns so and has its place at a pin."""
        found = Body(turning, pin, angle)
        origin = self._placed(found, -np.asarray(place, complex), fixed=False)
        self.bodies[link] = Body(turning, origin, angle)

    def _driven(self, group: Driven) -> None:
        joint = group.joint
        if group.on != GROUND or self.machine.drives[group.drive].link != group.link:
            raise NotImplementedError("drives on moving links")
        if isinstance(joint, Revolute):
            turning = self._add(kinds.CRANK, TURNING_ROWS, (), (1.0, 0.0))
            self._circles[len(self._ops) - 1] = 1.0
            pin = self.point(GROUND, joint.place(GROUND))
            self._body(group.link, pin, joint.place(group.link), turning, (0.0, 1.0, 1.0))
            return
        if joint.guide != GROUND:
            raise NotImplementedError("drives along moving lines")
        line, turning = self._line(joint, GROUND)
        pin = self._add(kinds.SLID, POINT_ROWS, (line, turning, kinds.DRIVE), (0.0,))
        angle = joint.line_angle - np.asarray(joint.block_angle)
        own = self._rotated(self.bodies[GROUND].turning, angle, fixed=True)
        self._body(group.link, pin, joint.place(group.link), own, (angle, 0.0, 1.0))

    def _geared(self, group: Geared) -> None:
        gears = group.gears
        forwards = group.link == gears.two
        mate = gears.one if forwards else gears.two
        driven = [drive.link for drive in self.machine.drives]
        if gears.carrier != GROUND or mate not in driven or GROUND not in group.pin.links:
            raise NotImplementedError("gears that are not on the ground")
        ratio = gears.ratio if forwards else 1 / gears.ratio
        phase = gears.phase if forwards else -gears.phase / gears.ratio
        turning = self._add(kinds.GEAR, TURNING_ROWS, (), (ratio, phase))
        self._circles[len(self._ops) - 1] = float(ratio)
        pin = self.point(GROUND, group.pin.place(GROUND))
        self._body(group.link, pin, group.pin.place(group.link), turning, (phase, float(ratio), 1.0))

    def _outer(self, joint: Revolute | Prismatic, link: str) -> int:
        stands = neighbour(joint, link)
        return self.point(stands, joint.place(stands))

    def _dyad(self, group: Dyad) -> None:
        inner, (first, last), (one, two) = group.inner, group.outer, group.links
        branch = self.machine.branches.get(inner.name, 1)
        if isinstance(first, Revolute) and isinstance(last, Revolute):
            ends = self._outer(first, one), self._outer(last, two)
            if isinstance(inner, Revolute):
                self._pins(group, ends, branch)
            else:
                self._slide_between(group, ends, branch)
            return
        assert isinstance(last, Prismatic)  # noqa: S101 - as groups are ordered
        line, turning, own, counted = self._along(last, two)
        offset = offset_from_line(last, two, inner.place(two))
        if isinstance(first, Revolute) and isinstance(inner, Revolute):
            bar = inner.place(one) - np.asarray(first.place(one), complex)
            numbers = (np.abs(bar), offset, branch, -np.angle(bar))
            end, swung = self._outer(first, one), self._turning_rows()
            way = self._add(kinds.PIN_AND_SLIDE, 6, (end, line, turning), numbers, swung)
            self._body(one, end, first.place(one), swung, (-np.angle(bar), 0.0, 0.0))
            pin = self.point(one, inner.place(one))
            if last.block == two and not np.any(inner.place(two) - np.asarray(last.point)):
                self._known["way", last.name] = way
        elif isinstance(first, Prismatic):  # PRP: the pin slides along two lines
            other, side, leaning, sidewards = self._along(first, one)
            across = offset_from_line(first, one, inner.place(one))
            way = self._add(kinds.CROSSING, 6, (other, side, line, turning), (across, offset))
            pin = self._add(kinds.SLID, POINT_ROWS, (other, side, way), (across,))
            self._body(one, pin, inner.place(one), leaning, sidewards)
        else:  # RPP: the second link slides on what stands, and the first, pinned to what stands, on it
            assert isinstance(inner, Prismatic)  # noqa: S101 - as groups are ordered
            across = self._rotated(own, inner.direction(two))
            leaning = self._rotated(across, -np.asarray(inner.direction(one)))
            turn = inner.direction(two) - np.asarray(inner.direction(one))
            self._body(one, self._outer(first, one), first.place(one), leaning, _further(counted, turn))
            lines = (line, turning, self.point(one, inner.place(one)), across)
            way = self._add(kinds.CROSSING, 6, lines, (offset, 0.0))
            pin = self._add(kinds.SLID, POINT_ROWS, (line, turning, way), (offset,))
        self._body(two, pin, inner.place(two), own, counted)
        self._sines[inner.name] = way + 4

    def _along(self, joint: Prismatic, link: str) -> tuple[int, int, int, tuple[Any, float, float]]:
        """Rows of the point and the direction of a slide's line, and of the turning of the link along it.

        Besides how its angle counts.
        """
        stands = neighbour(joint, link)
        line, turning = self._line(joint, stands)
        back = -np.asarray(joint.direction(link))
        counted = _further(self.bodies[stands].angle, joint.direction(stands) + back)
        if stands == GROUND:
            own = self._rotated(self.bodies[GROUND].turning, joint.direction(GROUND) + back, fixed=True)
            return line, turning, own, counted
        return line, turning, self._rotated(turning, back), counted

    def _pins(self, group: Dyad, ends: tuple[int, int], branch: Any) -> None:
        inner, (first, last), (one, two) = group.inner, group.outer, group.links
        bars = [
            inner.place(link) - np.asarray(outer.place(link), complex)
            for outer, link in ((first, one), (last, two))
        ]
        numbers = (*(np.abs(bar) for bar in bars), branch, *(-np.angle(bar) for bar in bars))
        turnings = self._turning_rows(), self._turning_rows()
        self._sines[inner.name] = self._add(kinds.PINS, 2, ends, numbers, *turnings)
        for link, outer, end, turning, bar in zip(
            (one, two), (first, last), ends, turnings, bars, strict=True
        ):
            self._body(link, end, outer.place(link), turning, (-np.angle(bar), 0.0, 0.0))

    def _slide_between(self, group: Dyad, ends: tuple[int, int], branch: Any) -> None:
        inner, (first, last), (one, two) = group.inner, group.outer, group.links
        assert isinstance(inner, Prismatic)  # noqa: S101 - as groups are ordered
        offset = offset_across(inner, first.place(one), last.place(two), one)
        line = self._turning_rows()
        self._sines[inner.name] = self._add(kinds.SLIDE_BETWEEN, 2, ends, (offset, branch), line)
        for link, outer, end in zip((one, two), (first, last), ends, strict=True):
            angle = np.asarray(inner.direction(link))
            self._body(link, end, outer.place(link), self._rotated(line, -angle), (-angle, 0.0, 0.0))


def _further(angle: tuple[Any, float, float], turn: Any) -> tuple[Any, float, float]:
    """How the angle of a link counts that is turned on from another one."""
    return angle[0] + np.asarray(turn), angle[1], angle[2]
