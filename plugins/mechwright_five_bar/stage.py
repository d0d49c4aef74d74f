"""The geared five-bar as the last stage of a chain."""

import math
from fractions import Fraction

from mechwright import Array, DesignError, KinematicsError, Motion, Port, Turning
from mechwright.mechanics.planar.crank_stage import CrankStage
from mechwright_five_bar.motion import check_moves, motion_over
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.peaks import driven_by
from mechwright_five_bar.phases import in_phase
from mechwright_five_bar.reach import bar_of, is_lever


class CouplerStage(CrankStage):
    """Crank in; what it moves is a point of the coupler, so that no stage stands behind it.

    Coupler and rocker turn about pins that move. Raises DesignError for a crank that swings.
    """

    own_drive = ("speed", "direction")
    acceleration_ratio = 0.0

    def __init__(self, params: FiveBarParams) -> None:
        self.params = params = in_phase(params)
        check_moves(params)
        if is_lever(params):
            raise DesignError(
                "crank: it swings, and a stage of a chain follows a shaft that turns all the way; make "
                "coupler and rocker longer, and leave swing_from and swing_to out"
            )
        self.input = Port("crank", (0.0, 0.0))
        self.period = Fraction(bar_of(params).turns)
        self.speed = (1 if params.direction == "ccw" else -1) * params.speed * math.tau / 60

    def move(self, drive: Turning) -> Turning:  # noqa: ARG002 - there is none
        """There is none; raises KinematicsError."""
        raise KinematicsError("links of a five-bar turn about pins that move; nothing can stand behind it")

    def motion(self, drive: Turning, time: Array) -> Motion:
        """All bodies, and forces with the masses of the real parts."""
        return motion_over(self.params, driven_by(self.params, drive, time))
