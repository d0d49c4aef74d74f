"""Spherical linkages: poses of a five-bar, both fits on the sphere, and a build.

    python benchmarks/bench_spherical.py

Anchor of the kinematics is plain vectorised numpy for positions only, as the textbook writes the closed form.
"""

import math
import time

import numpy as np
from harness import race, report, require

from mechwright.mechanics.planar import Turning
from mechwright_spherical.defaults import published_example
from mechwright_spherical.kinematics.five_bar import projected
from mechwright_spherical.kinematics.four_bar import FourBar
from mechwright_spherical.kinematics.projection import project
from mechwright_spherical.synthesis.refine import Freedom, Path, refine

POSES = 100_000
PER_POSE = 1e-6
"""s: the limit for position, velocity and acceleration together."""

PER_START = 2.0
"""s: the limit for one fit."""

STARTS = 12

ANGLES, ANGLES_N = np.radians(published_example.ANGLES), np.radians(published_example.ANGLES_N)
MECHANISM = projected(
    published_example.PINS, published_example.TABLE_2[0], published_example.LENGTH, published_example.RATIO
)
PATH = Path(ANGLES, ANGLES_N, project(published_example.TABLE_2, published_example.LENGTH).T)
THETA = np.linspace(-0.5, 0.0, POSES)


def textbook() -> np.ndarray:
    """Path points (n, 3) by Rodrigues and the combination of A, B and A x B, with numpy's own functions."""
    m = MECHANISM

    def turned(axis, angle, v):
        c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
        return v * c + np.cross(axis, v) * s + axis * (axis @ v) * (1 - c)

    def basis(a, c):
        n = np.cross(a, c)
        n /= np.linalg.norm(n, axis=-1, keepdims=True)
        return np.stack([a, np.cross(n, a), n], axis=-1)

    a, b = turned(m.a0, THETA, m.a1), turned(m.b0, m.ratio * THETA, m.b1)
    ca, cb, k = m.a1 @ m.c1, m.b1 @ m.c1, np.einsum("ij,ij->i", a, b)
    normal = np.cross(a, b)
    q = np.einsum("ij,ij->i", normal, normal)
    x, y = (ca - k * cb) / q, (cb - k * ca) / q
    side = np.sign(m.c1 @ np.cross(m.a1, m.b1))
    c = x[:, None] * a + y[:, None] * b + (side * np.sqrt((1 - x * ca - y * cb) / q))[:, None] * normal
    at_rest = basis(m.a1[None], m.c1[None])[0]
    return basis(a, c) @ (at_rest.T @ m.p1)


def processor_time(work, rounds: int = 15) -> float:
    """Least processor time of a work, s: the machine's other load counts as little as it can."""
    times = []
    for _ in range(rounds):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times)


def main() -> bool:
    loop = MECHANISM.phase(1)
    turning = Turning.of(THETA, 1.0)
    four_bar = FourBar(*np.radians((80, 30, 70, 60)), 1.0, math.radians(35), math.radians(15)).loop()
    timings = race(
        {
            "textbook, position": textbook,
            "ours, position": lambda: loop.at(turning, 0).p,
            "ours, to acceleration": lambda: loop.at(turning, 2).p,
            "ours, to jerk": lambda: loop.at(turning, 3).p,
            "ours, four-bar to jerk": lambda: four_bar.at(turning, 3).p,
        },
        rounds=7,
    )
    ratios = report(f"{POSES:,} poses of the five-bar", timings, "textbook, position")
    np.testing.assert_allclose(
        timings["textbook, position"].result, timings["ours, position"].result[0].T, atol=1e-12
    )
    seconds = processor_time(lambda: loop.at(turning, 2)) / POSES
    kept = require("microseconds per pose to the acceleration", 1e6 * seconds, 1e6 * PER_POSE)
    kept &= require("position against the textbook", ratios["ours, position"], 1.5)

    def fitted(freedom):
        return lambda: refine(MECHANISM, PATH, freedom, starts=STARTS, seed=1)

    fits = race(
        {"six unknowns": fitted(Freedom.SIX), "twelve unknowns": fitted(Freedom.TWELVE)}, rounds=1, warm=0
    )
    report(
        f"fits on the sphere, {STARTS} starts",
        fits,
        "six unknowns",
        lambda found: f"best {min(f.rms for f in found):.3g}",
    )
    for name, timing in fits.items():
        kept &= require(f"seconds per start, {name}", timing.seconds / STARTS, PER_START)
    return kept


if __name__ == "__main__":
    raise SystemExit(0 if main() else 1)
