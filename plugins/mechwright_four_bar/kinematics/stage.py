"""The four-bar as a stage of a chain."""

import math
from fractions import Fraction

import numpy as np

from mechwright import Array, DesignError, Motion, Port, Turning
from mechwright.mechanics.planar.crank_stage import CrankStage
from mechwright_four_bar.kinematics.motion import check_moves, motion_over
from mechwright_four_bar.kinematics.reach import bar_of, is_lever
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.phases import in_phase
from mechwright_four_bar.parts.plates import pivot_of
from mechwright_four_bar.peaks import driven_by


class FollowerStage(CrankStage):
    """Crank in, follower out: it turns along or swings.

    Raises DesignError for an input that is a lever, and for links that line up.
    """

    own_drive = ("speed", "acceleration_ratio", "direction")

    def __init__(self, params: FourBarParams) -> None:
        self.params = params = in_phase(params)
        check_moves(params)
        bar = bar_of(params)
        if is_lever(params) or bar.lines_up:
            raise DesignError(
                "crank: it swings, or its links line up, and a stage of a chain follows a shaft that turns "
                "all the way; take links with crank + longest < the other two, and leave swing_from and "
                "swing_to out"
            )
        out = bar.ground * np.exp(1j * bar.ground_angle) + pivot_of(params)
        start = pivot_of(params)
        self.input = Port("crank", (start.real, start.imag))
        self.output = Port("follower", (float(out.real), float(out.imag)))
        self.speed = (1 if params.direction == "ccw" else -1) * params.speed * math.tau / 60
        turn = self._follower(np.linspace(0.0, math.tau, 721))
        self.advance = Fraction(round(float(turn[-1] - turn[0]) / math.tau))

    def _follower(self, phi: Array) -> Array:
        loop = driven_by(self.params, Turning.of(phi, 1.0), phi).loop
        return np.unwrap(np.angle(loop.follower.direction))

    def move(self, drive: Turning) -> Turning:
        """The follower's angle goes on over whole turns of the crank."""
        found = driven_by(self.params, drive, drive.theta).bodies["follower"].turning
        return Turning(np.unwrap(found.theta), found.omega, found.alpha, found.jerk)

    def motion(self, drive: Turning, time: Array) -> Motion:
        """All bodies, and forces with the masses of the real parts."""
        return motion_over(self.params, driven_by(self.params, drive, time))

    @property
    def acceleration_ratio(self) -> float:
        """As the design says it."""
        return self.params.acceleration_ratio
