"""How fast a DC motor at constant voltage turns a load that changes over the turn.

Glossary
--------
line
    Torque of the motor over its speed, straight from stall to no load, at a share of its nominal voltage.
steady run
    The speed over a turn that comes back after it.

With J(θ) the inertia that the shaft feels, L(θ) the other torque it needs and M(ω) the line, the speed obeys

    d(J ω²/2)/dθ = M(ω) - L(θ)

Without inertia the speed lies on the line at every angle. The periodic solution is sought at equal steps of
the angle by backward differences of second order. They are stable however small J is, and tend to the line
with it. Newton's method solves all angles at once, together with the voltage at which the mean over time is
the requested one.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import bmat, csc_matrix, diags_array
from scipy.sparse.linalg import splu

from mechwright.arrays import Array

_STEPS = 60
"""Of Newton's method: from a constant speed it takes about ten, and more where the shaft all but stops."""

_SETTLED = 1e-10
"""Share of the mean speed by which the last step may change any speed."""

_NEAREST = 0.5
"""Share of the way to standstill that one step may go at the most, so that speeds stay above 0."""


@dataclass(frozen=True, slots=True)
class Line:
    """The straight line of a DC motor at the driven shaft.

    Parameters
    ----------
    no_load
        Speed without load at the nominal voltage, rad/s.
    stall
        Torque at standstill and the nominal voltage, N·m, without the losses between motor and shaft.
    efficiency
        Of what stands between motor and shaft. A braking motor is helped by the losses.
    """

    no_load: float
    stall: float
    efficiency: float = 1.0

    def torque(self, speed: Array, share: float) -> tuple[Array, Array]:
        """N·m at speeds (n,), rad/s, and a share of the voltage; and its derivative over the share."""
        own = self.stall * (share - speed / self.no_load)
        passed = np.where(own >= 0, self.efficiency, 1 / self.efficiency)
        return own * passed, self.stall * passed


@dataclass(frozen=True, slots=True, eq=False)
class SteadyRun:
    """Speeds over a period and the voltage that gives them.

    Parameters
    ----------
    speed
        (n,) rad/s at equal steps of the angle, from the start of the period on.
    share
        Of the nominal voltage.
    """

    speed: Array
    share: float


def steady_run(inertia: Array, load: Array, step: float, mean: float, line: Line) -> SteadyRun | None:
    """The steady run whose mean over time is ``mean``, rad/s; None where there is none: the motor stalls.

    ``inertia`` (n,), kg·m², and ``load`` (n,), N·m, are at angles ``step`` rad apart in the sense of the
    running, over one period without its end.

    >>> turn, still = 2 * np.pi, np.zeros(360)
    >>> load = 0.09 + 0.08 * np.cos(turn * np.arange(360) / 360)
    >>> found = steady_run(still, load, turn / 360, turn, Line(turn * 76 / 60, 4.4129925))
    >>> [round(float(speed) * 60 / turn, 2) for speed in (found.speed.min(), found.speed.max())]
    [58.64, 61.39]
    """
    count = load.size
    slope = _backward(count, step)
    speed = np.full(count, mean)
    share = mean / line.no_load + float(load.mean()) / (line.efficiency * line.stall)
    for _ in range(_STEPS):
        torque, by_share = line.torque(speed, share)
        off = slope @ (inertia * speed**2 / 2) - torque + load
        late = step * float((1 / speed).sum()) - count * step / mean
        matrix = bmat(
            [
                [
                    slope @ diags_array(inertia * speed) + diags_array(by_share / line.no_load),
                    -by_share[:, None],
                ],
                [-step / speed[None, :] ** 2, None],
            ],
            format="csc",
        )
        change = splu(matrix).solve(-np.append(off, late))
        if not np.isfinite(change).all():
            return None
        most = float((-change[:-1] / speed).max())
        part = min(1.0, _NEAREST / most) if most > 0 else 1.0
        speed, share = speed + part * change[:-1], share + part * float(change[-1])
        if float(np.abs(change[:-1]).max()) <= _SETTLED * mean:
            return SteadyRun(speed, share)
    return None


def _backward(count: int, step: float) -> csc_matrix:
    """The derivative (count, count) of what comes back after a period, by the two samples before each."""
    here = np.arange(count)
    weights = np.repeat([1.5, -2.0, 0.5], count) / step
    columns = np.concatenate([here, here - 1, here - 2]) % count
    return csc_matrix((weights, (np.tile(here, 3), columns)), shape=(count, count))
