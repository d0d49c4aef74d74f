"""Direct synthesis on the sphere: an adjustable five-bar fitted to its path by least squares.

R1 and R3 are common to both phases by construction: a1 and a1n lie on one circle about a0, c1 and c1n on one
circle about b1. The residuals are the path points' distances from their targets; positions 1 and 5 are met by
construction. With a0, b0 and b1 kept there are six unknowns (R1, two azimuths, R3, two azimuths). With those
three axes free as well there are twelve, which is more than ten equations: such a path can be met exactly.

Least squares from one start, for residuals that are computed for many designs at once.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from mechwright import Array, KinematicsError
from mechwright.mechanics.planar import Turning
from mechwright_spherical.kinematics.five_bar import AdjustableFiveBar, mean
from mechwright_spherical.kinematics.vectors import column, cross, dot, norm, perpendicular

SLOPE = 1e-6
"""Step of central differences, rad: their error is 1e-10, and Newton's steps converge all the same."""

ABSURD = 10.0
"""Residual of a design that cannot be assembled: five diameters of the sphere, so that no step there is
taken."""


def assembled(residuals: Array) -> Array:
    """The residuals, with ``ABSURD`` for those of a design that cannot be assembled."""
    return np.where(np.isfinite(residuals), residuals, ABSURD)


def fitted(residuals: Callable[[Array], Array], x: Array, precision: float, most: int, **how: Any) -> Array:
    """The unknowns (k,) with the least sum of squares near the start ``x``.

    Parameters
    ----------
    residuals
        Unknowns (k, designs) to residuals (designs, m).
    precision
        All tolerances of the solver.
    most
        Evaluations, at most.
    how
        Method or bounds of the solver.
    """
    steps = SLOPE * np.concatenate([np.eye(x.size), -np.eye(x.size)], axis=1)

    def jacobian(at: Array) -> Array:
        values = residuals(at[:, None] + steps)
        return np.asarray((values[: x.size] - values[x.size :]).T / (2 * SLOPE))

    found = least_squares(
        lambda at: residuals(at[:, None])[0],
        x,
        jac=jacobian,
        xtol=precision,
        ftol=precision,
        gtol=precision,
        max_nfev=most,
        **how,
    )
    return np.asarray(found.x)


_AXES = ("a0", "b0", "b1")

_PRECISION = 1e-15
"""Tolerances of the solver: down to rounding."""

_PENALTY_SAMPLES = 31
"""Crank angles per phase at which the transmission angle is bounded: one per degree of the published
travel."""

_SPREAD_RADIUS, _SPREAD_AZIMUTH, _SPREAD_AXIS = 0.15, 0.2, 0.1
"""Random starts differ from the first one by up to these shares of an arc, rad, and shares of the frame's
arc."""


class Freedom(Enum):
    """Which unknowns the fit has, by their number: six, and two for each axis that may move."""

    SIX = 6
    EIGHT = 8
    TWELVE = 12

    @property
    def axes(self) -> tuple[str, ...]:
        """The axes that may move."""
        return {6: (), 8: ("a0",), 12: _AXES}[self.value]


@dataclass(frozen=True, slots=True)
class Path:
    """What is wanted: input angles (n1,), (n2,), rad, of both phases, unit targets (3, n1 + n2)."""

    angles: Array
    angles_n: Array
    targets: Array


@dataclass(frozen=True, slots=True)
class Fit:
    """A fitted mechanism, with its errors (n1 + n2,) on the unit sphere, one per position."""

    mechanism: AdjustableFiveBar
    errors: Array

    @property
    def rms(self) -> float:
        """Root mean square over all positions."""
        return float(np.sqrt(np.mean(self.errors**2)))


def errors(mechanism: AdjustableFiveBar, path: Path) -> Array:
    """Structural errors (..., n1 + n2) of a mechanism as it is."""
    targets = path.targets
    found = mechanism.path(path.angles, path.angles_n)
    return norm(found - (targets if found.ndim == 2 else targets[:, None]))


def refine(
    start: AdjustableFiveBar,
    path: Path,
    freedom: Freedom,
    *,
    starts: int = 1,
    seed: int = 0,
    least_transmission: float = 0.0,
) -> list[Fit]:
    """Fit from the given mechanism, and from random ones around it.

    Parameters
    ----------
    start
        A mechanism that can be assembled, such as the projected one.
    path
        What is wanted.
    freedom
        The unknowns.
    starts
        Number of starts; all but the first are random.
    seed
        Of the random numbers: the same seed gives the same fits.
    least_transmission
        Bound of the transmission angle on both sides, rad: a start is held to it by a penalty.

    Returns
    -------
    fits
        One per start, in order.

    Raises
    ------
    KinematicsError
        The start cannot be assembled in some position.
    """
    problem = _Problem(start, path, freedom, least_transmission)
    first = problem.first()
    if not np.isfinite(errors(problem.mechanism(first), path)).all():
        raise KinematicsError(
            "the mechanism to start from cannot be assembled in all positions; "
            "start from a longer projection, or from other pins"
        )
    return [problem.solve(x) for x in [first, *problem.random(first, starts - 1, seed)]]


class _Problem:
    """Unknowns to mechanisms, and mechanisms to residuals; all for many designs at once."""

    def __init__(
        self, start: AdjustableFiveBar, path: Path, freedom: Freedom, least_transmission: float
    ) -> None:
        self._start, self._path, self._freedom = start, path, freedom
        self._least = least_transmission
        self._tangents = {name: _tangents(getattr(start, name)) for name in freedom.axes}

    def first(self) -> Array:
        """The unknowns of the start, with its mean arcs."""
        azimuths = (0.0, float(self._start.crank_setting), 0.0, float(self._start.rocker_setting))
        arcs = float(mean(self._start.crank_arcs)), float(mean(self._start.rocker_arcs))
        x = [arcs[0], *azimuths[:2], arcs[1], *azimuths[2:]]
        return np.array(x + [0.0] * (self._freedom.value - 6))

    def random(self, first: Array, count: int, seed: int) -> Sequence[Array]:
        """Unknowns of random starts that can be assembled in all positions."""
        generator = np.random.default_rng(seed)
        frame = float(np.arccos(np.clip(dot(self._start.a0, self._start.b0), -1, 1)))
        found: list[Array] = []
        while len(found) < count:
            x = first.copy()
            for place in (0, 3):
                x[place] *= 1 + _SPREAD_RADIUS * generator.uniform(-1, 1)
            for place in (1, 2, 4, 5):
                x[place] += _SPREAD_AZIMUTH * generator.uniform(-1, 1)
            x[6:] += _SPREAD_AXIS * frame * generator.uniform(-1, 1, x.size - 6)
            if np.isfinite(errors(self.mechanism(x), self._path)).all():
                found.append(x)
        return found

    def mechanism(self, x: Array) -> AdjustableFiveBar:
        """The mechanism of unknowns (k,), or the mechanisms of (k, designs)."""
        many = x.ndim == 2
        unknowns = x[:, :, None] if many else x
        axes = {}
        for name in _AXES:
            axis = getattr(self._start, name)
            axis = column(axis, np.empty((3, 1, 1))) if many else axis
            if name in self._tangents:
                place = 6 + 2 * self._freedom.axes.index(name)
                one, two = (column(t, axis) for t in self._tangents[name])
                axis = axis + unknowns[place] * one + unknowns[place + 1] * two
                axis = axis / norm(axis)
            axes[name] = axis
        start = self._start
        p1 = column(start.p1, np.empty((3, 1, 1))) if many else start.p1

        def pin(axis: Array, near: Array, arc: Array, azimuth: Array) -> Array:
            near = column(near, axis)
            side = near - axis * dot(axis, near)
            side = side / norm(side)
            return np.asarray(
                np.cos(arc) * axis
                + np.sin(arc) * (np.cos(azimuth) * side + np.sin(azimuth) * cross(axis, side))
            )

        r1, a, an, r3, c, cn = unknowns[:6]
        return AdjustableFiveBar(
            **axes,
            p1=p1,
            a1=pin(axes["a0"], start.a1, r1, a),
            a1n=pin(axes["a0"], start.a1, r1, an),
            c1=pin(axes["b1"], start.c1, r3, c),
            c1n=pin(axes["b1"], start.c1, r3, cn),
            ratio=start.ratio,
        )

    def residuals(self, x: Array) -> Array:
        """Residuals (designs, m) of unknowns (k, designs)."""
        mechanism = self.mechanism(x)
        misses = mechanism.path(self._path.angles, self._path.angles_n) - self._path.targets[:, None]
        found = [np.moveaxis(misses, 1, 0).reshape(x.shape[1], -1)]
        if self._least > 0:
            found.append(self._pinched(mechanism))
        whole = np.concatenate(found, axis=1)
        return assembled(whole)

    def _pinched(self, mechanism: AdjustableFiveBar) -> Array:
        """By how much the transmission angle leaves its bounds over both travels, (designs, samples), rad."""
        found = []
        for number, angles in ((1, self._path.angles), (2, self._path.angles_n)):
            sweep = np.linspace(angles.min(), angles.max(), _PENALTY_SAMPLES)
            mu = mechanism.phase(number).at(Turning.of(sweep), 0).transmission
            found.append(np.maximum(self._least - np.minimum(mu, np.pi - mu), 0.0))
        return np.concatenate(found, axis=-1)

    def solve(self, x: Array) -> Fit:
        """Fit from one start."""
        mechanism = self.mechanism(fitted(self.residuals, x, _PRECISION, 400, method="lm"))
        return Fit(mechanism, errors(mechanism, self._path))


def _tangents(axis: Array) -> tuple[Array, Array]:
    one = perpendicular(axis)
    return one, cross(axis, one)
