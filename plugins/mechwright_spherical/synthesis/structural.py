"""What the projection costs: the structural error over the projection length and over its centre.

The targets are the projected path points, the mechanism is the projected one, and each phase keeps its own
arcs. The error is a chord on the unit sphere; times d it is at the scale of the plane. That product rises
from 0 to a peak and then falls for ever as K/d²: there is no optimum, only a smallest length that meets a
tolerance from there on. Another centre of the projection makes the error smaller for nothing.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array, KinematicsError
from mechwright.mechanics.adjustable import Pins, follow
from mechwright_spherical.kinematics.chain import EDGE
from mechwright_spherical.kinematics.five_bar import projected
from mechwright_spherical.kinematics.projection import project
from mechwright_spherical.kinematics.vectors import norm
from mechwright_spherical.synthesis.space import SphereSpace

LONGEST = 1e4
"""Projection lengths above this, in units of the planar mechanism, are not looked at: arcs become hundredths
of a degree, and no link can be made so short."""

_PER_DECADE = 200
"""Lengths per decade at which the error is looked at before a crossing is solved for: the peak is one decade
wide."""

_STEP_DOWN = 0.9
"""Factor between lengths on the way down to the one with the best centre: the error falls with the square."""

_GRID = 41
"""Centres per side of the grid: one per twentieth of the mechanism's size."""

_SLOPE = 1e-6
"""Step of difference quotients, in sizes of the mechanism: halfway between rounding and curvature."""

_LEVEL = 1e-11
"""Part of the greatest error to which its least level is found: the centre then stands still to 1e-6."""


@dataclass(frozen=True, slots=True)
class PlanarDesign:
    """A planar adjustable five-bar with its path.

    Parameters
    ----------
    pins
        ``a0``, ``a1``, ``a1n``, ``b0``, ``b1``, ``c1``, ``c1n``.
    ratio
        Of the drive.
    angles, angles_n
        Crank displacements of both phases, rad, the first of each 0.
    targets
        Path points (n1 + n2, 2) wanted at them.
    """

    pins: dict[str, tuple[float, float]]
    ratio: float
    angles: Array
    angles_n: Array
    targets: Array

    @property
    def corners(self) -> Array:
        """All pins and points (n, 2): where the mechanism lies."""
        return np.array([*self.pins.values(), *self.targets])

    def errors(self, length: Array, centre: Array) -> Array:
        """Errors (designs, positions) at lengths (designs,) and centres (designs, 2)."""
        mechanism = projected(self.pins, self.targets[0], length, self.ratio, centre=centre)
        wanted = np.moveaxis(project(self.targets, length[:, None], centre=centre[:, None]), -1, 0)
        return norm(mechanism.path(self.angles, self.angles_n) - wanted)


@dataclass(frozen=True, slots=True)
class PhasedDesign:
    """A planar four-bar or five-bar of any number of phases, with its paths.

    Parameters
    ----------
    pins
        (phases,), complex, in the pose of setting.
    ratio
        Of the drive; 0 for a four-bar.
    phase
        (n,) phase of each position, from 0.
    angles
        (n,) crank angles from the pose of setting, rad.
    targets
        (n,) path points, complex.
    """

    pins: Pins
    ratio: float
    phase: np.ndarray
    angles: Array
    targets: np.ndarray

    @property
    def corners(self) -> Array:
        """All pins and points (n, 2): where the mechanism lies."""
        found = np.concatenate([*(getattr(self.pins, name) for name in Pins.__slots__), self.targets])
        return np.column_stack([found.real, found.imag])

    def errors(self, length: Array, centre: Array) -> Array:
        """Errors (designs, positions) at lengths (designs,) and centres (designs, 2)."""
        wanted = on_sphere(self.targets, length, centre)
        found, cosine = follow(
            SphereSpace(np.array([0.0, 0.0, 1.0])),
            projected_pins(self.pins, length, centre).of(self.phase),
            self.ratio,
            self.angles,
        )
        return np.where(np.abs(cosine) <= 1 + EDGE, norm(found - wanted), np.nan)


def on_sphere(points: np.ndarray, length: Array, centre: Array) -> Array:
    """Complex points (n,) projected with lengths (designs,) and centres (designs, 2): (3, designs, n)."""
    flat = np.stack([points.real, points.imag], axis=-1)
    return np.moveaxis(project(flat, length[:, None], centre=centre[:, None]), -1, 0)


def projected_pins(pins: Pins, length: Array, centre: Array) -> Pins:
    """Pins (phases,) of the plane as vectors (3, designs, phases)."""
    return Pins(*(on_sphere(getattr(pins, name), length, centre) for name in Pins.__slots__))


class Projectable(Protocol):
    """A planar mechanism with its path, and the errors that its projection makes."""

    @property
    def corners(self) -> Array:
        """Pins and points (n, 2)."""

    def errors(self, length: Array, centre: Array) -> Array:
        """Errors (designs, positions) at lengths (designs,) and centres (designs, 2)."""


def errors(design: Projectable, length: ArrayLike, centre: ArrayLike = (0.0, 0.0)) -> Array:
    """Structural error (..., n1 + n2) on the unit sphere at projection lengths (...) and centres (..., 2).

    NaN where the projected mechanism cannot be assembled.
    """
    d, where = np.asarray(length, dtype=float), np.asarray(centre, dtype=float)
    shape = np.broadcast_shapes(d.shape, where.shape[:-1])
    d = np.broadcast_to(d, shape).reshape(-1)
    where = np.broadcast_to(where, (*shape, 2)).reshape(-1, 2)
    return np.asarray(design.errors(d, where).reshape(*shape, -1))


def scaled_error(design: Projectable, length: ArrayLike, position: int | None = None) -> Array:
    """Error times length (...): of one position, counted from 1, or the greatest of all."""
    found = errors(design, length) * np.asarray(length, dtype=float)[..., None]
    return np.asarray(found.max(axis=-1) if position is None else found[..., position - 1])


def smallest_length(
    design: Projectable, tolerance: float, position: int | None = None, *, best: bool = False
) -> float:
    """The length from which on the error times the length stays within ``tolerance``.

    Parameters
    ----------
    design
        The planar mechanism.
    tolerance
        At the scale of the plane, above 0.
    position
        Look at this position only, counted from 1; None for all of them.
    best
        Move the projection's centre to where the greatest error over all positions is least.

    Raises
    ------
    KinematicsError
        No length up to ``LONGEST`` meets it: the planar mechanism itself misses its path by more.
    """
    from scipy.optimize import brentq

    lengths = grid()
    values = scaled_error(design, lengths, None if best else position)
    above = np.flatnonzero(~(values <= tolerance))  # also where it cannot be assembled
    if above.size == 0:
        return float(lengths[0])
    last = int(above[-1])
    if last == len(lengths) - 1:
        raise KinematicsError(
            f"no projection length up to {LONGEST:g} brings the error down to {tolerance:g}; it is still "
            f"{values[-1]:.3g}: the planar mechanism does not meet its own path, so refine that first"
        )
    low, high = float(lengths[last]), float(lengths[last + 1])
    if not best:
        return float(brentq(lambda d: float(scaled_error(design, d, position)) - tolerance, low, high))

    centre, _ = best_centre(design, high)

    def excess(d: float) -> float:
        return best_centre(design, d, centre)[1] * d - tolerance

    # The best centre is never worse than the origin, so nothing above ``high`` needs a look.
    while excess(low) <= 0:
        low, high = low * _STEP_DOWN, low
        if low < lengths[0]:
            return float(lengths[0])
    return float(brentq(excess, low, high, rtol=1e-9))


def best_centre(design: Projectable, length: float, near: ArrayLike | None = None) -> tuple[Array, float]:
    """Centre (2,) with the least greatest error over the positions, and that error on the unit sphere.

    A minimax problem in two unknowns. A grid over the mechanism and its surroundings finds the valley; then
    the least level over all errors is found as a linear programme with curved borders, since where the
    greatest errors of two positions meet there is an edge that misleads any descent. ``near`` (2,) replaces
    the grid.
    """
    from scipy.optimize import minimize

    corners = design.corners
    middle, half = (corners.min(axis=0) + corners.max(axis=0)) / 2, float(np.ptp(corners, axis=0).max())
    if near is None:
        side = np.linspace(-1, 1, _GRID)
        grid = middle + half * np.stack(np.meshgrid(side, side, indexing="ij"), axis=-1)
    else:
        grid = np.asarray(near, dtype=float).reshape(1, 1, 2)
    worst = errors(design, length, grid).max(axis=-1)
    place = np.unravel_index(int(np.argmin(np.where(np.isfinite(worst), worst, np.inf))), worst.shape)
    at, value = grid[place], float(worst[place])
    scale = value  # errors in units of this, so that all unknowns are of the order 1
    step = _SLOPE * half
    around = step * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])

    def slack(unknowns: Array) -> Array:
        return np.asarray(unknowns[2] - errors(design, length, unknowns[:2]) / scale)

    def slopes(unknowns: Array) -> Array:
        found = errors(design, length, unknowns[:2] + around) / scale
        return np.column_stack(
            [(found[2] - found[1]) / (2 * step), (found[4] - found[3]) / (2 * step), np.ones(found.shape[1])]
        )

    found = minimize(
        lambda unknowns: unknowns[2],
        [*at, 1.0],
        jac=lambda unknowns: np.array([0.0, 0.0, 1.0]),  # noqa: ARG005
        constraints={"type": "ineq", "fun": slack, "jac": slopes},
        method="SLSQP",
        options={"ftol": _LEVEL, "maxiter": 100},
    )
    better = float(errors(design, length, found.x[:2]).max())
    return (np.asarray(found.x[:2]), better) if better < value else (at, value)


def grid() -> Array:
    """Projection lengths (n,) at which the error is looked at."""
    decades = np.log10(LONGEST) + 2
    return np.logspace(-2, np.log10(LONGEST), int(decades * _PER_DECADE) + 1)
