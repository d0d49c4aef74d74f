"""What is taken for a control of whose look-ahead nothing is known."""

import numpy as np

from mechwright.arrays import Array
from mechwright_cam.controls.lookahead.contract import Lookahead, Motion
from mechwright_cam.controls.lookahead.geometry import directions, moved
from mechwright_cam.controls.lookahead.speeds import NO_LENGTH, reached, seconds
from mechwright_cam.controls.reading.run import Kind, Run
from mechwright_cam.shop.machine import Machine

CORNER_JUMP = 100.0
"""Change of velocity at a corner that a machine takes without slowing down, mm/min: a common jerk setting."""


class DefaultLookahead(Lookahead):
    """A trapezoid of speed along each move, and between two moves the speed that the corner allows.

    The machine speeds up and slows down with the acceleration of an axis along the path; along an arc the
    centripetal acceleration limits it too. At a corner an axis may jump by :data:`CORNER_JUMP`. How far it
    leaves the path is what the words of the program say.
    """

    def motion(self, run: Run, machine: Machine) -> Motion:
        """Times by the model, deviations by the words."""
        length, rapid = moved(run, machine)
        acceleration = machine.acceleration * 1000.0
        speed = np.where(rapid, _rapids(run, machine), np.minimum(run.feed, machine.max_feed)) / 60
        arc = run.kind == Kind.ARC
        speed[arc] = np.minimum(speed[arc], np.sqrt(acceleration * run.radius[arc]))
        speed = np.where(length > NO_LENGTH, np.maximum(speed, NO_LENGTH), 0.0)
        rates = np.full(len(run), acceleration)
        ends = reached(length, rates, _corners(run, speed))
        return Motion(seconds(length, rates, speed, ends), run.of_states(lambda state: state.off_path))


def _rapids(run: Run, machine: Machine) -> Array:
    """Speed (n,) of each rapid, mm/min: as fast along its line as Z allows, where Z is slower."""
    if machine.rapid_z is None or len(run) == 0:
        return np.full(len(run), machine.rapid)
    along, _ = directions(run)
    upright = np.maximum(np.abs(along[:, 2]), NO_LENGTH)
    flat = np.maximum(np.hypot(along[:, 0], along[:, 1]), NO_LENGTH)
    return np.minimum(np.minimum(machine.rapid / flat, machine.rapid_z / upright), machine.rapid)


def _corners(run: Run, speed: Array) -> Array:
    """Speeds (n + 1,) that the corners between the steps allow, mm/s."""
    entering, leaving = directions(run)
    turn = np.sqrt(np.maximum(((entering[1:] - leaving[:-1]) ** 2).sum(axis=1), 1e-12))
    corner = np.minimum(np.minimum(speed[:-1], speed[1:]), CORNER_JUMP / 60 / turn)
    return np.concatenate(([0.0], corner, [0.0]))


DEFAULT_LOOKAHEAD = DefaultLookahead()
"""The one there is."""
