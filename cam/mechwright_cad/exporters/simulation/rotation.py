"""Rotations as URDF and SDF write them."""

import math

from mechwright.arrays import Array


def roll_pitch_yaw(rotation: Array) -> tuple[float, float, float]:
    """Angles, rad, about the fixed axes X, Y, Z of a rotation (3, 3), which is Rz(yaw) Ry(pitch) Rx(roll).

    >>> import numpy as np
    >>> quarter = np.array([(0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)])
    >>> [round(one, 9) + 0.0 for one in roll_pitch_yaw(quarter)]
    [0.0, 0.0, 1.570796327]
    """
    level = math.hypot(rotation[0, 0], rotation[1, 0])
    pitch = math.atan2(-rotation[2, 0], level)
    if level < 1e-12:  # X points along Z: roll and yaw are about one axis
        return math.atan2(-rotation[1, 2], rotation[1, 1]), pitch, 0.0
    roll = math.atan2(rotation[2, 1], rotation[2, 2])
    return roll, pitch, math.atan2(rotation[1, 0], rotation[0, 0])
