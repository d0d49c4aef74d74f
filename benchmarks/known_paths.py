"""Paths of random slider-cranks, spherical four-bars and five-bars, with the limits that these just keep."""

import math
from collections.abc import Callable

import numpy as np
from scipy.spatial.transform import Rotation

from mechwright.mechanics.tracing.search import ROUND, search
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank
from mechwright_slider_crank.synthesis.paths.room import Limits, SliderRoom
from mechwright_spherical.kinematics.mobility import mobility
from mechwright_spherical.requirements import FourBarPathRequirement
from mechwright_spherical.synthesis.five_bar_limits import ARCS, FiveBarRoom
from mechwright_spherical.synthesis.four_bar_limits import Bounds, FourBarRoom

ROOM = 1.01
"""By how much limits are wider than what the linkage needs."""

LEAST = math.radians(20)
"""Least transmission angle of the spherical linkages."""

SPHERICAL_ROUND = FourBarPathRequirement().atlas
"""Random linkages of a room that a requirement looks at in a round."""

Problem = tuple[Callable[[int], float], str, int]
"""What gives the mean distance over the path's size after a search of so many starts; kind; points."""


def passed(rng: np.random.Generator) -> tuple[np.ndarray, bool, bool]:
    """Crank angles of 6 to 40 points, rad; whether they are timed, and whether the path is closed."""
    n, timed, closed = int(rng.integers(6, 41)), bool(rng.random() < 0.3), bool(rng.random() < 0.5)
    way = int(rng.choice((-1, 1)))
    span = math.tau * (1 - 1 / n) if closed else math.radians(rng.uniform(90, 320))
    steps = rng.uniform(0.5, 1.5, n - 1)
    phi = rng.uniform(0, math.tau) + way * span * np.concatenate(([0], np.cumsum(steps) / steps.sum()))
    return phi, timed, closed and not timed


def kind_of(timed: bool, closed: bool) -> str:
    """As it is told."""
    return f"{'timed' if timed else 'free'}, {'closed' if closed else 'open'}"


def slider_crank(rng: np.random.Generator) -> Problem:
    """A path of a slider-crank's coupler point."""
    rod = float(np.exp(rng.uniform(math.log(60), math.log(200))))
    most = math.cos(math.radians(rng.uniform(20, 50))) * rod
    crank = most * float(rng.uniform(0.12, 0.8))
    offset = (most - crank) * float(rng.uniform(-1, 1))
    branch = int(rng.choice((-1, 1)))
    link = SliderCrank(crank, rod, offset, float(rng.uniform(0, math.tau)), branch)
    pivot = complex(*rng.uniform(-50, 50, 2))
    point = complex(rod * rng.uniform(-0.3, 1.3), rod * rng.uniform(-0.8, 0.8))
    phi, timed, closed = passed(rng)
    points = pivot + link.bodies(phi).rod.point(point).position
    centre = complex(points.mean())
    size = float(np.abs(points - centre).max())
    longest = max(rod, abs(point), abs(point - rod)) * ROOM
    angle = math.acos((crank + abs(offset)) / rod) / ROOM
    turns = phi - phi[0] if timed else None
    senses = (1, -1) if turns is None else (1 if turns[-1] > 0 else -1,)
    limits = Limits(crank / ROOM, longest, angle)
    rooms = [
        SliderRoom((points - centre) / size, turns, one, sense, closed, 0.0, centre, size, limits)
        for one in (1, -1)
        for sense in senses
    ]
    return _nearest(rooms, ROUND), kind_of(timed, closed), phi.size


def spherical(rng: np.random.Generator) -> Problem:
    """A path of a spherical four-bar."""
    while True:
        arcs = rng.uniform(math.radians(20), math.radians(100), 4)
        phi, timed, closed = passed(rng)
        side, way = int(rng.choice((-1, 1))), 1 if phi[-1] > phi[0] else -1
        turn = Rotation.random(rng=rng).as_quat()
        x = np.concatenate([arcs, [rng.uniform(-1, 2), rng.uniform(-0.8, 0.8)], turn])
        if not mobility(*arcs).input_full:
            continue
        empty = FourBarRoom(np.zeros((phi.size, 3)), None, side, way, closed, 1.0, Bounds(0, math.pi, 0))
        over = empty.exceeded(empty.made(x), phi)
        angle = math.acos(min(1.0, float(over[8:].max()) + 1))
        if angle >= LEAST:
            break
    points = empty.missed(empty.made(x), phi)
    size = float(np.linalg.norm(points - points.mean(axis=0), axis=1).max())
    turns = phi - phi[0] if timed else None
    bounds = Bounds(float(arcs.min()) / ROOM, float(arcs.max()) * ROOM, angle / ROOM)
    rooms = [
        FourBarRoom(points, turns, one, sense, closed, size, bounds)
        for one in (1, -1)
        for sense in ((1, -1) if turns is None else (way,))
    ]
    return _nearest(rooms, SPHERICAL_ROUND), kind_of(timed, closed), phi.size


def five_bar(rng: np.random.Generator) -> Problem:
    """A path of a spherical five-bar, its arm geared to the crank."""
    while True:
        phi, timed, closed = passed(rng)
        ratio = float(rng.choice((-2, -1, 1, 2) if closed else (-2, -1, -0.5, 0.5, 1, 2)))
        side, way = int(rng.choice((-1, 1))), 1 if phi[-1] > phi[0] else -1
        empty = FiveBarRoom(
            np.zeros((phi.size, 3)), None, ratio, side, way, closed, 1.0, Bounds(0, math.pi, 0)
        )
        arcs = rng.uniform(math.radians(20), math.radians(100), ARCS)
        rest = [rng.uniform(0, math.tau), rng.uniform(-1, 2), rng.uniform(-0.8, 0.8)]
        x = np.concatenate([arcs, rest, Rotation.random(rng=rng).as_quat()])
        cosine = float(empty.cosines(empty.made(x), phi).max())
        if cosine < math.cos(LEAST):
            break
    points = empty.missed(empty.made(x), phi)
    size = float(np.linalg.norm(points - points.mean(axis=0), axis=1).max())
    turns = phi - phi[0] if timed else None
    bounds = Bounds(float(arcs.min()) / ROOM, float(arcs.max()) * ROOM, math.acos(cosine) / ROOM)
    rooms = [
        FiveBarRoom(points, turns, ratio, one, sense, closed, size, bounds)
        for one in (1, -1)
        for sense in ((1, -1) if turns is None else (way,))
    ]
    return _nearest(rooms, SPHERICAL_ROUND), kind_of(timed, closed), phi.size


def quiet(part: float) -> None:
    """Progress that nobody is told of."""


def _nearest(rooms: list, starts: int) -> Callable[[int], float]:
    def run(rounds: int) -> float:
        found = search(rooms, starts, rounds, 1, 0, 0.0, quiet)
        return found.kept[0].mean if found.kept else math.inf

    return run
