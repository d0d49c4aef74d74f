"""Planar adjustable synthesis: pins of both phases from coupler poses, by constant lengths.

A point q of the coupler stands at D_1j q = p_j + e^(i γ_j) (q - p_1) in position j (the displacement matrix
in complex numbers). A dyad asks for one length in all positions: |D_1j a1 - a0| = R1 for the crank, |D_1j c1
- b1_j| = R3 for the rocker, whose far end moves with the arm, and the same for the pins of phase 2. Per dyad
there are five unknowns. The source writes five equations and leaves the two reference positions out; with
them there are seven, which close only for data that come from such a mechanism, and which are the better
conditioned form: they are solved by least squares.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechwright import Array, KinematicsError

Complex = NDArray[np.complex128]
"""Points of the plane."""

Equations = Literal["five", "seven"]
"""``five`` as the source counts, ``seven`` with the reference positions."""

SINGULAR = 1e12
"""Condition number above which the equations do not determine the pins: four digits of them would be left."""

_PRECISION = 1e-15
"""Tolerances of the solver: to rounding, the problems are tiny."""


@dataclass(frozen=True, slots=True)
class CouplerPoses:
    """Where the coupler has to be.

    Parameters
    ----------
    path
        Path points (n,) of phase 1, its reference position first, as complex numbers.
    turns
        Coupler angles (n,), rad, from the reference position; the first is 0.
    path_n, turns_n
        The same for phase 2.
    """

    path: Complex
    turns: Array
    path_n: Complex
    turns_n: Array


@dataclass(frozen=True, slots=True)
class Dyad:
    """A solved dyad.

    Parameters
    ----------
    unknowns
        (5,): a0y, a1, a1n of the crank; c1, c1n, R3 of the rocker.
    condition
        Condition number of the equations at the solution: by so much errors of the data may grow.
    residual
        Root mean square of the lengths' errors in all positions, the reference positions too.
    """

    unknowns: Array
    condition: float
    residual: float


def points(pairs: ArrayLike) -> Complex:
    """Complex numbers (...) from coordinates (..., 2)."""
    pairs = np.asarray(pairs, dtype=float)
    return np.asarray(pairs[..., 0] + 1j * pairs[..., 1])


def crank_dyad(
    poses: CouplerPoses, a0x: float, length: float, guess: ArrayLike, equations: Equations = "seven"
) -> Dyad:
    """Find a0y, a1 and a1n for a crank of a given length on an axis at a given x.

    Raises
    ------
    KinematicsError
        The equations have no solution near the guess.
    """

    def pins(x: Array) -> tuple[complex, complex, Complex, Complex, float]:
        centre = complex(a0x, x[0])
        return (
            complex(x[1], x[2]),
            complex(x[3], x[4]),
            np.full(poses.path.shape, centre),
            np.full(poses.path_n.shape, centre),
            length,
        )

    # a0y moves all centres; the pins are unknowns 1 to 4.
    return _solve(poses, pins, guess, equations, centre=0, first=1, radius=None)


def rocker_dyad(
    poses: CouplerPoses,
    arm_pins: Complex,
    arm_pins_n: Complex,
    guess: ArrayLike,
    equations: Equations = "seven",
) -> Dyad:
    """Find c1, c1n and R3 for a rocker whose far pin stands at ``arm_pins`` (n,), (m,) in the positions."""

    def pins(x: Array) -> tuple[complex, complex, Complex, Complex, float]:
        return complex(x[0], x[1]), complex(x[2], x[3]), arm_pins, arm_pins_n, float(x[4])

    return _solve(poses, pins, guess, equations, centre=None, first=0, radius=4)


def crank_angles(poses: CouplerPoses, a0: complex, a1: complex, a1n: complex) -> tuple[Array, Array]:
    """Crank displacements (n,), (m,), rad, from each phase's reference position."""
    found = []
    for pin, path, turns in ((a1, poses.path, poses.turns), (a1n, poses.path_n, poses.turns_n)):
        seen = np.angle((displaced(pin, path, turns) - a0) / (pin - a0))
        found.append(np.unwrap(seen))
    return found[0], found[1]


def displaced(pin: complex, path: Complex, turns: Array) -> Complex:
    """A coupler point in all positions (n,): D_1j q."""
    return np.asarray(path + np.exp(1j * turns) * (pin - path[0]))


def arm_pins(b0: complex, b1: complex, ratio: float, angles: Array) -> Complex:
    """The arm's pin (n,) at crank displacements (n,), rad."""
    return np.asarray(b0 + np.exp(1j * ratio * angles) * (b1 - b0))


def _solve(
    poses: CouplerPoses,
    pins: Callable[[Array], tuple[complex, complex, Complex, Complex, float]],
    guess: ArrayLike,
    equations: Equations,
    *,
    centre: int | None,
    first: int,
    radius: int | None,
) -> Dyad:
    from scipy.optimize import least_squares

    rows = slice(None) if equations == "seven" else slice(1, None)

    def reach(x: Array) -> tuple[tuple[Complex, Complex], float]:
        one, two, centres, centres_n, length = pins(x)
        return (
            displaced(one, poses.path, poses.turns)[rows] - centres[rows],
            displaced(two, poses.path_n, poses.turns_n)[rows] - centres_n[rows],
        ), length

    def residuals(x: Array) -> Array:
        lines, length = reach(x)
        return np.concatenate([np.abs(line) ** 2 - length**2 for line in lines])

    def jacobian(x: Array) -> Array:
        lines, length = reach(x)
        found = np.zeros((lines[0].size + lines[1].size, 5))
        start = 0
        for place, (line, turns) in enumerate(zip(lines, (poses.turns, poses.turns_n), strict=True)):
            here = slice(start, start + line.size)
            # |D q - g|² changes by 2 Re(conj(D q - g) e^(iγ) dq).
            slope = 2 * np.conj(line) * np.exp(1j * turns[rows])
            found[here, first + 2 * place] = slope.real
            found[here, first + 2 * place + 1] = -slope.imag
            if centre is not None:
                found[here, centre] = -2 * line.imag
            start += line.size
        if radius is not None:
            found[:, radius] = -2 * length
        return found

    found = least_squares(
        residuals,
        np.asarray(guess, dtype=float),
        jac=jacobian,
        method="lm",
        xtol=_PRECISION,
        ftol=_PRECISION,
        gtol=_PRECISION,
        max_nfev=2000,
    )
    condition = float(np.linalg.cond(jacobian(found.x)))
    if not found.success or not condition < SINGULAR:
        raise KinematicsError(
            f"the dyad's equations do not converge from the guess {np.asarray(guess).tolist()}; "
            "start nearer to the wanted pins"
        )
    one, two, centres, centres_n, length = pins(found.x)
    spans = np.concatenate(
        [
            np.abs(displaced(one, poses.path, poses.turns) - centres),
            np.abs(displaced(two, poses.path_n, poses.turns_n) - centres_n),
        ]
    )
    return Dyad(found.x, condition, float(np.sqrt(np.mean((spans - length) ** 2))))


@dataclass(frozen=True, slots=True)
class PlanarSynthesis:
    """The planar mechanism that both dyads make.

    Parameters
    ----------
    pins
        ``a0``, ``a1``, ``a1n``, ``b0``, ``b1``, ``c1``, ``c1n``.
    angles, angles_n
        Crank displacements, rad, of both phases.
    crank, rocker
        The dyads.
    """

    pins: dict[str, tuple[float, float]]
    angles: Array
    angles_n: Array
    crank: Dyad
    rocker: Dyad


def synthesise(
    poses: CouplerPoses,
    *,
    a0x: float,
    crank_length: float,
    b0: complex,
    arm_length: float,
    arm_angle: float,
    ratio: float,
    crank_guess: ArrayLike,
    rocker_guess: ArrayLike,
    equations: Equations = "seven",
) -> PlanarSynthesis:
    """Solve both dyads, one after the other: the rocker's needs the angles of the crank.

    ``arm_angle`` is the arm's angle in the reference positions, rad. Lengths are in the plane's unit.
    """
    crank = crank_dyad(poses, a0x, crank_length, crank_guess, equations)
    a0, a1, a1n = complex(a0x, crank.unknowns[0]), *points(crank.unknowns[1:].reshape(2, 2))
    angles, angles_n = crank_angles(poses, a0, a1, a1n)
    b1 = b0 + arm_length * complex(np.cos(arm_angle), np.sin(arm_angle))
    rocker = rocker_dyad(
        poses,
        arm_pins(b0, b1, ratio, angles),
        arm_pins(b0, b1, ratio, angles_n),
        rocker_guess,
        equations,
    )
    c1, c1n = points(rocker.unknowns[:4].reshape(2, 2))
    named = {"a0": a0, "a1": a1, "a1n": a1n, "b0": b0, "b1": b1, "c1": c1, "c1n": c1n}
    pins = {name: (float(z.real), float(z.imag)) for name, z in named.items()}
    return PlanarSynthesis(pins, angles, angles_n, crank, rocker)
