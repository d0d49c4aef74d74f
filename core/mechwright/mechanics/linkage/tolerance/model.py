"""Errors of a linkage's output and traced points, to first order and exact.

Sensitivities are those of the joint equations at the nominal pose, one linear system for all contributors.
Exact errors come of the machine with changed numbers: dyads in closed form, and where links are followed or
geared, all links by Newton's method from the nominal pose.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.tolerance_settings import Tolerances
from mechwright.contracts.tolerances import ToleranceModel
from mechwright.mechanics.linkage.kinematics.channels import PHI, STROKE
from mechwright.mechanics.linkage.kinematics.period import course_of
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.linkage.tolerance.contributors import Source, sources_of
from mechwright.mechanics.linkage.tolerance.outputs import Judged, outputs_of
from mechwright.mechanics.linkage.tolerance.plates import Plates
from mechwright.mechanics.planar import Course
from mechwright.mechanics.planar.assembly_order import Cluster, Driven, Dyad, Geared, assembly_order
from mechwright.mechanics.planar.input_range import period_turns
from mechwright.mechanics.planar.machine import GearPair, Machine
from mechwright.mechanics.planar.machine import Pose as Drawn
from mechwright.mechanics.planar.positions import Solution, solve
from mechwright.mechanics.planar.rigid import Turning
from mechwright.mechanics.planar.sensitivity import Change, Pose, changed, sensitivities

POSITIONS = 361
"""Positions over a turn or a swing."""

SINGULAR = 1e-6
"""Smallest singular value over the largest one of links that are followed, below which a first order says
nothing."""

BLOCK = 4096
"""Mechanisms that are closed at once: their arrays stay in the cache of a core."""

Poses = dict[str, Pose]


class MachineTolerances(ToleranceModel):
    """The model of one design, whose contributors and outputs a family lists; inputs count as in the motion.

    Parameters
    ----------
    table
        The design.
    course
        The way of its input.
    sources, outputs
        What varies, and what is judged.
    """

    most_positions: ClassVar[int] = 3601
    """At most over all turns of geared links."""
    judges_gears: ClassVar[bool] = False
    """Whether errors of gears are among the contributors."""

    def __init__(
        self, table: AnyPlanarTable, course: Course, sources: Sequence[Source], outputs: Sequence[Judged]
    ) -> None:
        self.machine, self.order, self.dead_sine = table.machine, table.order, table.dead_sine
        self.input_name, self.input_unit = (STROKE, "mm") if table.driver_slides else (PHI, "rad")
        self.turn = 0.0 if course.rocks else abs(course.travel)
        if course.rocks:
            self.positions = np.sort(course.way(POSITIONS))
        else:
            count = min(period_turns(table.machine) * (POSITIONS - 1) + 1, self.most_positions)
            self.positions = table.drawn_at + np.linspace(0.0, self.turn, count)
        self.sources = sources
        self.judged = {one.output.name: one for one in outputs}
        self.contributors = tuple(one.contributor for one in self.sources)
        self.outputs = tuple(one.output for one in self.judged.values())
        self._kept: tuple[bytes, Poses, Array] | None = None
        self.closed_form = all(isinstance(group, Driven | Geared | Dyad) for group in self.order)
        self.told = tuple(self._told())

    def _sources(self, table: AnyPlanarTable, tolerances: Tolerances) -> list[Source]:
        """The contributors and what they change."""
        return sources_of(Plates.of(table), tolerances)

    def _judged(self, table: AnyPlanarTable) -> list[Judged]:
        """The outputs."""
        return outputs_of(table.linkage, table.tolerance_names)

    def _told(self) -> list[str]:
        found = []
        if not self.judges_gears and any(isinstance(joint, GearPair) for joint in self.machine.joints):
            found.append("errors and play of the gears' teeth are not among the contributors")
        dead = np.logical_not(self._poses(self.positions)[1])
        if dead.any():
            found.append(
                f"at {dead.sum()} of {dead.size} positions the links are near a dead point, where no error "
                "is in proportion to a tolerance"
            )
        return found

    def nominal(self, output: str, at: Array) -> Array:
        """The output's angle, rad, or its way, mm; a traced point on the ground, mm."""
        value = self.judged[output].value(self._poses(at)[0], Change())
        return value.reshape(value.shape[0], *np.shape(at))

    def sensitivities(self, output: str, at: Array) -> list[Array]:
        """From the Jacobian of the joint equations."""
        poses, moves = self._poses(at)
        changes = [[effect.at(poses) for effect in one.effects] for one in self.sources]
        moved = iter(sensitivities(self.machine, poses, [change for own in changes for change in own]))
        judged, found = self.judged[output], []
        for own in changes:
            rates = [np.where(moves, judged.rate(poses, next(moved), change), np.nan) for change in own]
            row = np.stack(rates, axis=1)
            found.append(row.reshape(*row.shape[:2], *np.shape(at)))
        return found

    def errors(self, output: str, deviations: Sequence[Array], at: Array) -> Array:
        """The machine with changed numbers, closed anew."""
        at = np.asarray(at, float)
        shape = np.broadcast_shapes(at.shape, *(np.shape(one)[1:] for one in deviations))
        places = np.broadcast_to(np.arange(at.size).reshape(at.shape), shape).ravel()
        flat = [
            np.broadcast_to(part, shape).ravel()
            for one, own in zip(deviations, self.sources, strict=True)
            for part in np.asarray(one)[: len(own.effects)]
        ]
        poses, inputs = self._poses(at)[0], self._counted(at)
        parts = [
            self._errors(output, poses, inputs, places[some], [one[some] for one in flat])
            for some in (slice(start, start + BLOCK) for start in range(0, max(places.size, 1), BLOCK))
        ]
        found = np.concatenate(parts, axis=1)
        return found.reshape(found.shape[0], *shape)

    def _errors(
        self, output: str, poses: Poses, inputs: Array, places: NDArray[np.intp], deviations: Sequence[Array]
    ) -> Array:
        """Errors (c, d) of mechanisms at the nominal poses of given places."""
        here = {link: Pose(one.origin[places], one.angle[places]) for link, one in poses.items()}
        change = Change()
        effects = [effect for one in self.sources for effect in one.effects]
        for effect, deviation in zip(effects, deviations, strict=True):
            if deviation.any():
                change = change.plus(effect.at(here).scaled(deviation))
        made = self._closed(here, change, inputs[places])
        judged = self.judged[output]
        return judged.error(judged.value(made, change), judged.value(here, Change()))

    def _closed(self, poses: Poses, change: Change, inputs: Array) -> Poses:
        """Poses (d,) of machines with changed numbers, each at its own input."""
        column = Change(
            {key: np.reshape(value, (-1, 1)) for key, value in change.places.items()},
            {key: np.reshape(value, (-1, 1)) for key, value in change.block_angles.items()},
            {key: np.reshape(value, (-1, 1)) for key, value in change.phases.items()},
        )
        machine = changed(self.machine, column)
        return _poses(self._solved(machine, poses, np.reshape(inputs + change.input, (-1, 1))), inputs.size)

    def _solved(self, machine: Machine, near: Poses, at: Array) -> Solution:
        """A machine at inputs (d, 1), in closed form, or by Newton's method from poses (d,) that are near."""
        if self.closed_form:
            return solve(machine, [Turning.of(at)], assembly_order(machine), 0)
        drawn = {
            link: Drawn(one.origin.reshape(-1, 1), one.angle.reshape(-1, 1)) for link, one in near.items()
        }
        joints = tuple(machine.joints)
        every = Cluster(machine.links, joints, (0,))
        return solve(replace(machine, drawn=drawn, drawn_at=(at,)), [Turning.of(at)], (every,), 0)

    @cached_property
    def _course(self) -> Poses:
        """Poses at the positions of the period, along which links are followed and angles run on."""
        return _poses(
            solve(self.machine, [Turning.of(self.positions, 1.0)], self.order, 0), self.positions.size
        )

    def _near(self, at: Array) -> Poses:
        """The poses of the period that are nearest to inputs (d,)."""
        above = np.clip(np.searchsorted(self.positions, at), 1, self.positions.size - 1)
        places = above - (at - self.positions[above - 1] < self.positions[above] - at)
        return {link: Pose(one.origin[places], one.angle[places]) for link, one in self._course.items()}

    def _counted(self, at: Array) -> Array:
        """Inputs, flat (d,), within the period: whole turns make no difference."""
        flat, low = np.ravel(np.asarray(at, float)), self.positions[0]
        return np.asarray(low + (flat - low) % self.turn if self.turn else flat)

    def _poses(self, at: Array) -> tuple[Poses, Array]:
        """Nominal poses at inputs, flat (d,), and whether links move there in proportion to a change."""
        flat = np.ravel(np.asarray(at, float))
        key = flat.tobytes()
        if self._kept is None or self._kept[0] != key:
            own = self._counted(flat)
            near = {} if self.closed_form else self._near(own)
            found = self._solved(self.machine, near, own.reshape(-1, 1))
            least = self.dead_sine if self.closed_form else SINGULAR
            sines = [np.broadcast_to(sine.ravel(), own.shape) for sine in found.sines.values()]
            moves = np.all([sine > least for sine in sines], axis=0) if sines else np.ones(own.shape, bool)
            self._kept = key, _poses(found, own.size), moves
        return self._kept[1], self._kept[2]


class LinkageTolerances(MachineTolerances):
    """The model of one linkage of plates; its contributors are all that varies in a plate."""

    def __init__(self, table: AnyPlanarTable, tolerances: Tolerances) -> None:
        sources = sources_of(Plates.of(table), tolerances)
        super().__init__(table, course_of(table), sources, outputs_of(table.linkage, table.tolerance_names))


def _poses(found: Solution, count: int) -> Poses:
    return {
        link: Pose(
            np.broadcast_to(body.origin.position.reshape(-1), (count,)),
            np.broadcast_to(body.turning.theta.reshape(-1), (count,)),
        )
        for link, body in found.bodies.items()
    }
