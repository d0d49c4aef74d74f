"""The slider-crank as the last stage of a chain."""

from mechwright import Array, DesignError, KinematicsError, Motion, Port, Turning
from mechwright.mechanics.planar.crank_stage import CrankStage
from mechwright_slider_crank.kinematics.course import is_lever
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.kinematics.motion import driven_by, moving


class SliderStage(CrankStage):
    """Crank in; what moves last is a slider, so that no stage stands behind it.

    Raises DesignError for a crank that cannot turn fully, or goes through both assemblies.
    """

    own_drive = ("speed", "acceleration_ratio", "clockwise")

    def __init__(self, table: Mechanism) -> None:
        if is_lever(moving(table)) or table.closed.at_limit:
            raise DesignError(
                "crank: it swings, or only just turns, and a stage of a chain follows a shaft that turns all "
                "the way; make the rod longer than crank and offset, and leave swing_from and swing_to out"
            )
        self.table = table
        self.input = Port("crank", (0.0, 0.0))
        self.speed = table.sense * table.omega

    def move(self, drive: Turning) -> Turning:  # noqa: ARG002 - there is none
        """There is none; raises KinematicsError."""
        raise KinematicsError("a slider is no shaft; nothing can stand behind it")

    def motion(self, drive: Turning, time: Array) -> Motion:
        """All bodies, and forces with the masses of the real parts."""
        return driven_by(self.table, drive, time)

    @property
    def acceleration_ratio(self) -> float:
        """As the design says it."""
        return self.table.given.acceleration_ratio
