"""Curves that are known by their formulae, met by linkages: ``python benchmarks/bench_curves.py [NAMES]``.

Straight lines have the deviation of a named linkage of the same stroke beside them, computed here from its
proportions: the greatest distance of the path from its middle line, over the stroke. The other curves are
defined here, for the points of those in the literature could not be verified: an arc that is passed evenly, a
lip of two arcs, a wing's tip (a figure of eight), the sun over a year at the same hour, which is a figure of
eight as well, Viviani's curve, and the sun over a day at a latitude, a circle about the pole that every crank
draws: there the mechanism has to keep its frame's limits alone.
"""

import argparse
import math
import sys
import time
from collections.abc import Callable

import numpy as np
from harness import require

from mechwright.contracts.finding import errors
from mechwright.plugins.host import host
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close

SECONDS = 60.0
"""Of processor time that a search may take."""

STROKE = 80.0
"""Of the lines, mm."""

OBLIQUITY = math.radians(23.44)
"""Of the ecliptic."""

MISSED, FAR = 0.05, {"viviani": 0.3}
"""What a linkage may miss of a curve that it cannot draw, as part of the curve's size; of Viviani's window,
which reaches over half the sphere, no four-bar with good transmission draws both loops."""

Rows = list[list[float]]


NAMED = {
    "Hoecken": (FourBar(1, 2.5, 2.5, 2), 5 + 0j, (90.0, 270.0)),
    "Chebyshev": (FourBar(5, 2, 5, 4, branch=-1), 1 + 0j, (math.degrees(math.atan2(3, 4)), 90.0)),
    "Roberts": (FourBar(1.2, 1, 1.2, 2), 0.5 - 1j * math.sqrt(1.2**2 - 0.25), (33.56, 82.81)),
    "Watt": (FourBar(1, 0.5, 1, math.hypot(2, 0.5), -math.atan2(0.5, 2), -1), 0.25 + 0j, (-18.0, 18.0)),
}
"""Straight-line linkages, their coupler points and the angles of the first link, degrees, between which the
path is nearly straight: half a turn, between the outer of Chebyshev's and Roberts's exact places, 0.6 arm."""


def named(name: str, count: int = 181) -> np.ndarray:
    """The nearly straight part of the path of such a linkage."""
    bar, point, (first, last) = NAMED[name]
    loop = close(bar, np.radians(np.linspace(first, last, count)))
    return np.asarray(loop.joint_a + point * loop.coupler.direction)


def sizes(name: str) -> dict[str, object]:
    """The shortest and the longest link of such a linkage with a line of 80 mm, and 20 degrees."""
    bar, point, _ = NAMED[name]
    scale = STROKE / straightness(named(name))[0]
    longest = max(*bar.lengths, abs(point), abs(point - bar.coupler))
    return {
        "least_transmission_angle": 20.0,
        "longest_link": math.ceil(longest * scale),
        "shortest_link": math.floor(min(bar.lengths) * scale),
    }


def straightness(path: np.ndarray) -> tuple[float, float, float]:
    """Length, and greatest and mean distance from a line over it, of a path of complex numbers."""
    centred = np.stack((path.real, path.imag)) - np.array([[path.real.mean()], [path.imag.mean()]])
    axis = np.linalg.svd(centred)[0][:, 0]
    along, across = axis @ centred, np.array([-axis[1], axis[0]]) @ centred
    length = float(np.ptp(along))
    return length, float(np.ptp(across) / 2 / length), float(np.sqrt(np.mean(across**2)) / length)


def line(stroke: float = STROKE, count: int = 21) -> Rows:
    """Even points of a line."""
    return [[x, 0.0] for x in np.linspace(-stroke / 2, stroke / 2, count).tolist()]


def arc() -> Rows:
    """A dwell's arc: 60 degrees about a point where a further link would be at rest, radius 60 mm."""
    return [[60 * math.cos(t), 60 * math.sin(t)] for t in np.radians(np.linspace(60, 120, 13)).tolist()]


def lip() -> Rows:
    """Two arcs of 100 degrees over a chord of 80 mm: 24 points, corners included."""
    half = math.radians(50)
    radius = 40 / math.sin(half)
    upper = [
        [radius * math.sin(t), radius * (math.cos(t) - math.cos(half))]
        for t in np.linspace(-half, half, 13).tolist()
    ]
    return [*upper, *[[x, -y] for x, y in upper[-2:0:-1]]]


def on_sphere(azimuth: np.ndarray, elevation: np.ndarray) -> Rows:
    """Directions about z, tilted so that azimuth and elevation 0 are on z."""
    x, y = np.cos(elevation) * np.sin(azimuth), np.sin(elevation)
    return np.stack([x, y, np.cos(elevation) * np.cos(azimuth)], axis=-1).tolist()


def wing() -> Rows:
    """A wing's tip: strokes of 50 degrees to either side, 10 degrees of deviation at twice the rate."""
    t = math.tau * np.arange(24) / 24
    return on_sphere(np.radians(50) * np.cos(t), np.radians(10) * np.sin(2 * t))


def analemma() -> Rows:
    """The mean sun's error over a year on a circular orbit: right ascension less longitude, declination."""
    longitude = math.tau * (np.arange(24) + 0.5) / 24
    ascension = np.unwrap(np.arctan2(np.cos(OBLIQUITY) * np.sin(longitude), np.cos(longitude)))
    return on_sphere(np.arcsin(np.sin(OBLIQUITY) * np.sin(longitude)), ascension - longitude)


def viviani() -> Rows:
    """The window of Viviani, where a cylinder of half its radius meets the sphere: a figure of eight."""
    t = math.tau * (np.arange(24) + 0.5) / 24
    return np.stack([np.sin(t), np.sin(t) * np.cos(t), np.cos(t) ** 2], axis=-1)[:, [1, 0, 2]].tolist()


def day() -> Rows:
    """The sun from rise to set at 48 degrees of latitude, declination 23.44 degrees, by the hour angle."""
    latitude = math.radians(48)
    most = math.acos(-math.tan(latitude) * math.tan(OBLIQUITY))
    hour = np.linspace(-most, most, 17)
    east = -np.cos(OBLIQUITY) * np.sin(hour)
    north = np.sin(OBLIQUITY) * np.cos(latitude) - np.cos(OBLIQUITY) * np.sin(latitude) * np.cos(hour)
    up = np.sin(OBLIQUITY) * np.sin(latitude) + np.cos(OBLIQUITY) * np.cos(latitude) * np.cos(hour)
    return np.stack([east, north, up], axis=-1).tolist()


EIGHTEEN = (
    (50, 110), (40, 110), (30, 110), (20, 100), (10, 90), (5, 75), (2, 60), (0, 50), (0, 40),
    (3, 30), (10, 25), (15, 20), (20, 30), (30, 40), (40, 50), (50, 70), (60, 90), (60, 100),
)  # fmt: skip
"""Of a closed path in public benchmark code of path synthesis, times 100; the crank turns evenly there."""


def eighteen() -> Rows:
    """As they stand."""
    return [[float(x), float(y)] for x, y in EIGHTEEN]


LIMITS = {"least_transmission_angle": 30.0, "longest_link": 250.0, "shortest_link": 12.0}
HOECKEN = {"least_transmission_angle": 23.0, "longest_link": 100.0, "shortest_link": 20.0}
"""Limits that Hoecken's linkage of the same stroke of 80 mm just keeps."""

SPHERE = {"least_transmission": 30.0}
EVENLY = [10.0 * k for k in range(13)]
BY_TWENTY = [20.0 * k for k in range(18)]

WANTED: dict[str, tuple[str, str, Callable[[], Rows], dict[str, object]]] = {
    "line": ("four-bar", "path", line, LIMITS),
    "line, Hoecken's sizes": ("four-bar", "path", line, HOECKEN),
    "line, Roberts's sizes": ("four-bar", "path", line, sizes("Roberts")),
    "line, Watt's sizes": ("four-bar", "path", line, sizes("Watt")),
    "arc, timed": ("four-bar", "path", arc, {**LIMITS, "crank_turns": EVENLY}),
    "eighteen points": ("four-bar", "path", eighteen, {**LIMITS, "closed": True}),
    "eighteen points, timed": ("four-bar", "path", eighteen, {**LIMITS, "crank_turns": BY_TWENTY}),
    "lip": ("four-bar", "path", lip, {**LIMITS, "closed": True}),
    "lip, slider-crank": ("slider-crank", "path", lip, {**LIMITS, "closed": True}),
    "wing": ("spherical", "four-bar-path", wing, SPHERE),
    "wing, five-bar": ("spherical", "five-bar-path", wing, {**SPHERE, "ratio": 2.0}),
    "analemma": ("spherical", "four-bar-path", analemma, SPHERE),
    "viviani": ("spherical", "four-bar-path", viviani, SPHERE),
    "sun, a day": ("spherical", "four-bar-path", day, {**SPHERE, "closed": False}),
}


def measured(name: str) -> bool:
    """Whether a curve is met as well as it has to be, in time, by designs without an error."""
    family_name, kind, points, more = WANTED[name]
    family = host().family(family_name)
    rows = points()
    wanted = family.requirements[kind].model_validate({"points": rows, **more})
    start = time.process_time()
    found = family.synthesise(kind, wanted, lambda done, what: None)  # noqa: ARG005
    spent = time.process_time() - start
    places = np.array(rows) * (wanted.radius if family_name == "spherical" else 1.0)  # type: ignore[attr-defined]
    size = float(np.linalg.norm(places - places.mean(axis=0), axis=1).max())
    if not found.candidates:
        print(f"{name}: none, {spent:.1f} s: {found.findings[0].message}", flush=True)
        return False
    bad = sum(bool(errors(family.check(one.params))) for one in found.candidates)
    best = min(found.candidates, key=lambda one: one.residual.value)
    angle = next(value for key, value in best.figures.items() if key.startswith("least_transmission"))
    print(
        f"{name}: {best.residual.value:.3g} mm in the mean, {best.residual.value / size:.2g} of its size, "
        f"{math.degrees(angle.value):.1f} degrees, {len(found.candidates)} designs, {spent:.1f} s",
        flush=True,
    )
    _, _, better = name.partition(", ")
    of_named = better.removesuffix("'s sizes")
    beaten = of_named not in NAMED or require(
        f"{name}: mean, of that of the linkage",
        best.residual.value / (straightness(named(of_named))[2] * STROKE),
        1.0,
    )
    return beaten and all(
        (
            require(f"{name}: missed, of its size", best.residual.value / size, FAR.get(name, MISSED)),
            require(f"{name}: designs with errors", bad, 0.0),
            require(f"{name}: seconds", spent, SECONDS),
        )
    )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", default=list(WANTED))
    for name in NAMED:
        _, most, mean = straightness(named(name))
        said = f"{most * STROKE:.3f} mm at most, {mean * STROKE:.3f} in the mean"
        print(f"{name}'s linkage over {STROKE:g} mm: {said}")
    kept = [measured(name) for name in parser.parse_args().names]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
