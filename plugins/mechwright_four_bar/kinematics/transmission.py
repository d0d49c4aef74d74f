"""The four-bar as a stage of a chain."""

from mechwright import Array, DesignError, Motion, Turning
from mechwright.mechanics.linkage.kinematics.period import Period
from mechwright.mechanics.linkage.kinematics.transmission import OutputStage
from mechwright_four_bar.kinematics.motion import check_moves, motion_over
from mechwright_four_bar.table import FourBarTable


class FollowerStage(OutputStage):
    """Crank in, follower out: it turns along or swings.

    Raises DesignError for an input that is a lever, and for links that line up.
    """

    own_drive = ("speed", "acceleration_ratio", "direction")
    table: FourBarTable

    def __init__(self, table: FourBarTable) -> None:
        check_moves(table)
        if table.lever or table.bar.lines_up:
            raise DesignError(
                "crank: it swings, or its links line up, and a stage of a chain follows a shaft that turns "
                "all the way; take links with crank + longest < the other two, and leave swing_from and "
                "swing_to out"
            )
        super().__init__(table)
        self.start = 0.0
        self.acceleration_ratio = table.params.acceleration_ratio

    def motion(self, drive: Turning, time: Array) -> Motion:
        """All bodies, and forces with the masses of the real parts."""
        return motion_over(self.table, Period(time, drive, self.table.solved(drive)))
