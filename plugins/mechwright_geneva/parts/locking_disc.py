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
from numpy.typing import NDArray

from mechwright import TOLERANCES, Arc, Array, GeometryError, Line, Loop, Segment
from mechwright.geometry.fit import fit_curves
from mechwright_geneva.kinematics.geometry import Points, corner_angle
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.parts.slot_outline import FIT, backwards, mirrored

_SAMPLES = 400
"""Samples of the envelope that find how deep it is."""

_SOUGHT = 120
"""Samples that find the crossing of envelope and horn path; Newton's method does the rest."""

_STEPS = 12
"""Steps of Newton's method: from a sample's distance to rounding in five, the rest to spare."""

_REST = 1e-9
"""Rate of the wheel below which its direction is rounding."""

_MET = 1e-10
"""Distance, mm, at which two curves have met: far below a closure gap."""

_GRID, _HALVINGS, _NEWTON = 257, 12, 4
"""Samples that bracket a place on the stroke; halvings of the bracket, and steps of Newton's method, of
which one or two reach the last bit."""

_APART = 10 * TOLERANCES.closure
"""Gap, mm, that no loop closes over."""

_SLIVER = 1e-9
"""A share of the stroke below which a piece of the edge is not drawn."""


@dataclass(frozen=True)
class Half:
    """The bite that the disc leaves; ``leaving`` takes the stroke backwards, mirrored: the bite it enters."""

    mechanism: Mechanism
    leaving: bool

    def _motion(self, u: Array) -> tuple[Array, Array, Array]:
        """φ, the wheel's angle and its rate."""
        m = self.mechanism
        rates = m.law.at(1 - u if self.leaving else u)
        phi, theta = m.crank_half * (1 - 2 * u), 2 * m.wheel_half * rates.s
        return phi, 2 * m.wheel_half - theta if self.leaving else theta, m.wheel_half / m.crank_half * rates.v

    @cached_property
    def horn_angle(self) -> Array:
        """Polar angle ψ of the grown wheel's horn from the middle of its bite."""
        m = self.mechanism
        return np.asarray(corner_angle(m.axes, m.rim + m.params.lock_clearance, m.lock))

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

    def passing(self) -> Array:
        """The u (m, 1) at which the horn is on the line of centres."""
        grid, wanted = np.linspace(0, 1, _GRID), np.reshape(self.horn_angle, (-1, 1))
        before = np.searchsorted(self._motion(grid)[1].ravel(), wanted) - 1
        low, high = grid[np.clip(before, 0, _GRID - 1)], grid[np.clip(before + 1, 0, _GRID - 1)]
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            short = np.asarray(self._motion(middle)[1] < wanted)
            low, high = np.where(short, middle, low), np.where(short, high, middle)
        at = (low + high) / 2
        for _ in range(_NEWTON):
            _, theta, rate = self._motion(at)
            slope = 2 * self.mechanism.crank_half * rate
            at = np.clip(at + (wanted - theta) / np.where(slope > 0, slope, np.inf), low, high)
        return np.asarray(at)

    def crossing(self, last: Array) -> tuple[Array, Array, Array]:
        """The u of the envelope and of the horn's path, after ``last``, where the second cuts the first.

        Parameters
        ----------
        last
            (m, 1), as of :meth:`passing`.

        Returns
        -------
        s, t, miss
            (m, 1) each; the distance, mm, at which both are, infinite where the horn does not clear the disc.
        """
        share = np.linspace(0, 1, _SOUGHT + 1)
        u, after = last * share, (1 - share) * last + share
        edge, path = self.envelope(u), self.horn(after)
        turned, angle = np.maximum.accumulate(np.angle(edge), axis=-1), np.angle(path)
        depth = np.abs(path) - _between(angle, turned, np.abs(edge))
        first = np.argmax(depth > 0, axis=-1)[:, None]
        t = np.take_along_axis(after, first, axis=-1)
        s = _between(np.take_along_axis(angle, first, axis=-1), turned, u)
        step = 1e-6 * last
        for _ in range(_STEPS):
            one = self.envelope(np.concatenate((s, s + step, s - step), axis=-1))
            two = self.horn(np.concatenate((t, t + step, t - step), axis=-1))
            miss = one[:, :1] - two[:, :1]
            if (np.abs(miss) < _MET).all():
                break
            ds, dt = ((curve[:, 1:2] - curve[:, 2:]) / (2 * step) for curve in (one, two))
            cross = (np.conj(ds) * dt).imag
            good = (np.abs(miss) >= _MET) & (cross != 0)
            cross = np.where(good, cross, np.inf)
            s = np.clip(s + (np.conj(dt) * miss).imag / cross, 0, last)
            t = np.clip(t + (np.conj(ds) * miss).imag / cross, last, 1)
        return s, t, np.where((depth > 0).any(axis=-1, keepdims=True), np.abs(miss), np.inf)

    def edge(self) -> tuple[list[Segment], float]:
        """Segments from the disc to the deepest place, and their deviation."""
        ends = self.passing()
        *found, miss = self.crossing(ends)
        if math.isinf(miss.item()):
            raise GeometryError("the horn of the wheel does not clear the locking disc")
        last, s, t = ends.item(), *(one.item() for one in found)
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


def _between(at: Array, places: Array, values: Array) -> Array:
    """Linear interpolation (m, j) at ``at`` (m, j) of values (m, k) at rising places (m, k), row by row."""
    apart = 4 * math.tau * np.arange(len(places))[:, None]  # angles of other rows are out of reach
    inside = np.clip(at, places[:, :1], places[:, -1:]) + apart
    return np.interp(inside.ravel(), (places + apart).ravel(), values.ravel()).reshape(at.shape)


def drawn(mechanism: Mechanism) -> NDArray[np.int_]:
    """Whether :func:`lock_loop` draws (m,) or raises, 1 or -1, or only drawing tells, 0, of a named law.

    Where the horn cuts the envelope the edge closes. What is left to fail is the fit of the horn's path: the
    jerk of a named law is bounded, so that a cubic is within the tolerance over a 256th of it. Where the horn
    does not clear the disc, or passes the very beginning of its arc, the edge has a gap.
    """
    half = Half(mechanism, leaving=False)
    s, _, miss = half.crossing(half.passing())
    gap = (miss > _APART) & (np.isinf(miss) | (s < _SLIVER))
    found: NDArray[np.int_] = np.where(miss < _MET, 1, np.where(gap, -1, 0))[:, 0]
    return found


def lock_loop(mechanism: Mechanism) -> tuple[Loop, float]:
    """The outside of the locking disc, driver's frame, counter-clockwise, and its deviation.

    Raises
    ------
    GeometryError
        The wheel leaves no room for a disc; :func:`mechwright_geneva.checks.findings` says why.
    """
    m = mechanism
    deep = m.axes - m.rim - m.params.lock_clearance
    entry, one = Half(m, leaving=False).edge()
    if m.law.symmetric:
        out, two = mirrored(entry, 0.0), one
    else:
        leave, two = Half(m, leaving=True).edge()
        out = backwards(leave)
    start, end = math.atan2(*entry[-1].end[::-1]), math.atan2(*out[0].start[::-1])
    relief: list[Segment] = [*entry, Arc((0.0, 0.0), deep, start, end - start, "relief"), *out]
    free = m.pitch - 2 * m.crank_half
    pieces: list[Segment] = []
    for k in range(m.params.rollers):
        pieces += [segment.moved(0, 0, k * m.pitch) for segment in relief]
        pieces.append(Arc((0.0, 0.0), m.lock, k * m.pitch + m.crank_half, free, "lock"))
    return Loop(tuple(pieces)), max(one, two)
