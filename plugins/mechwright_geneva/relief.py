"""The locking disc with its reliefs, from the exact sweep of the wheel.

Glossary
--------
bite
    A concave arc of the wheel, in which the locking disc turns while the wheel stands still.
horn
    The corner of the wheel between a bite and the rim.
grown wheel
    The wheel with the locking clearance all round: rim l + c, bites of the disc's own radius R_L.

While the crank turns through a stroke the disc must give way to the wheel. What the grown wheel sweeps in the
driver's frame is the relief. From the disc inwards its edge is, in order:

* the envelope of the bite as it moves off the disc, E = K + R_L i K'/|K'|, K the bite's centre;
* the path Q of the horn's tip after it has passed the line of centres, from where it cuts the envelope back
  to the line of centres (what the tip does before it gets there, the rim behind it has taken already);
* from there the rim passes: an arc of radius a - l - c about the crank's axis.

The other half is the same with time reversed. The driver's frame has the roller on +x:
z = -(z_fixed - a) exp(-iφ).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mechwright.errors import GeometryError
from mechwright.geometry import Arc, Loop
from mechwright.geometry.fit import fit_curves
from mechwright.geometry.segments import Segment
from mechwright.motion import Array
from mechwright_geneva.kinematics import Points
from mechwright_geneva.mechanism import Mechanism
from mechwright_geneva.slot import FIT

_SAMPLES = 400
"""Samples of envelope and horn path that find their crossing; Newton's method does the rest."""

_STEPS = 12
"""Steps of Newton's method: from a sample's distance to rounding in five, the rest to spare."""

_REST = 1e-9
"""Rate of the wheel below which its direction is rounding."""

_SLIVER = 1e-9
"""A share of the stroke below which a piece of the edge is not drawn."""


@dataclass(frozen=True)
class _Half:
    """The bite that the disc leaves; ``leaving`` takes the stroke backwards, mirrored: the bite it enters."""

    mechanism: Mechanism
    leaving: bool

    def _motion(self, u: Array) -> tuple[Array, Array, Array]:
        """φ, the wheel's angle and its rate."""
        if not self.leaving:
            run = self.mechanism.stroke(u)
            return run.phi, run.theta, run.first
        run = self.mechanism.stroke(1 - u)
        return -run.phi, 2 * self.mechanism.wheel_half - run.theta, run.first

    @property
    def horn_angle(self) -> float:
        """Polar angle ψ of the grown wheel's horn from the middle of its bite."""
        m = self.mechanism
        rim = m.rim + m.params.lock_clearance
        return math.acos((m.axes**2 + rim**2 - m.lock**2) / (2 * m.axes * rim))

    def envelope(self, u: Array) -> Points:
        """E at u."""
        phi, theta, rate = self._motion(u)
        a, turn = self.mechanism.axes, np.exp(1j * theta)
        lag = 2j * np.sin(theta / 2) * np.exp(0.5j * theta)  # exp(iθ) - 1 without cancellation
        along = lag + rate * turn  # i K' exp(iφ)/a
        size = np.abs(along)
        # At rest the bite touches the disc on the line of centres.
        moves = size > _REST
        out = np.where(moves, along / np.where(moves, size, 1.0), 1.0)
        points: Points = (self.mechanism.lock * out - a * lag) * np.exp(-1j * phi)
        return points

    def horn(self, u: Array) -> Points:
        """Q at u."""
        phi, theta, _ = self._motion(u)
        m = self.mechanism
        rim = m.rim + m.params.lock_clearance
        points: Points = (m.axes - rim * np.exp(1j * (theta - self.horn_angle))) * np.exp(-1j * phi)
        return points

    def passing(self) -> float:
        """The u at which the horn is on the line of centres."""
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = (low + high) / 2
            if float(self._motion(np.array(middle))[1]) < self.horn_angle:
                low = middle
            else:
                high = middle
        return (low + high) / 2

    def crossing(self, last: float) -> tuple[float, float]:
        """The u of the envelope and of the horn's path, after ``last``, where the second cuts the first."""
        u, after = np.linspace(0, last, _SAMPLES + 1), np.linspace(last, 1, _SAMPLES + 1)
        edge, path = self.envelope(u), self.horn(after)
        turned = np.maximum.accumulate(np.angle(edge))
        depth = np.abs(path) - np.interp(np.angle(path), turned, np.abs(edge))
        beyond = np.flatnonzero(depth > 0)
        if not beyond.size:
            raise GeometryError("the horn of the wheel does not clear the locking disc")
        t = float(after[beyond[0]])
        s = float(np.interp(np.angle(path[beyond[0]]), turned, u))
        step = 1e-6 * last
        for _ in range(_STEPS):
            miss = complex(self.envelope(np.array(s)) - self.horn(np.array(t)))
            ds = complex(self.envelope(np.array(s + step)) - self.envelope(np.array(s - step))) / (2 * step)
            dt = complex(self.horn(np.array(t + step)) - self.horn(np.array(t - step))) / (2 * step)
            matrix = np.array([[ds.real, -dt.real], [ds.imag, -dt.imag]])
            if abs(np.linalg.det(matrix)) == 0:
                break
            change = np.linalg.solve(matrix, [miss.real, miss.imag])
            s, t = float(np.clip(s - change[0], 0, last)), float(np.clip(t - change[1], last, 1))
        return s, t

    def edge(self) -> tuple[list[Segment], float]:
        """Segments from the disc to the deepest place, and their deviation."""
        last = self.passing()
        s, t = self.crossing(last)
        segments: list[Segment] = []
        deviation = 0.0
        for function, start, end in ((self.envelope, 0.0, s), (self.horn, t, last)):
            if abs(end - start) < _SLIVER:
                continue

            def curve(
                share: Array, f: Callable[[Array], Points] = function, a: float = start, b: float = end
            ) -> Array:
                points = f((1 - share) * a + share * b)
                if self.leaving:
                    points = np.conj(points)
                return np.stack((points.real, points.imag), axis=-1)[None]

            (chain,), error = fit_curves(curve, 1, FIT, "relief")
            segments += chain
            deviation = max(deviation, error)
        return segments, deviation


def lock_loop(mechanism: Mechanism) -> tuple[Loop, float]:
    """The outside of the locking disc, driver's frame, counter-clockwise, and its deviation.

    Raises
    ------
    GeometryError
        The wheel leaves no room for a disc; :func:`mechwright_geneva.checks.findings` says why.
    """
    m = mechanism
    deep = m.axes - m.rim - m.params.lock_clearance
    entry, one = _Half(m, leaving=False).edge()
    leave, two = _Half(m, leaving=True).edge()
    out: list[Segment] = [segment.reversed() for segment in leave[::-1]]
    start, end = math.atan2(*entry[-1].end[::-1]), math.atan2(*out[0].start[::-1])
    relief: list[Segment] = [*entry, Arc((0.0, 0.0), deep, start, end - start, "relief"), *out]
    free = m.pitch - 2 * m.crank_half
    pieces: list[Segment] = []
    for k in range(m.params.rollers):
        pieces += [segment.moved(0, 0, k * m.pitch) for segment in relief]
        pieces.append(Arc((0.0, 0.0), m.lock, k * m.pitch + m.crank_half, free, "lock"))
    return Loop(tuple(pieces)), max(one, two)
