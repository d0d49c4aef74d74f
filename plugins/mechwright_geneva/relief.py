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
from functools import cached_property

import numpy as np

from mechwright import TOLERANCES, Arc, Array, GeometryError, Line, Loop, Segment
from mechwright.geometry.fit import fit_curves
from mechwright_geneva.kinematics import Points
from mechwright_geneva.mechanism import Mechanism
from mechwright_geneva.mirror import mirrored
from mechwright_geneva.slot import FIT

_SAMPLES = 400
"""Samples of envelope and horn path that find their crossing; Newton's method does the rest."""

_STEPS = 12
"""Steps of Newton's method: from a sample's distance to rounding in five, the rest to spare."""

_REST = 1e-9
"""Rate of the wheel below which its direction is rounding."""

_MET = 1e-10
"""Distance, mm, at which two curves have met: far below a closure gap."""

_GRID, _ZOOMS = 257, 5
"""Samples that bracket a place on the stroke, and how often: 256 to the fifth reaches the last bit but
one."""

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

    @cached_property
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
        for _ in range(_ZOOMS):
            u = np.linspace(low, high, _GRID)
            before = int(np.searchsorted(self._motion(u)[1], self.horn_angle)) - 1
            low, high = float(u[max(before, 0)]), float(u[min(before + 1, _GRID - 1)])
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
            first = self.envelope(np.array([s, s + step, s - step]))
            second = self.horn(np.array([t, t + step, t - step]))
            miss = complex(first[0] - second[0])
            if abs(miss) < _MET:
                break
            ds, dt = ((curve[1] - curve[2]) / (2 * step) for curve in (first, second))
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
        chain, one = self._along(self.envelope, 0.0, s)
        if chain is None:
            chain = self._step(s, complex(self.horn(np.array(t))))
        path, two = self._along(self.horn, t, last)
        if path is None:
            raise GeometryError("the path of the wheel's horn is not smooth")
        return [*chain, *path], max(one, two)

    def _along(
        self, function: Callable[[Array], Points], start: float, end: float
    ) -> tuple[list[Segment] | None, float]:
        """The curve from one u to another, and its deviation; None if it is not smooth."""
        if abs(end - start) < _SLIVER:
            return [], 0.0

        def curve(share: Array) -> Array:
            points = self._mirrored(function((1 - share) * start + share * end))
            return np.stack((points.real, points.imag), axis=-1)[None]

        try:
            (chain,), deviation = fit_curves(curve, 1, FIT, "relief")
        except GeometryError:
            return None, 0.0
        return list(chain), deviation

    def _mirrored(self, points: Points) -> Points:
        return np.conj(points) if self.leaving else points

    def _step(self, s: float, horn: complex) -> list[Segment]:
        """A step and an arc inside the envelope, for laws given by a table that ripples at its end."""
        m = self.mechanism
        deep = min(abs(horn), float(np.abs(self.envelope(np.linspace(0, s, _SAMPLES))).min()))
        first, last = self._mirrored(np.array([np.exp(-1j * m.crank_half), horn]))
        start, end = float(np.angle(first)), float(np.angle(last))
        arc = Arc((0.0, 0.0), deep, start, end - start, "relief")
        disc = complex(m.lock * first)
        steps: list[Segment] = [Line((disc.real, disc.imag), arc.start, "relief"), arc]
        if abs(horn) - deep > TOLERANCES.closure:
            steps.append(Line(arc.end, (float(last.real), float(last.imag)), "relief"))
        return steps


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
    if m.law.symmetric:
        out, two = [mirrored(segment, 0.0) for segment in entry[::-1]], one
    else:
        leave, two = _Half(m, leaving=True).edge()
        out = [segment.reversed() for segment in leave[::-1]]
    start, end = math.atan2(*entry[-1].end[::-1]), math.atan2(*out[0].start[::-1])
    relief: list[Segment] = [*entry, Arc((0.0, 0.0), deep, start, end - start, "relief"), *out]
    free = m.pitch - 2 * m.crank_half
    pieces: list[Segment] = []
    for k in range(m.params.rollers):
        pieces += [segment.moved(0, 0, k * m.pitch) for segment in relief]
        pieces.append(Arc((0.0, 0.0), m.lock, k * m.pitch + m.crank_half, free, "lock"))
    return Loop(tuple(pieces)), max(one, two)
