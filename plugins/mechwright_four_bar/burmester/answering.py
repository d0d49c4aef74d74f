"""Synthesis of a linkage whose follower answers angles of the crank."""

import math
from collections import Counter

import numpy as np
from scipy.optimize import least_squares as fit

from mechwright import Array, Finding, Progress, Scalar, Synthesis
from mechwright_four_bar.burmester import freudenstein
from mechwright_four_bar.burmester.freudenstein import Answering
from mechwright_four_bar.burmester.kept import Option, designs, penalties
from mechwright_four_bar.burmester.rectify import Way, way_through
from mechwright_four_bar.burmester.requirements import FunctionRequirement
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.loop import close
from mechwright_four_bar.params import FourBarParams

GRID = 48
"""Offsets of each angle among which a fit begins."""

FITTED = 8
"""Best of these that are followed."""

FAILED = 1e3
"""Error, rad, of a linkage that cannot be joined, while it is fitted."""

SAME = 1e-6
"""Share of the ground within which two linkages are one."""


def through_angles(wanted: FunctionRequirement, progress: Progress) -> Synthesis[FourBarParams]:
    """Linkages whose follower stands at its angles when the crank stands at its own, on one branch, in order.

    As many pairs as there are unknowns are met exactly: 3, with the follower counted from anywhere 4, with
    both links 5; the best transmission angle leads. More are met as nearly as can be, by least squares of
    the follower's error.
    """
    phi, psi = np.radians(wanted.crank_angles), np.radians(wanted.follower_angles)
    exact = {"none": 3, "follower": 4, "both": 5}[wanted.offsets]
    solve = {3: freudenstein.of_three, 4: freudenstein.of_four, 5: freudenstein.of_five}[exact]
    met = phi.size == exact
    found = solve(phi, psi) if met else _nearest(phi, psi, wanted)
    progress(0.5, "linkages that answer")
    defects: Counter[str] = Counter()
    options: list[Option] = []
    for one in found:
        way = _way(one, phi, psi, wanted.ground)
        if isinstance(way, str):
            defects[way] += 1
        else:
            options.append(_option(way, psi))
    options.sort(key=lambda one: -one.way.least_angle if met else one.error.value)
    result = designs(
        "function",
        options,
        dict(defects),
        wanted,
        lambda: f"{len(found)} linkages answer {phi.size} pairs, {len(options)} of them without a defect",
        lambda part: progress(0.5 + part / 2, "designs"),
    )
    if not result.candidates or not wanted.tolerance:
        return result
    best = math.degrees(min(one.residual.value for one in result.candidates))
    if best <= wanted.tolerance:
        return result
    missed = Finding.warning(
        "function.missed",
        "follower",
        f"no linkage was found whose follower errs by at most {wanted.tolerance:g} degrees: the best one "
        f"errs by {best:.4g}",
        best,
        wanted.tolerance,
        "deg",
        "allow a larger tolerance, or count more angles from anywhere (offsets)",
    )
    return Synthesis(result.candidates, (*result.findings, missed), result.rejected)


def _bar(one: Answering, ground: float, branch: int = 1) -> FourBar:
    return FourBar(one.crank * ground, one.coupler * ground, one.follower * ground, ground, 0.0, branch)


def _way(one: Answering, phi: Array, psi: Array, ground: float) -> Way | str:
    """How the crank goes through its angles, the joints at their wanted places."""
    a = one.crank * ground * np.exp(1j * (phi - phi[0] + one.phi))
    b = ground + one.follower * ground * np.exp(1j * (psi - psi[0] + one.psi))
    way = way_through(0j, complex(ground), a, b)
    if isinstance(way, str):
        return way
    return Way(_bar(one, ground, way.bar.branch), way.phi, way.full)


def _option(way: Way, psi: Array) -> Option:
    """A linkage with the greatest error of its follower, whose offset is the one that makes it least."""
    answer = np.angle(close(way.bar, way.phi).follower.direction * np.exp(-1j * psi))
    turned = np.unwrap(answer)
    middle = (turned.max() + turned.min()) / 2
    figures = {
        "mean_error": Scalar(float(np.sqrt(np.mean((turned - middle) ** 2))), "rad"),
        "first_follower_angle": Scalar(float((middle + psi[0]) % math.tau), "rad"),
    }
    return Option(way, Scalar(float(np.ptp(turned) / 2), "rad"), figures)


def _nearest(phi: Array, psi: Array, wanted: FunctionRequirement) -> list[Answering]:
    """Linkages fitted to more pairs than can be met, the nearest first."""
    free = {"none": (False, False), "follower": (False, True), "both": (True, True)}[wanted.offsets]
    turns = np.arange(GRID) * math.tau / GRID
    one, two = np.meshgrid(*(turns if each else np.zeros(1) for each in free), indexing="ij")
    starts: list[tuple[float, Answering]] = []
    for x, y in zip(one.ravel(), two.ravel(), strict=True):
        k = freudenstein.coefficients(phi + x, psi + y)
        answering = freudenstein.linkage_of(k, float(phi[0] + x), float(psi[0] + y))
        if answering is not None:
            error = _errors(answering, phi, psi, wanted.ground)
            starts.append((float(error @ error), answering))
    starts.sort(key=lambda start: start[0])
    found: list[Answering] = []
    for _, start in starts[:FITTED]:
        result = _fitted(start, phi, psi, free, wanted)
        if all(
            abs(math.log(result.crank / other.crank)) + abs(math.log(result.follower / other.follower)) > SAME
            for other in found
        ):
            found.append(result)
    return found


def _errors(one: Answering, phi: Array, psi: Array, ground: float) -> Array:
    """Errors of the follower (n,), rad, on the branch of the first pair."""
    a = one.crank * np.exp(1j * one.phi)
    b = 1 + one.follower * np.exp(1j * one.psi)
    branch = 1 if (np.conj(1 - a) * (b - a)).imag > 0 else -1
    loop = close(_bar(one, ground, branch), phi - phi[0] + one.phi)
    errors: Array = np.angle(loop.follower.direction * np.exp(-1j * (psi - psi[0] + one.psi)))
    return np.nan_to_num(errors, nan=FAILED)


def _fitted(
    start: Answering, phi: Array, psi: Array, free: tuple[bool, bool], wanted: FunctionRequirement
) -> Answering:
    """The linkage with the least squares of the follower's errors, within the limits."""

    def linkage(x: Array) -> Answering:
        a, c, b = (float(length) for length in np.exp(x[:3]))
        offsets = iter(x[3:])
        one = float(next(offsets)) if free[0] else start.phi
        two = float(next(offsets)) if free[1] else start.psi
        return Answering(a, c, b, one, two)

    def residual(x: Array) -> Array:
        one = linkage(x)
        limits = penalties(_bar(one, wanted.ground), phi - phi[0] + one.phi, wanted)
        return np.concatenate((_errors(one, phi, psi, wanted.ground), limits))

    x = [math.log(length) for length in (start.crank, start.coupler, start.follower)]
    x += [value for value, each in zip((start.phi, start.psi), free, strict=True) if each]
    return linkage(fit(residual, np.array(x), xtol=1e-14, ftol=1e-14, gtol=1e-14, max_nfev=200).x)
