"""What a frame is asked for, and what has been decided of it."""

from dataclasses import dataclass

from mechwright.contracts.on_plates import Post, Slideway
from mechwright.machine.frame.bracket import Bracket
from mechwright.machine.frame.coupled import Motor
from mechwright.machine.frame.seats import Seat
from mechwright.machine.frame.shafts import Levels
from mechwright.machine.frame.standing import Standing


@dataclass(frozen=True)
class Wanted:
    """The motor, if there is one, and of the input: peak and rms torque, N m, and greatest speed, rev/min."""

    motor: Motor | None = None
    torque: float = 0.0
    rms: float = 0.0
    speed: float = 0.0


@dataclass(frozen=True)
class Frame:
    """What has been decided.

    Parameters
    ----------
    seats
        Bearings of each spindle.
    levels
        Inner faces of the bearing plates.
    thickness
        Of both, mm.
    standing
        The rectangle of the columns.
    bracket
        Of the motor; None without one.
    posts, slideways
        Pins of the mechanism in the bearing plates, and linear guides on the lower one.
    """

    seats: tuple[Seat, ...]
    levels: Levels
    thickness: float
    standing: Standing
    bracket: Bracket | None
    posts: tuple[Post, ...] = ()
    slideways: tuple[Slideway, ...] = ()

    @property
    def under(self) -> float:
        """Lower face of the lower bearing plate, mm."""
        return self.levels.lower - self.thickness

    @property
    def driver(self) -> Seat:
        """The input's."""
        return next(seat for seat in self.seats if seat.spindle.drives)
