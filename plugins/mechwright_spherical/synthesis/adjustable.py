"""An adjustable spherical five-bar from poses in the plane, the whole way of the source and further.

Planar dyads give the pins, the projection brings them onto the sphere, and least squares on the sphere take
out the error that the projection leaves.
"""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import (
    Array,
    Candidate,
    Finding,
    GeometryError,
    KinematicsError,
    MechwrightError,
    Progress,
    Rejected,
    Scalar,
    Severity,
    Synthesis,
)
from mechwright.contracts.finding import errors
from mechwright_spherical.defaults.complete_parameters import CompleteParams
from mechwright_spherical.kinematics.five_bar import AdjustableFiveBar, projected
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.projection import project, unproject
from mechwright_spherical.parameters import FiveBarTable, SphericalParams
from mechwright_spherical.requirements import AdjustablePathRequirement
from mechwright_spherical.rules.assembly import least_transmission
from mechwright_spherical.rules.rule_table import findings_of
from mechwright_spherical.synthesis import structural
from mechwright_spherical.synthesis.planar import CouplerPoses, PlanarSynthesis, points, synthesise
from mechwright_spherical.synthesis.refine import Fit, Freedom, Path, refine
from mechwright_spherical.synthesis.refine import errors as path_errors

DIGITS = 12
"""Decimals of pins in design files: 1e-12 of the radius."""


def from_poses(wanted: AdjustablePathRequirement, progress: Progress) -> Synthesis[SphericalParams]:
    """Designs that follow the path in both phases, best first."""
    progress(0.0, "planar dyads")
    try:
        poses = _poses(wanted)
        planar = _planar(wanted, poses)
        targets = np.concatenate([poses.path, poses.path_n])
        flat = np.stack([targets.real, targets.imag], axis=-1)
        design = structural.PlanarDesign(planar.pins, wanted.ratio, planar.angles, planar.angles_n, flat)
        length, centre = _projection(wanted, design)
        mechanism = projected(planar.pins, flat[0], length, wanted.ratio, centre=centre)
        path = Path(planar.angles, planar.angles_n, project(flat, length, centre=centre).T)
        if not np.isfinite(path_errors(mechanism, path)).all():
            raise KinematicsError(
                f"the mechanism projected with a length of {length:g} cannot be assembled in all positions"
            )
    except GeometryError as error:
        return Synthesis((), (_fault("spherical.horizon", "five_bar.path", error),))
    except KinematicsError as error:
        return Synthesis((), (_fault("spherical.synthesis", "five_bar.projection_length", error),))
    notes = [_conditioning(planar)]
    candidates: list[Candidate[SphericalParams]] = []
    refused: list[Finding] = []
    rejected = Rejected()
    for fit in _fits(wanted, mechanism, path, progress):
        params = _design(wanted, fit.mechanism, planar, flat, length, centre)
        found = errors(findings_of(params))
        if rejected.by(found):
            refused += found
        elif params not in [candidate.params for candidate in candidates]:
            candidates.append(_candidate(wanted, params, fit, length))
    progress(1.0, "done")
    if not candidates:
        return Synthesis((), (*notes, *dict.fromkeys(refused)), rejected.reasons)
    ranked = sorted(candidates, key=lambda one: one.residual.value)
    return Synthesis(tuple(ranked), tuple(notes), rejected.reasons)


def _fault(code: str, parameter: str, error: MechwrightError) -> Finding:
    said, _, remedy = str(error).partition("; ")
    return Finding.error(
        code,
        parameter,
        said,
        remedy=remedy or "start from a longer projection, or from other guesses",
    )


def _poses(wanted: AdjustablePathRequirement) -> CouplerPoses:
    """Poses in the plane; points that are given on the sphere are projected back first."""

    def flat(pins: tuple[tuple[float, ...], ...]) -> Array:
        return np.array(
            [pin if len(pin) == 2 else unproject(pin, wanted.projection_length) for pin in pins], dtype=float
        )

    return CouplerPoses(
        points(flat(wanted.path)),
        np.radians(wanted.turns),
        points(flat(wanted.path_n)),
        np.radians(wanted.turns_n),
    )


def _planar(wanted: AdjustablePathRequirement, poses: CouplerPoses) -> PlanarSynthesis:
    return synthesise(
        poses,
        a0x=wanted.crank_axis_x,
        crank_length=wanted.crank_length,
        b0=complex(*wanted.arm_axis),
        arm_length=wanted.arm_length,
        arm_angle=math.radians(wanted.arm_angle),
        ratio=wanted.ratio,
        crank_guess=wanted.crank_guess,
        rocker_guess=wanted.rocker_guess,
        equations=wanted.equations,
    )


def _projection(
    wanted: AdjustablePathRequirement, design: structural.PlanarDesign
) -> tuple[float, tuple[float, float]]:
    """Length and centre, rounded as a design file holds them."""
    best = wanted.projection_centre == "best"
    length = wanted.projection_length
    if wanted.projection_tolerance is not None:
        length = structural.smallest_length(design, wanted.projection_tolerance, best=best)
    length = round(length, DIGITS)
    if not best:
        return length, (0.0, 0.0)
    x, y = structural.best_centre(design, length)[0].round(DIGITS).tolist()
    return length, (x, y)


def _conditioning(planar: PlanarSynthesis) -> Finding:
    worst = max(planar.crank.condition, planar.rocker.condition)
    return Finding(
        "spherical.conditioning",
        Severity.NOTE,
        "five_bar",
        f"the dyads' equations have the condition numbers {planar.crank.condition:.0f} (crank) and "
        f"{planar.rocker.condition:.0f} (rocker): errors of the poses may grow by that; lengths close to "
        f"{max(planar.crank.residual, planar.rocker.residual):.2g}",
        worst,
    )


def _fits(
    wanted: AdjustablePathRequirement, start: AdjustableFiveBar, path: Path, progress: Progress
) -> Iterator[Fit]:
    """The projected mechanism, then the best fit of each freedom that is asked for."""
    yield Fit(start, path_errors(start, path))
    most = 0 if wanted.unknowns == "none" else Freedom[wanted.unknowns.upper()].value
    freedoms = [freedom for freedom in Freedom if freedom.value <= most]
    for number, freedom in enumerate(freedoms):
        progress((number + 1) / (len(freedoms) + 2), f"{freedom.value} unknowns")
        fits = refine(
            start,
            path,
            freedom,
            starts=wanted.starts,
            seed=wanted.seed,
            least_transmission=math.radians(wanted.least_transmission),
        )
        yield min(fits, key=lambda fit: fit.rms)


def _design(
    wanted: AdjustablePathRequirement,
    mechanism: AdjustableFiveBar,
    planar: PlanarSynthesis,
    flat: Array,
    length: float,
    centre: tuple[float, float],
) -> SphericalParams:
    names = ("a0", "a1", "a1n", "b0", "b1", "c1", "c1n")
    count = planar.angles.size
    degrees, degrees_n = (np.degrees(x).round(DIGITS - 2).tolist() for x in (planar.angles, planar.angles_n))
    table = FiveBarTable(
        **{name: tuple(getattr(mechanism, name).round(DIGITS).tolist()) for name in names},
        point=tuple(flat[0].tolist()),
        projection_length=length,
        projection_centre=centre,
        ratio=wanted.ratio,
        travel=_farthest(degrees),
        travel_n=_farthest(degrees_n),
        path=tuple(map(tuple, flat[:count].tolist())),
        path_angles=tuple(degrees),
        path_n=tuple(map(tuple, flat[count:].tolist())),
        path_angles_n=tuple(degrees_n),
    )
    return CompleteParams(
        kind="five-bar",
        radius=wanted.radius,
        speed=wanted.speed,
        least_transmission=wanted.least_transmission,
        five_bar=table,
    )


def _farthest(degrees: list[float]) -> float:
    return max(degrees, key=abs)


def _candidate(
    wanted: AdjustablePathRequirement, params: SphericalParams, fit: Fit, length: float
) -> Candidate[SphericalParams]:
    linkage = linkage_of(params)
    mu = [least_transmission(phase) for phase in linkage.phases]
    misses = np.concatenate([phase.path_errors for phase in linkage.phases])
    (r1, r1n), (r3, r3n) = fit.mechanism.crank_arcs, fit.mechanism.rocker_arcs
    return Candidate(
        params,
        Scalar(float(wanted.radius * np.sqrt(np.mean(misses**2))), "mm"),
        {
            "path_error_max": Scalar(float(wanted.radius * misses.max()), "mm"),
            "transmission_min": Scalar(min(mu), "rad"),
            "R1_gap": Scalar(abs(float(r1 - r1n)), "rad"),
            "R3_gap": Scalar(abs(float(r3 - r3n)), "rad"),
            "projection_length": Scalar(length, ""),
        },
    )
