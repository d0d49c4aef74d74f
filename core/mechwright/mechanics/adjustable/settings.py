"""How the machine is set from phase to phase."""

from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.adjustable.mechanism import Pins
from mechwright.mechanics.adjustable.space import Space


@dataclass(frozen=True, slots=True)
class Settings:
    """What is turned in the pose of setting, from phase 1 to each phase (phases,), rad, -π to π.

    Parameters
    ----------
    crank, follower, arm
        Turns of the crank about a0, of the follower about b1 and of the arm about b0.
    crank_chords, follower_chords
        Distances (phases, phases) between the holes of the pivots a and c in the coupler.
    """

    crank: Array
    follower: Array
    arm: Array
    crank_chords: Array
    follower_chords: Array


def settings_of(space: Space, pins: Pins) -> Settings:
    """The settings of one linkage's pins (phases,) whose moving pivots are set."""

    def turned(angle: Array) -> Array:
        return np.asarray(np.angle(np.exp(1j * (angle - angle[0]))))

    def chords(name: str) -> Array:
        at = getattr(pins, name)
        return space.apart(at[..., :, None], at[..., None, :])

    arm = space.polar(pins.b0, pins.b1)[1]
    still = np.zeros_like(arm) if np.array_equal(pins.b0, pins.b1) else turned(arm)
    return Settings(
        turned(space.polar(pins.a0, pins.a)[1]),
        turned(space.polar(pins.b1, pins.c)[1]),
        still,
        chords("a"),
        chords("c"),
    )
