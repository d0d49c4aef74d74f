"""Poles in ball arithmetic: residuals that are certain, and solutions polished beyond a double's digits.

Every number is a ball, a midpoint with a radius that holds the true value (Arb). A residual whose ball lies
below a limit is below it, whatever has been rounded on the way.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from flint import acb, arb, arb_mat, ctx

from mechwright.motion import Array
from mechwright.planar import Plane
from mechwright_four_bar.dimensions import FourBar

BITS = 160
"""Working precision: some 48 digits, of which a position a hair from a toggle takes a third."""


def pole_ball(lengths: Sequence[arb], theta: arb, phi: arb, branch: int) -> acb:
    """Acceleration pole of the coupler from balls for crank, coupler, follower, ground, mm, and angles, rad."""
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
    alpha = -(r * p.conjugate()).real / (c * sine)
    return crank * (1 + 1 / acb(-w * w, alpha))


def certain_residual(bar: FourBar, phi: Sequence[float], targets: Plane) -> float:
    """A distance, mm, that no pole of this very linkage exceeds from its target.

    The doubles of ``bar`` and ``phi`` (n,) are taken as exact; infinite where the loop does not certainly close.
    """
    old, ctx.prec = ctx.prec, BITS
    try:
        lengths = [arb(float(length)) for length in bar.lengths]
        theta = arb(float(bar.ground_angle))
        worst = 0.0
        for angle, target in zip(phi, targets, strict=True):
            error = pole_ball(lengths, theta, arb(float(angle)), bar.branch) - acb(target.real, target.imag)
            bound = error.abs_upper()
            if not bound.is_finite():
                return float("inf")
            worst = max(worst, float(bound) * (1 + 4 * np.finfo(float).eps))
        return worst
    finally:
        ctx.prec = old
