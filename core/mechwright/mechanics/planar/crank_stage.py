"""What stages that are turned by a crank have in common."""

from abc import abstractmethod

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import Motion
from mechwright.contracts.transmission import Transmission
from mechwright.contracts.turning import Turning
from mechwright.errors import DesignError


class CrankStage(Transmission):
    """A planar linkage whose motion has the channel ``drive_torque``, N·m, where its parts can be made."""

    @property
    @abstractmethod
    def acceleration_ratio(self) -> float:
        """α/ω² of the crank where nothing stands before it; 0 at constant speed."""

    def power(self, drive: Turning, motion: Motion) -> Array:
        """Of the load and of all masses, where the parts can be made."""
        if "drive_torque" not in motion.channels:
            return np.zeros_like(drive.theta)
        return np.asarray(motion["drive_torque"] * drive.omega)

    def at(self, angle: Array) -> tuple[Array, Turning]:
        """At constant speed; raises DesignError for a crank that speeds up all along."""
        if self.acceleration_ratio:
            raise DesignError(
                "acceleration_ratio: a crank that speeds up all along repeats no turn, and a chain runs on; "
                "leave acceleration_ratio out"
            )
        return super().at(angle)
