"""Linkages whose follower answers more angles of the crank than can be met: the nearest within the limits.

Fits begin at Freudenstein's linear least squares for a grid of offsets, and at random linkages that keep the
lengths: where the limits bind, the linear ones lie far beyond them.
"""

import math

import numpy as np
from scipy.optimize import least_squares as fit

from mechwright import Array
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.synthesis.burmester import freudenstein
from mechwright_four_bar.synthesis.burmester.freudenstein import Answering
from mechwright_four_bar.synthesis.burmester.kept import WEIGHTS, penalties
from mechwright_four_bar.synthesis.burmester.requirements import FunctionRequirement

GRID = 48
"""Offsets of each angle among which a fit begins."""

RANDOM, SEED = 2000, 23
"""Random linkages among which a fit begins, and their seed."""

FITTED, APART = 16, 0.2
"""Best starts that are followed, no two of which agree so far in the logarithms of their links and in their
angles, rad."""

FAILED = 1e3
"""Error, rad, of a linkage that cannot be joined, while it is fitted."""

SAME = 1e-6
"""Logarithm of a length, and rad, within which two linkages are one."""

Free = tuple[bool, bool]
"""Whether the crank's and the follower's angles are counted from anywhere."""


def nearest(phi: Array, psi: Array, wanted: FunctionRequirement) -> list[Answering]:
    """Linkages fitted to pairs of angles (n,), rad, within the limits, the nearest first."""
    free = {"none": (False, False), "follower": (False, True), "both": (True, True)}[wanted.offsets]
    every = [*_linear(phi, psi, free), *_random(phi, psi, free, wanted)]
    costs = np.array([_cost(one, phi, psi, wanted, 1.0) for one in every])
    ends = [_fitted(one, phi, psi, free, wanted) for one in _apart(every, costs, APART)[:FITTED]]
    return _apart(ends, np.array([_cost(one, phi, psi, wanted, WEIGHTS[-1]) for one in ends]), SAME)


def _apart(found: list[Answering], costs: Array, near: float) -> list[Answering]:
    """Linkages by their costs, without those that are near to a better one."""
    kept: list[Answering] = []
    rows: list[Array] = []
    for k in np.argsort(costs, kind="stable").tolist():
        one = found[k]
        lengths = np.log([one.crank, one.coupler, one.follower])
        row = np.concatenate((lengths, np.cos([one.phi, one.psi]), np.sin([one.phi, one.psi])))
        if all(np.abs(row - other).max() > near for other in rows):
            kept.append(one)
            rows.append(row)
        if near == APART and len(kept) == FITTED:
            break
    return kept


def _linear(phi: Array, psi: Array, free: Free) -> list[Answering]:
    """Freudenstein's linkages on a grid of the free offsets."""
    turns = np.arange(GRID) * math.tau / GRID
    one, two = np.meshgrid(*(turns if each else np.zeros(1) for each in free), indexing="ij")
    found = []
    for x, y in zip(one.ravel(), two.ravel(), strict=True):
        k = freudenstein.coefficients(phi + x, psi + y)
        answering = freudenstein.linkage_of(k, float(phi[0] + x), float(psi[0] + y))
        if answering is not None:
            found.append(answering)
    return found


def _random(phi: Array, psi: Array, free: Free, wanted: FunctionRequirement) -> list[Answering]:
    """Linkages that keep the lengths and can be joined at all angles, the follower where it answers best."""
    rng = np.random.default_rng(SEED)
    low, high = math.log(wanted.shortest_link / wanted.ground), math.log(wanted.longest_link / wanted.ground)
    found = []
    for _ in range(RANDOM):
        a, c, b = np.exp(rng.uniform(low, high, 3)).tolist()
        start = float(rng.uniform(-math.pi, math.pi)) if free[0] else float(phi[0])
        one = Answering(a, c, b, start, 0.0)
        branch = int(rng.choice((1, -1)))
        answer = close(one.bar(1.0, branch), phi - phi[0] + start).follower.direction
        middle = (answer * np.exp(-1j * (psi - psi[0]))).sum()
        if np.isfinite(middle):
            turn = float(np.angle(middle)) if free[1] else float(psi[0])
            found.append(Answering(a, c, b, start, turn))
    return found


def _errors(one: Answering, phi: Array, psi: Array) -> Array:
    """Errors of the follower (n,), rad, on the branch of the first pair."""
    a = one.crank * np.exp(1j * one.phi)
    b = 1 + one.follower * np.exp(1j * one.psi)
    branch = 1 if (np.conj(1 - a) * (b - a)).imag > 0 else -1
    loop = close(one.bar(1.0, branch), phi - phi[0] + one.phi)
    errors: Array = np.angle(loop.follower.direction * np.exp(-1j * (psi - psi[0] + one.psi)))
    return np.nan_to_num(errors, nan=FAILED)


def _residual(one: Answering, phi: Array, psi: Array, wanted: FunctionRequirement, weight: float) -> Array:
    limits = penalties(one.bar(wanted.ground), phi - phi[0] + one.phi, wanted, weight)
    return np.concatenate((_errors(one, phi, psi), limits))


def _cost(one: Answering, phi: Array, psi: Array, wanted: FunctionRequirement, weight: float) -> float:
    residual = _residual(one, phi, psi, wanted, weight)
    return float(residual @ residual)


def _fitted(start: Answering, phi: Array, psi: Array, free: Free, wanted: FunctionRequirement) -> Answering:
    """The linkage with the least squares of the follower's errors, within the limits."""

    def linkage(x: Array) -> Answering:
        a, c, b = (float(length) for length in np.exp(x[:3]))
        offsets = iter(x[3:])
        one = float(next(offsets)) if free[0] else start.phi
        two = float(next(offsets)) if free[1] else start.psi
        return Answering(a, c, b, one, two)

    def residual(x: Array, weight: float) -> Array:
        return _residual(linkage(x), phi, psi, wanted, weight)

    x = np.log([start.crank, start.coupler, start.follower])
    x = np.append(x, [value for value, each in zip((start.phi, start.psi), free, strict=True) if each])
    for weight in WEIGHTS:
        x = fit(residual, x, xtol=1e-14, ftol=1e-14, gtol=1e-14, max_nfev=200, args=(weight,)).x
    return linkage(x)
