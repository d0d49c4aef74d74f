"""The contract of a look-ahead: what a control makes of the moves that it is given."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

from mechwright.arrays import Array
from mechwright_cam.controls.reading.run import Run
from mechwright_cam.shop.machine import Machine


@dataclass(frozen=True)
class Motion:
    """A run as the machine makes it.

    Parameters
    ----------
    seconds
        (n,) time in which the machine moves in each step, s; without dwells and tool changes.
    off
        (n,) how far the tool may be from the programmed path in each step, mm; inf without a bound.
    """

    seconds: Array
    off: Array


class Lookahead(ABC):
    """How a control goes from one move to the next on a machine of given speeds and accelerations."""

    @abstractmethod
    def motion(self, run: Run, machine: Machine) -> Motion:
        """What becomes of a run."""

    def motions(self, run: Run, machine: Machine, accelerations: Sequence[float]) -> list[Motion]:
        """What becomes of it with each of some accelerations, m/s², of a machine."""
        every = (machine.model_copy(update={"acceleration": one}) for one in accelerations)
        return [self.motion(run, one) for one in every]
