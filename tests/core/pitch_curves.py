"""Pitch curves in polar form, and pairs of them, for tests: circles, and lobed ellipses with their mates."""

import math
from functools import cached_property

import numpy as np

from mechwright.mechanics.gearing import Frame, Pair, PitchCurve

SAMPLES = 512
"""Of ds/dt: its Fourier series has converged long before."""


class Lobed(PitchCurve):
    """r = p / (1 - e cos n t) about the axis, t the polar angle; n = 1 is an ellipse about a focus."""

    def __init__(self, p, e=0.0, n=1):
        self.p, self.e, self.n = p, e, n

    def radii(self, t):
        """r, dr/dt, d²r/dt²."""
        cos, sin = self.e * np.cos(self.n * t), self.e * np.sin(self.n * t)
        r = self.p / (1 - cos)
        r1 = -(r**2) * self.n * sin / self.p
        return r, r1, 2 * r1**2 / r - r**2 * self.n**2 * cos / self.p

    @cached_property
    def terms(self):
        t = math.tau * np.arange(SAMPLES) / SAMPLES
        terms = np.fft.rfft(self.arc_rate(t)).real / SAMPLES
        return terms[0], 2 * terms[1:]

    @property
    def perimeter(self):
        return math.tau * self.terms[0]

    def arc(self, t):
        mean, terms = self.terms
        t, k = np.asarray(t, dtype=float), np.flatnonzero(np.abs(terms) > 1e-17 * mean) + 1
        return mean * t + (terms[k - 1] / k * np.sin(np.multiply.outer(t, k))).sum(axis=-1)

    def arc_rate(self, t):
        r, r1, _ = self.radii(t)
        return np.hypot(r, r1)

    def frame(self, t, arc=None):
        r, r1, r2 = self.radii(t)
        along = np.stack((np.cos(t), np.sin(t)), axis=-1)
        across = np.stack((-along[..., 1], along[..., 0]), axis=-1)
        rate = np.hypot(r, r1)
        tangent = (r1[..., None] * along + r[..., None] * across) / rate[..., None]
        normal = np.stack((tangent[..., 1], -tangent[..., 0]), axis=-1)
        radius = rate**3 / (r**2 + 2 * r1**2 - r * r2)
        return Frame(self.arc(t) if arc is None else arc, r[..., None] * along, tangent, normal, radius)


class LobedPair(Pair):
    """tan(n2 ψ/2) = g tan(n1 φ/2), g = sqrt((a - p + a e)/(a - p - a e))."""

    def law(self, theta):
        a, p, e = self.distance, self.driver.p, self.driver.e
        g = math.sqrt((a - p + a * e) / (a - p - a * e))
        x = self.driver.n * theta / 2
        cos, sin = np.cos(x), np.sin(x)
        ahead = np.arctan2((g - 1) * sin * cos, cos**2 + g * sin**2)
        r1 = self.driver.radii(-theta)[0]
        return -2 / self.driven.n * (x + ahead), -r1 / (a - r1)


def lobed_pair(p, e, n1, n2):
    """A lobed ellipse and its mate, which is one too, with more or fewer lobes; a follows from the closure."""
    k = n2 / n1
    a = p * (1 + math.sqrt(1 - (1 - e * e) * (1 - k * k))) / (1 - e * e)
    rest = a - p + p * k * k
    # The longest radius of the driver meets the shortest of its mate, in the direction of O1.
    return LobedPair(
        Lobed(p, e, n1), Lobed(a * p * k * k / rest, -a * e / rest * math.cos(n2 * math.pi), n2), a
    )
