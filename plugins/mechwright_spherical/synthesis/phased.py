"""Adjustable spherical linkages from a path per phase: searched in the plane and projected, or on the sphere.

In the plane the search is that of planar linkages; its pins are projected, with the length and the centre
asked for, and a fit on the sphere takes out what the projection leaves. Its unknowns have one R1 and one R3,
which the projection splits. On the sphere the same search runs with arcs in place of lengths.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mechwright import Array, Candidate, Finding, KinematicsError, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.contracts.synthesis import ALIKE
from mechwright.mechanics.adjustable import (
    Fit,
    Limits,
    Path,
    Pins,
    PlaneSpace,
    Settings,
    Task,
    Unknowns,
    exact_number,
    fit,
    follow,
    search,
    settings_of,
)
from mechwright.mechanics.multistart import distinct
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.projection import project, unproject
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.requirements import AdjustablePathRequirement
from mechwright_spherical.rules.assembly import weakest
from mechwright_spherical.rules.rule_table import findings_of
from mechwright_spherical.synthesis import structural
from mechwright_spherical.synthesis.phased_designs import designs_of
from mechwright_spherical.synthesis.space import SphereSpace
from mechwright_spherical.synthesis.structural import PhasedDesign

INSIDE = 0.002
"""Share by which limits are tightened in the search, where they are held by penalties."""

MARGIN = math.radians(0.5)
"""The same of the transmission angle, which the search looks at in a few places."""

EXACT, FINE = 1e-20, 721
"""Sum of squares, in sizes of the path, that counts as met; crank angles at which a machine is judged."""

REFINED = 12
"""Planar machines that are projected and fitted on the sphere, at most."""

STEPS = 60
"""Of that fit, for each weight of the limits."""


@dataclass(frozen=True)
class Wanted:
    """The paths on the unit sphere, (3, n) per phase, and the projection that goes with them."""

    sphere: tuple[Array, ...]
    length: float
    centre: tuple[float, float]


def from_phases(wanted: AdjustablePathRequirement, progress: Progress) -> Synthesis[SphericalParams]:
    """Machines that follow all paths, each as the designs that show its phases; the best first."""
    try:
        goal, found, notes = (_by_plane if wanted.on_plane else _by_sphere)(wanted, progress)
    except KinematicsError as error:
        said, _, remedy = str(error).partition("; ")
        fault = Finding.error("spherical.synthesis", "phases", said, remedy=remedy or "ask for other points")
        return Synthesis((), (_count(wanted), fault))
    task = _task(wanted, goal)
    rejected, refused = Rejected(), []
    candidates: list[Candidate[SphericalParams]] = []
    machines = 0
    good = []
    for k in _ranked(task, found):
        broken = _broken(task, wanted, found.x[k], found.theta[k])
        if broken is None:
            good.append(k)
        else:
            rejected.because(*broken)
    for looked, k in enumerate(good, start=1):
        pins = task.unknowns.pins(found.x[k])
        theta = [
            np.concatenate([[0.0], found.theta[k][task.phase == n]]) for n in range(task.unknowns.phases)
        ]
        designs = designs_of(wanted, pins, theta, goal.sphere)
        faults = [one for _, params in designs for one in errors(findings_of(params))]
        if rejected.by(faults):
            refused += faults
            continue
        misses = np.linalg.norm(task.misses(found.x[k], found.theta[k]), axis=-1) * task.size
        rms = float(wanted.radius * np.sqrt((misses**2).sum() / sum(one.shape[1] for one in goal.sphere)))
        settings = settings_of(task.unknowns.space, pins)
        candidates += [
            _candidate(
                params, number, rms, goal.length, settings.crank[number - 1], settings.follower[number - 1]
            )
            for number, params in designs
        ]
        if machines == 0 and wanted.moves == "moving":
            notes += _settings(wanted, settings)
        machines += 1
        if machines == wanted.designs:
            rejected.beyond(wanted.designs, len(good) - looked)
            break
    progress(1.0, "done")
    if not candidates:
        reason = next(iter(rejected.reasons), None)
        fault = Finding.error(
            "spherical.synthesis",
            "phases",
            "within the limits no machine was found that can be built"
            + (f": {reason.message}" if reason is not None else ""),
            remedy="ask for a smaller least_transmission or least_arc, a larger greatest_arc or radius, or "
            "more starts",
        )
        return Synthesis((), (*notes, fault), rejected.reasons)
    return Synthesis(tuple(candidates), tuple(notes), rejected.reasons)


def _unknowns(wanted: AdjustablePathRequirement, space: "SphereSpace | PlaneSpace") -> Unknowns:
    bars = 5 if wanted.linkage == "five-bar" else 4
    return Unknowns(space, bars, wanted.moves, len(wanted.phases), wanted.ratio if bars == 5 else 0.0)


def _limits(wanted: AdjustablePathRequirement, scale: float) -> Limits:
    """Limits with arcs times ``scale``."""
    return Limits(
        math.radians(wanted.least_transmission) + MARGIN,
        math.radians(wanted.least_arc) * (1 + INSIDE) * scale,
        math.radians(wanted.greatest_arc) * (1 - INSIDE) * scale,
        wanted.full_turn,
    )


def _task(wanted: AdjustablePathRequirement, goal: Wanted) -> Task:
    space = SphereSpace(goal.sphere[0][:, 0])
    whole = np.concatenate(goal.sphere, axis=1)
    size = float(np.linalg.norm(whole - whole.mean(axis=1, keepdims=True), axis=0).max())
    return Path(goal.sphere, size).task(_unknowns(wanted, space), _limits(wanted, 1.0))


def _by_sphere(wanted: AdjustablePathRequirement, progress: Progress) -> tuple[Wanted, Fit, list[Finding]]:
    """Search with arcs on the sphere."""
    length = wanted.projection_length
    sphere = tuple(
        np.array(
            [project(pin, length) if len(pin) == 2 else np.array(pin) / np.linalg.norm(pin) for pin in one]
        ).T
        for one in wanted.phases
    )
    goal = Wanted(sphere, length, (0.0, 0.0))
    task = _task(wanted, goal)
    found = search(
        Path(sphere, task.size), task.unknowns, task.limits, wanted.tried, wanted.seed,
        lambda part: progress(0.9 * part, "linkages on the sphere"),
    )  # fmt: skip
    return goal, found, [_count(wanted)]


def _by_plane(wanted: AdjustablePathRequirement, progress: Progress) -> tuple[Wanted, Fit, list[Finding]]:
    """Search in the plane, project with length and centre, fit on the sphere."""
    length = wanted.projection_length
    flat = [
        np.array([pin if len(pin) == 2 else unproject(pin, length) for pin in one], dtype=float)
        for one in wanted.phases
    ]
    points = [one[:, 0] + 1j * one[:, 1] for one in flat]
    whole = np.concatenate(points)
    size = float(np.abs(whole - whole.mean()).max())
    path = Path(tuple(one / size for one in points), 1.0)
    unknowns = _unknowns(wanted, PlaneSpace(complex(path.phases[0][0])))
    limits = _limits(wanted, length / size)
    found = search(
        path, unknowns, limits, wanted.tried, wanted.seed,
        lambda part: progress(0.6 * part, "linkages in the plane"),
    ).best(REFINED)  # fmt: skip
    task = path.task(unknowns, limits)
    planar = [_planar(task, points, size, found.x[k], found.theta[k]) for k in range(len(found.x))]
    length, centre = _projection(wanted, planar[0], length)
    if any(len(pin) == 3 for one in wanted.phases for pin in one):
        centre = (0.0, 0.0)  # directions that are given stay where they are
    sphere = tuple(project(one, length, centre=centre).T for one in flat)
    goal = Wanted(sphere, length, centre)
    ball = _task(wanted, goal)
    pins = [structural.projected_pins(one.pins, np.array([length]), np.array([centre])) for one in planar]
    x = np.stack([
        ball.unknowns.of_pins(Pins(*(getattr(one, name)[:, 0] for name in Pins.__slots__))) for one in pins
    ])  # fmt: skip
    progress(0.7, "fit on the sphere")
    fitted = fit(ball, x, found.theta, STEPS).best(REFINED)
    error = float(structural.errors(planar[0], length, centre).max()) * wanted.radius
    note = Finding.note(
        "spherical.projection",
        f"projected with a length of {length:.6g} about ({centre[0]:.6g}, {centre[1]:.6g}) the best planar "
        f"machine would miss its points by up to {error:.4g} mm, each phase with arcs of its own; the "
        "designs are fitted on the sphere, with one R1 and one R3",
        error,
        "mm",
    )
    return goal, fitted, [_count(wanted), note]


def _planar(
    task: Task,
    points: list[np.ndarray],
    size: float,
    x: Array,
    theta: Array,
) -> PhasedDesign:
    """A planar machine with its points, in the plane's unit."""
    pins = task.unknowns.pins(x)
    phases = range(task.unknowns.phases)
    return PhasedDesign(
        Pins(*(getattr(pins, name) * size for name in Pins.__slots__)),
        task.unknowns.ratio,
        np.concatenate([np.full(len(points[k]), k) for k in phases]),
        np.concatenate([np.concatenate([[0.0], theta[task.phase == k]]) for k in phases]),
        np.concatenate(points),
    )


def _projection(
    wanted: AdjustablePathRequirement, design: PhasedDesign, length: float
) -> tuple[float, tuple[float, float]]:
    best = wanted.projection_centre == "best"
    if wanted.projection_tolerance is not None:
        length = structural.smallest_length(design, wanted.projection_tolerance, best=best)
    if not best:
        return length, (0.0, 0.0)
    x, y = structural.best_centre(design, length)[0].tolist()
    return length, (x, y)


def _ranked(task: Task, found: Fit) -> Iterator[int]:
    """Machines that differ: the nearest first, of exact ones that with the best transmission angle."""
    unlike = [int(k) for k in distinct(np.column_stack([found.x, found.theta]), ALIKE)]
    near = np.where(found.squares < EXACT, 0.0, found.squares)
    yield from sorted(unlike, key=lambda k: (near[k], -_weakest(task, found.x[k], found.theta[k])))


def _weakest(task: Task, x: Array, theta: Array) -> float:
    """Least transmission angle over all phases, rad, where the search does not look alone."""
    unknowns, pins = task.unknowns, task.unknowns.pins(x)
    ends = task.sweep(theta)[:, [0, -1]]
    angles = np.linspace(ends[:, 0], ends[:, 1], FINE, axis=-1)
    number = np.repeat(np.arange(unknowns.phases), FINE)
    _, cosine = follow(unknowns.space, pins.of(number), unknowns.ratio, angles.reshape(-1))
    return math.acos(min(1.0, float(np.abs(cosine).max())))


def _broken(task: Task, wanted: AdjustablePathRequirement, x: Array, theta: Array) -> tuple[str, str] | None:
    """The first limit that a machine breaks, and what it breaks it with."""
    excess = float(task.excess(x, theta).max())
    if not math.isfinite(excess) or not np.isfinite(task.misses(x, theta)).all():
        return "spherical.assembly", "it cannot be assembled in all positions"
    if excess > INSIDE * math.radians(wanted.least_arc):
        return "spherical.limits", f"limits of the arcs are passed by {excess:.2g}"
    angle = math.degrees(_weakest(task, x, theta))
    if angle < wanted.least_transmission:
        return "spherical.limits", f"the transmission angle falls to {angle:.3g} degrees"
    for k in range(task.unknowns.phases):
        own = np.concatenate([[0.0], theta[task.phase == k]])
        steps = np.diff(own) * (1 if own[-1] >= 0 else -1)
        if (steps <= 0).any() or abs(own[-1]) >= math.tau:
            return "spherical.order", f"phase {k + 1} does not pass its points in their order within one turn"
    return None


def _candidate(
    params: SphericalParams, number: int, rms: float, length: float, crank: float, follower: float
) -> Candidate[SphericalParams]:
    linkage = linkage_of(params)
    shown = linkage.shown
    misses = params.radius * shown.path_errors
    sine = min(weakest(phase)[1] for phase in linkage.phases)
    figures = {
        "phase": Scalar(float(number), ""),
        "phase_error": Scalar(float(np.sqrt(np.mean(misses**2))), "mm"),
        "path_error_max": Scalar(float(misses.max()), "mm"),
        "transmission_min": Scalar(math.asin(min(1.0, max(0.0, sine))), "rad"),
        "crank_turned": Scalar(float(crank), "rad"),
        "follower_turned": Scalar(float(follower), "rad"),
        "projection_length": Scalar(length, ""),
    }
    for k, (miss, angle) in enumerate(zip(misses, shown.target_angles, strict=True), start=1):
        figures[f"error_{k}"] = Scalar(float(miss), "mm")
        figures[f"crank_angle_{k}"] = Scalar(float(angle), "rad")
    return Candidate(params, Scalar(rms, "mm"), figures)


def _settings(wanted: AdjustablePathRequirement, settings: Settings) -> list[Finding]:
    """How the best machine is set from phase 1 to each other phase, in order."""
    apart = "with the gears open, " if wanted.linkage == "five-bar" else ""
    rows = np.degrees([settings.crank, settings.follower]).T[1:].tolist()
    return [
        Finding.note(
            "spherical.setting",
            f"best machine, phase {number}: at the first point hold the coupler; free the crank's pin, "
            f"{apart}turn the crank by {crank:+.6g} degrees and fasten it; free the rocker's pin, "
            f"turn the rocker by {follower:+.6g} degrees and fasten it; let the coupler go",
            crank,
            "deg",
        )
        for number, (crank, follower) in enumerate(rows, start=2)
    ]


def _count(wanted: AdjustablePathRequirement) -> Finding:
    """How the number of points compares with what can be met exactly."""
    given = sum(len(points) for points in wanted.phases)
    bars = 5 if wanted.linkage == "five-bar" else 4
    most = exact_number(bars, wanted.moves, len(wanted.phases), bars == 5 and wanted.moves != "moving")
    said = f"{given} points in {len(wanted.phases)} phases, and {most} can be met exactly with these pins set"
    if most > given:
        said += f": there is a family of linkages with {most - given} free parameters"
    elif most < given:
        said += f": {given - most} too many, so they are met as nearly as can be"
    return Finding.note("spherical.count", said, float(given), "")
