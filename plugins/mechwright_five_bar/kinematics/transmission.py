"""The geared five-bar as the last stage of a chain."""

from fractions import Fraction

from mechwright import Array, DesignError, KinematicsError, Motion, Port, Turning
from mechwright.mechanics.linkage.kinematics.period import Period
from mechwright.mechanics.planar.crank_stage import CrankStage
from mechwright_five_bar.kinematics.motion import motion_over, require_motion
from mechwright_five_bar.table import FiveBarTable


class CouplerStage(CrankStage):
    """Crank in; what it moves is a point of the coupler, so that no stage stands behind it.

    Coupler and rocker turn about pins that move. Raises DesignError for a crank that swings.
    """

    own_drive = ("speed", "direction")
    acceleration_ratio = 0.0

    def __init__(self, table: FiveBarTable) -> None:
        self.table = table
        require_motion(table)
        if table.is_lever:
            raise DesignError(
                "crank: it swings, and a stage of a chain follows a shaft that turns all the way; make "
                "coupler and rocker longer, and leave swing_from and swing_to out"
            )
        self.input = Port("crank", (0.0, 0.0))
        self.period = Fraction(table.bar.turns)
        self.speed = table.sense * table.omega

    def move(self, drive: Turning) -> Turning:  # noqa: ARG002 - there is none
        """There is none; raises KinematicsError."""
        raise KinematicsError("links of a five-bar turn about pins that move; nothing can stand behind it")

    def motion(self, drive: Turning, time: Array) -> Motion:
        """All bodies, and forces with the masses of the real parts."""
        return motion_over(self.table, Period(time, drive, self.table.solved(drive)))
