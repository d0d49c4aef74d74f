"""Designs a second and core of each family that evaluates many at once, on the study of its example.

Where a family has masses by arrays, the same is measured with them besides.

    python benchmarks/bench_evaluate.py [DESIGNS]

The anchor of each is a plain numpy evaluation of its motion: the closed form of the output's angle and of one
figure more over 721 samples, for as many designs, in blocks that stay in the cache, without a check. Times
are the processor's, not the wall's, so that what else runs tells less; only the ratio to the anchor of the
same run means something on another machine.
"""

import sys
import time
import tomllib
from collections.abc import Callable
from pathlib import Path
from statistics import median

import numpy as np
from harness import require
from numpy.typing import NDArray

from mechwright.contracts.evaluation import Batch, Columns
from mechwright.contracts.family import Family
from mechwright.contracts.sampling import SAMPLES
from mechwright.plugins.host import host
from mechwright.studies.study import Study, study_of
from mechwright.studies.task import drawn

EXAMPLES = Path(__file__).parents[1] / "examples"

LEAST_RATE = 20_000
"""Designs a second and core."""

DESIGNS, BLOCK, ROUNDS = 100_000, 64, 3

Array = NDArray[np.float64]
Plain = Callable[[Array, Array], Array]
"""A figure (m, k) of designs, columns (m, 1) by a share of their range, at angles (k,)."""


def geneva(share: Array, theta: Array) -> Array:
    """Lever of the roller in a slot for the law 3-4-5."""
    half, wheel, u = 0.5 + 0.8 * share, np.pi / 6, theta / (2 * np.pi)
    crank = np.sin(wheel + 0.2) / np.sin(half)
    rate = wheel / half * 30 * u**2 * (1 - u) ** 2
    arm = crank * np.exp(1j * half * (1 - 2 * u))
    centre = np.cos(wheel + 0.2) + crank * np.cos(half) - arm
    velocity = 1j * (arm - rate * centre)
    return np.asarray((np.conj(centre) * 1j * velocity).imag / np.abs(velocity))


def four_bar(share: Array, theta: Array) -> Array:
    """Angle of the follower."""
    a, b, c, d = 0.2 + 0.2 * share, 1.0, 0.9, 1.1
    away = d - a * np.exp(1j * theta)
    square = np.abs(away) ** 2
    cosine = (square + c * c - b * b) / (2 * c * np.sqrt(square))
    return np.asarray(np.angle(away) - np.arccos(np.clip(cosine, -1, 1)))


def slider_crank(share: Array, theta: Array) -> Array:
    """Place of the slider."""
    crank = 0.2 + 0.5 * share
    return np.asarray(crank * np.cos(theta) + np.sqrt(1 - (crank * np.sin(theta)) ** 2))


def spherical(share: Array, theta: Array) -> Array:
    """Angle of the output of a spherical four-bar."""
    a, b, c, d = 0.3 + 0.3 * share, 1.2, 1.3, 1.4
    x = np.sin(a) * np.sin(theta) * np.sin(c)
    y = np.sin(c) * (np.cos(a) * np.sin(d) - np.sin(a) * np.cos(d) * np.cos(theta))
    z = np.cos(b) - np.cos(c) * (np.cos(a) * np.cos(d) + np.sin(a) * np.sin(d) * np.cos(theta))
    return np.asarray(np.arctan2(x, y) + np.arccos(np.clip(z / np.hypot(x, y), -1, 1)))


def elliptic_gears(share: Array, theta: Array) -> Array:
    """Speed of the middle of the coupler."""
    e = 0.1 + 0.6 * share
    ratio = (e * e - 1) / (1 + e * e - 2 * e * np.cos(theta))
    one = np.exp(1j * theta)
    two = np.conj((one - e) / (1 - e * one))
    return np.asarray(np.abs(e * (one + ratio * two)))


def five_bar(share: Array, theta: Array) -> Array:
    """Angle of the rocker of a geared five-bar."""
    a, b, c, l, f = 0.14 + 0.1 * share, 0.2, 0.9, 1.0, 1.05
    away = f + b * np.exp(0.5j * theta) - a * np.exp(1j * theta)
    square = np.abs(away) ** 2
    cosine = (square + l * l - c * c) / (2 * l * np.sqrt(square))
    return np.asarray(np.angle(away) - np.arccos(np.clip(cosine, -1, 1)))


def cam_follower(share: Array, theta: Array) -> Array:
    """Pressure angle of a slide with a roller that rises and falls by a cycloid."""
    start, offset = 0.4 + 0.6 * share, 0.1
    height = np.sqrt(start**2 - offset**2) + 0.2 * (theta - np.sin(theta)) / (2 * np.pi)
    velocity = 0.2 * (1 - np.cos(theta)) / (2 * np.pi)
    return np.asarray(np.arctan((velocity - offset) / height))


def noncircular_gears(share: Array, theta: Array) -> Array:
    """Ratio of a window with quintic blends."""
    ratio, width, blend = 0.6 + 0.3 * share, 2.0, 1.5
    x = np.clip((np.abs(theta - np.pi) - width / 2) / blend, 0, 1)
    beyond = (2 * np.pi - ratio * (width + blend)) / (2 * np.pi - width - blend)
    return np.asarray(ratio + (beyond - ratio) * x**3 * (10 - 15 * x + 6 * x * x))


def spur_gears(share: Array, theta: Array) -> Array:
    """Sliding speed of the teeth that are in contact, over the angle of the driver."""
    teeth, angle = 12 + 20 * share, 0.4
    pitch = 2 * np.pi / teeth
    along = (theta % pitch - pitch / 2) * teeth / 2 * np.cos(angle)
    return np.asarray(1.5 * np.abs(along))


PLAIN: dict[str, Plain] = {
    "geneva": geneva,
    "four-bar": four_bar,
    "slider-crank": slider_crank,
    "spherical": spherical,
    "elliptic-gears": elliptic_gears,
    "five-bar": five_bar,
    "cam-follower": cam_follower,
    "noncircular-gears": noncircular_gears,
    "spur-gears": spur_gears,
}


WEIGHED: dict[str, tuple[str, ...]] = {
    "geneva": ("mass",),
    "four-bar": ("mass.crank", "mass.coupler"),
    "slider-crank": ("mass", "mass_slider"),
    "elliptic-gears": ("mass",),
    "five-bar": ("mass", "mass_coupler"),
    "cam-follower": ("mass",),
}
"""Masses that families have by arrays."""


def plain(figure: Plain, size: int) -> Array:
    """Least and greatest value of a figure of so many designs."""
    theta, found = np.linspace(0, 2 * np.pi, SAMPLES), np.empty((size, 2))
    share = np.linspace(0, 1, size)[:, None]
    for start in range(0, size, BLOCK):
        values = figure(share[start : start + BLOCK], theta)
        found[start : start + BLOCK] = np.stack([values.min(axis=1), values.max(axis=1)], axis=1)
    return found


def timed(work: Callable[[], object]) -> float:
    """Seconds of the processor."""
    start = time.process_time()
    work()
    return time.process_time() - start


def measured(name: str, study: Study, size: int) -> bool:
    """Report a family; whether it is fast enough."""
    whole = drawn(study, 0)
    batch = Batch(whole.model, whole.content, {key: values[:size] for key, values in whole.varied.items()})
    size = len(batch)

    columns = (*study.measured, *WEIGHED.get(name, ()))

    def evaluate() -> Columns:
        return study.family.evaluate(batch, study.measured, study.stage)

    def weighed() -> Columns:
        return study.family.evaluate(batch, columns, study.stage)

    found = evaluate()
    weighed()
    times = [
        (timed(evaluate), timed(lambda: plain(PLAIN[name], size)), timed(weighed)) for _ in range(ROUNDS)
    ]
    own, anchor, heavy = (median(column) for column in zip(*times, strict=True))
    allowed = float((found.forbidden == 0).mean())
    print(f"\n{name}: {size:,} designs, {100 * allowed:.0f} % allowed, columns {', '.join(study.measured)}")
    print(f"  {size / own:9,.0f} designs a second and core, {own / anchor:5.2f} times a plain motion")
    if name in WEIGHED:
        print(f"  {size / heavy:9,.0f} with {', '.join(WEIGHED[name])} besides")
    return require(f"{LEAST_RATE:,} over the rate", LEAST_RATE * own / size, 1.0)


def main(size: int) -> int:
    """Measure all families that have a study and a way of their own."""
    kept = True
    for name in PLAIN:
        path = EXAMPLES / f"{name}-study.toml"
        if not path.is_file():
            continue
        study = study_of(tomllib.loads(path.read_text()), path, host())
        if type(study.family).evaluate is not Family.evaluate or study.family.rules().every:
            kept &= measured(name, study, size)
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else DESIGNS))
