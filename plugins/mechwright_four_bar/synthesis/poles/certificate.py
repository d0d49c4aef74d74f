"""Poles in ball arithmetic: residuals that are certain, and solutions polished to the last digit of a double.

Every number is a ball, a midpoint with a radius that holds the true value (Arb). A residual whose ball lies
below a limit is below it, whatever has been rounded on the way.
"""

from collections.abc import Sequence

import numpy as np
from flint import acb, arb, ctx

from mechwright import Array
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.synthesis.poles.equations import PoleProblem

BITS = 160
"""Working precision: some 48 digits, of which a position a hair from a toggle takes a third."""

DIFFERENCE = 60
"""The slopes are differences over 2^-60 of a length or a radian: exact to 18 digits, and 30 are left."""

NEWTON_STEPS = 3
"""Steps from a solution of ten digits to one of more than a double holds; each doubles them."""


def pole_ball(lengths: Sequence[arb], theta: arb, phi: arb, branch: int, ratio: float = 0.0) -> acb:
    """Acceleration pole of the coupler from balls for crank, coupler, follower, ground, mm, and angles, rad.

    ``ratio`` is the crank's acceleration ratio. The precision is that of ``flint.ctx``; the ball is infinite
    where the loop does not certainly close.
    """
    a, c, b, f = lengths
    crank = acb(a) * acb(0, phi).exp()
    d = acb(f) * acb(0, theta).exp() - crank
    square = d.real * d.real + d.imag * d.imag
    k = c * c - b * b + square
    room = (4 * c * c * square - k * k).sqrt()
    s = d * acb(k, branch * room) / (2 * c * square)
    p = (c * s - d) / b
    sine = (s * p.conjugate()).imag
    r = acb(0, -1) * crank
    w, v = -(r * p.conjugate()).real / (c * sine), -(r * s.conjugate()).real / (b * sine)
    r = crank + c * w * w * s - b * v * v * p
    alpha = -(r * p.conjugate()).real / (c * sine) + ratio * w
    return crank * (1 + acb(1, -ratio) / acb(-w * w, alpha))


def certain_residual(bar: FourBar, phi: Sequence[float] | Array, problem: PoleProblem) -> float:
    """A distance, mm, that no pole of this very linkage exceeds from its place (n,).

    The doubles of ``bar`` and ``phi`` (n,) are taken as exact; infinite where the loop does not certainly
    close.
    """
    with ctx.workprec(BITS):
        errors = _errors(_balls([*bar.lengths, bar.ground_angle, *phi]), bar.branch, problem)
        worst = 0.0
        for error in errors:
            bound = error.abs_upper()
            if not bound.is_finite():
                return float("inf")
            worst = max(worst, float(bound) * (1 + 4 * float(np.finfo(float).eps)))
        return worst


def polished(
    bar: FourBar, phi: Array, problem: PoleProblem, free: Sequence[Sequence[int]]
) -> tuple[FourBar, Array]:
    """The nearest exact solution, rounded once.

    Parameters
    ----------
    bar, phi
        An approximate solution.
    problem
        Its poles.
    free
        What may change: groups of indices into crank, coupler, follower, ground, ground angle, then the crank
        angles. The members of a group move by the same amount.
    """
    with ctx.workprec(BITS):
        values = _balls([*bar.lengths, bar.ground_angle, *phi])
        step = arb(2) ** -DIFFERENCE
        for _ in range(NEWTON_STEPS):
            errors = _errors(values, bar.branch, problem)
            error = _numbers(errors, arb(1))
            slopes = []
            for group in free:
                moved = [value + step if i in group else value for i, value in enumerate(values)]
                change = [
                    one - two for one, two in zip(_errors(moved, bar.branch, problem), errors, strict=True)
                ]
                slopes.append(_numbers(change, step))
            matrix = np.column_stack(slopes)
            if not (np.isfinite(matrix).all() and np.isfinite(error).all()):
                return bar, phi
            # Columns of equal size: the least step is then one in shares, not in millimetres and radians.
            size = np.linalg.norm(matrix, axis=0) + np.finfo(float).tiny
            steps = np.linalg.lstsq(matrix / size, -error, rcond=None)[0] / size
            for group, amount in zip(free, steps.tolist(), strict=True):
                for i in group:
                    values[i] = (values[i] + arb(amount)).mid()
        a, c, b, f, theta, *angles = (float(value) for value in values)
    return FourBar(a, c, b, f, theta, bar.branch), np.array(angles)


def _balls(numbers: Sequence[float]) -> list[arb]:
    return [arb(float(number)) for number in numbers]


def _errors(values: Sequence[arb], branch: int, problem: PoleProblem) -> list[acb]:
    """By how much poles miss their places, of balls for lengths, ground angle and crank angles."""
    lengths, theta, angles = values[:4], values[4], values[5:]
    return [
        pole_ball(lengths, theta, angle, branch, float(ratio)) - acb(float(target.real), float(target.imag))
        for angle, ratio, target in zip(angles, problem.each_ratio, problem.targets, strict=True)
    ]


def _numbers(errors: Sequence[acb], unit: arb) -> Array:
    return np.array([float(part / unit) for error in errors for part in (error.real, error.imag)])
