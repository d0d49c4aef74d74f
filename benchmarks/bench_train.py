"""The train against plain numpy, and its tables and synthesis: ``python benchmarks/bench_train.py``.

The anchor is what a careful engineer would write for the same channels and poses, formula by formula, without
figures, contracts or branches. Times in seconds hold for one idle core of the machine where it was measured.
"""

import importlib.util
import math
import sys
import time
from pathlib import Path

import numpy as np
from harness import race, report, require

from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.kinematics.figures import SOUGHT
from mechwright_elliptic_gears.requirements import REQUIREMENTS

SAMPLES = 100_000
SOLVE_LIMIT, TABLE_LIMIT, SYNTHESIS_LIMIT = 1.5, 0.2, 30.0
FAMILY = EllipticGears()
PARAMS = FAMILY.Params(stages=2, bore=12, speed=600 / math.tau, keyway_width=4, keyway_relief=2)
RATES = ("theta", "omega", "alpha", "jerk")
ANCHOR = "plain numpy, 100,000 samples"


def rotation(angle: np.ndarray) -> np.ndarray:
    c, s, zero, one = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    return np.stack(
        [np.stack([c, -s, zero], -1), np.stack([s, c, zero], -1), np.stack([zero, zero, one], -1)], -2
    )


def step(theta, omega, alpha, jerk, e):
    """Angle and rates of a driven gear, as the equations stand in the source."""
    turns = np.floor((theta + np.pi) / (2 * np.pi))
    x = theta - 2 * np.pi * turns
    angle = 2 * np.pi - 2 * np.arctan2((1 + e) * np.sin(x / 2), (1 - e) * np.cos(x / 2)) - 2 * np.pi * turns
    d = 1 + e**2 - 2 * e * np.cos(theta)
    f = -(1 - e**2) / d
    f1 = 2 * e * (1 - e**2) * np.sin(theta) / d**2
    f2 = 2 * e * (1 - e**2) * (np.cos(theta) / d**2 - 4 * e * np.sin(theta) ** 2 / d**3)
    return (
        angle,
        f * omega,
        f1 * omega**2 + f * alpha,
        f2 * omega**3 + 3 * f1 * omega * alpha + f * jerk,
    )


def plain() -> dict[str, np.ndarray]:
    """The channels and poses of the train, straight from the formulas."""
    a, e, gamma, omega = 50.0, 0.4, math.pi / 2, 10.0
    theta2 = np.linspace(0, 2 * np.pi, SAMPLES)
    zero = np.zeros_like(theta2)
    g2 = (theta2, zero + omega, zero, zero.copy())
    g3 = step(*g2, e)
    phi = 2 * np.pi - step(np.array(gamma), 0.0, 0.0, 0.0, e)[0]
    g4 = (g3[0] + phi, *g3[1:])
    g5 = step(*g4, e)
    g6 = tuple(one + other for one, other in zip(g4, g5, strict=True))
    found = {"time": theta2 / omega, "ratio": g5[1] / omega}
    for number, gear in enumerate((g2, g3, g4, g5, g6), start=2):
        found |= {
            f"{name}{number}": v for name, v in zip(("theta", "omega", "alpha", "jerk"), gear, strict=True)
        }
    q, v, acc, jerk = a + 0j, 0j, 0j, 0j
    for th, w, al, j in (g4, g5):
        p = a * e * np.exp(1j * th)
        q, v = q + p, v + 1j * w * p
        acc = acc + (1j * al - w**2) * p
        jerk = jerk + (1j * (j - w**3) - 3 * w * al) * p
    found |= {"Q.x": q.real, "Q.y": q.imag}
    for name, value in (("v", v), ("a", acc), ("j", jerk)):
        found |= {f"{name}.x": value.real, f"{name}.y": value.imag, f"{name}.abs": np.abs(value)}
    tilt = [np.arctan2(e * np.sin(g[0]), 1 - e * np.cos(g[0])) for g in (g2, g4)]
    found["pressure_angle"] = math.radians(20) + np.maximum(np.abs(tilt[0]), np.abs(tilt[1]))
    reach = 2 * a * e
    j, k = reach * np.exp(1j * g4[0]), 2 * a + reach * np.exp(1j * g5[0])
    places = (
        (zero, zero, zero), (zero - 2 * a, zero, g2[0]), (zero, zero, g3[0]), (zero, zero, g4[0]),
        (zero + 2 * a, zero, g5[0]), (j.real, j.imag, g6[0]), (j.real, j.imag, g4[0]),
        (k.real, k.imag, g5[0]), (zero - 2 * a, zero, zero), (zero + 2 * a, zero, zero),
    )  # fmt: skip
    for number, (x, y, angle) in enumerate(places):
        found |= {f"at{number}": np.stack([x, y, zero], -1), f"turn{number}": rotation(angle)}
    return found


def solve() -> object:
    for figures in SOUGHT:
        figures.cache_clear()
    return FAMILY.solve(PARAMS, SAMPLES)


def check_same() -> None:
    """Both contestants compute the same."""
    ours, theirs = FAMILY.solve(PARAMS, SAMPLES), plain()
    names = {name: name for name in theirs if name in ours.channels}
    names |= {"Q.x": "Q.x", "v.abs": "Q.speed", "a.abs": "Q.acceleration", "j.abs": "Q.jerk"}
    for name, channel in names.items():
        one, other = ours.channels[channel].values, theirs[name]
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-6, err_msg=name)
    assert len(ours.channels) == sum(1 for name in theirs if not name.startswith(("at", "turn")))
    assert len(ours.poses) == sum(1 for name in theirs if name.startswith("turn"))


def seed() -> object:
    path = Path(__file__).parents[1] / "docs" / "seeds" / "elliptic_gears.py"
    spec = importlib.util.spec_from_file_location("seed_elliptic_gears", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def main() -> int:
    check_same()
    tables = seed()
    tables.cells()
    start = time.process_time()
    tables.cells()
    table = time.process_time() - start
    timings = race(
        {
            ANCHOR: plain,
            "solve, 100,000 samples, with all figures": solve,
            "the 5 x 4 table: peaks and windows": tables.cells,
        },
        rounds=9,
    )
    ratios = report("Elliptic gear train", timings, ANCHOR)
    start = time.process_time()
    found = FAMILY.synthesise("longest-window", REQUIREMENTS["longest-window"](), lambda *_: None)
    spent = time.process_time() - start
    window = found.candidates[0].figures["window"].value
    print(f"  synthesis, {len(found.candidates)} designs, window {window:.3f} rad: {spent:.1f} s of one core")
    print("\nlimits")
    kept = [
        require("solve over plain numpy", ratios["solve, 100,000 samples, with all figures"], SOLVE_LIMIT),
        require("the table, s of one core", table, TABLE_LIMIT),
        require("synthesis, s of one core", spent, SYNTHESIS_LIMIT),
    ]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
