"""The machine of a four-bar, or those of a table of designs: ground, crank, coupler, follower."""

import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from mechwright.contracts.design_table import number
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.planar_table import PlanarTable
from mechwright.mechanics.planar.course import Ways
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.efforts import PointLoad
from mechwright.mechanics.planar.machine import Drive, Machine, Revolute
from mechwright.mechanics.planar.positions import Solution
from mechwright.mechanics.planar.rigid import BodyMotion, Turning
from mechwright_four_bar.kinematics.change_point import close_through
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.reach import bar_of, ways_of
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.phases import in_phase

MILLI = 1e-3


class FourBarMachine(PlanarTable[FourBarParams]):
    """A crank or lever that drives a follower through a coupler, in the phase that is shown."""

    code = "four-bar"
    unloading: ClassVar[Mapping[str, Any]] = {"load_torque": 0.0, "speed": 60.0}
    dead_sine: ClassVar[float] = 1e-6

    @cached_property
    def params(self) -> FourBarParams:
        """The design whose first phase is the one that is shown."""
        return in_phase(self.given) if self.given.phases else self.given

    @cached_property
    def bar(self) -> FourBar:
        """The dimensions."""
        return bar_of(self.params)

    @property
    def pivot(self) -> Any:
        """A0, x + i y, mm."""
        return self.params.pivot_x + 1j * np.asarray(self.params.pivot_y)

    @cached_property
    def linkage(self) -> Linkage:
        """Links and joints."""
        bar = self.bar
        return linkage_of(bar, self.pivot, bar.ground_angle, self.params)

    @property
    def requested(self) -> tuple[float, float] | None:
        """The swing that a design states, rad from X."""
        params = self.params
        if params.swing_from is None or params.swing_to is None:
            return None
        return np.radians(params.swing_from), np.radians(params.swing_to)

    @cached_property
    def closed_ways(self) -> Ways:
        """How the cranks go; start and travel are NaN where links do not reach the swing that is stated."""
        return ways_of(self.bar, self.requested, self.sense, self.params.acceleration_ratio)

    @property
    def lever(self) -> Any:
        """Whether the crank swings, because it cannot turn fully or because the design says between where."""
        return self.closed_ways.rocks

    @property
    def through(self) -> Any:
        """Whether the crank turns through positions in which all links line up."""
        return np.asarray(self.bar.lines_up) & ~self.lever

    @cached_property
    def transmission(self) -> tuple[float, float]:
        """Smallest and largest acute transmission angle over a period, rad."""
        ways = self.closed_ways
        start = np.where(ways.rocks, ways.start - self.bar.ground_angle, 0.0)
        return self.bar.transmission_range(start, np.where(ways.rocks, start + ways.travel, math.tau))

    @property
    def drawn_at(self) -> float:
        """The crank over the ground line."""
        return self.bar.ground_angle

    @property
    def tolerance_names(self) -> Mapping[str, str]:
        """Those of the coupler point, and of the shaft of a follower that has one."""
        layout = self.layout_or_none
        shaft = {"pin-b0": "shaft-b0"} if layout is not None and layout.scheme.sides == 2 else {}
        named = {"point P": "coupler point", "p-along": "point-along", "p-across": "point-across"}
        return named | shaft

    @property
    def loads(self) -> Sequence[PointLoad]:
        """The torque on the follower."""
        return (PointLoad("follower", moment=self.params.load_torque / MILLI),)

    def solved(self, drive: Turning) -> Solution:
        """The motion for a motion of the crank, smoothly through change points."""
        if not np.all(self.through):
            return super().solved(drive)
        bar = self.bar
        loop = close_through(bar, drive.theta, self.closed_ways.course.travel)
        bodies = loop.bodies(bar, drive, complex(self.pivot))
        still = BodyMotion.about(0j, Turning.of(np.zeros_like(drive.theta)))
        sine = np.abs((loop.coupler.direction * np.conj(loop.follower.direction)).imag)
        return Solution({GROUND: still, **bodies}, {"B": sine})


def linkage_of(bar: FourBar, pivot: Any, angle: Any, params: FourBarParams) -> Linkage:
    """Links and joints with A0 at the pivot, mm, and the ground line at an angle, rad, in the ground."""
    end = number(pivot + bar.ground * np.exp(1j * np.asarray(angle)))
    joints = (
        Revolute("A0", GROUND, "crank", number(pivot), 0j),
        Revolute("A", "crank", "coupler", bar.crank + 0j, 0j),
        Revolute("B", "coupler", "follower", bar.coupler + 0j, bar.follower + 0j),
        Revolute("B0", GROUND, "follower", end, 0j),
    )
    points: dict[str, dict[str, Any]] = {
        GROUND: {"A0": joints[0].place_one, "B0": end},
        "crank": {"A0": 0j, "A": bar.crank + 0j},
        "coupler": {"A": 0j, "B": bar.coupler + 0j},
        "follower": {"B0": 0j, "B": bar.follower + 0j},
    }
    traces = {}
    if params.coupler_point is not None:
        points["coupler"]["coupler-point"] = params.coupler_point
        traces["P"] = ("coupler", "coupler-point")
    machine = Machine(joints, (Drive("crank"),), {"B": bar.branch})
    return Linkage(machine, points, "follower", traces)
