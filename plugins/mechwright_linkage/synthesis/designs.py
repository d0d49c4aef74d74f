"""Designs of what a search has found, and what is said of a requirement."""

import math
from collections.abc import Callable

import numpy as np
from pydantic import ValidationError

from mechwright import Finding, Progress, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.contracts.synthesis import Candidate, Rejected
from mechwright.mechanics.linkage.kinematics.figures import least_transmission
from mechwright.mechanics.planar.machine import Prismatic, Revolute
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.requirements import (
    DwellRequirement,
    FunctionRequirement,
    LinkageSearch,
    PathRequirement,
)
from mechwright_linkage.rules.rule_table import RULES
from mechwright_linkage.synthesis.search import Found, search
from mechwright_linkage.synthesis.tasks import Dwell, Function, Leading
from mechwright_linkage.table import LinkageTable

Designed = tuple[LinkageParams, Scalar]
"""A design, and by how much it misses the requirement."""

SHARE = 0.9
"""Of the work that is the search."""


def answering(wanted: FunctionRequirement, progress: Progress) -> Synthesis[LinkageParams]:
    """Linkages whose output answers angles of the input."""

    def design(found: Found) -> Designed:
        task = found.task
        assert isinstance(task, Function)  # noqa: S101 - as the search was asked for
        off = float(np.abs(task.errors(found.x[None])).max())
        unit = "mm" if task.unit == 1.0 else "rad"
        return _of_catalogue(found), Scalar(off, unit)

    met = wanted.tolerance / (2 * max(float(np.ptp(wanted.outputs)), 1e-9))
    found = search(wanted, lambda unknowns: Function(unknowns, wanted), met, _part(progress))
    return _synthesis(found, design, wanted, "function", progress)


def dwelling(wanted: DwellRequirement, progress: Progress) -> Synthesis[LinkageParams]:
    """Linkages whose output stands still for a part of the turn."""

    def design(found: Found) -> Designed:
        task = found.task
        assert isinstance(task, Dwell)  # noqa: S101 - as the search was asked for
        output, stroke = task.dwelling(found.x[None])
        return _of_catalogue(found), Scalar(float(np.ptp(output) / stroke[0, 0]), "")

    met = wanted.tolerance * 3
    found = search(wanted, lambda unknowns: Dwell(unknowns, wanted), met, _part(progress))
    return _synthesis(found, design, wanted, "dwell", progress)


def leading(wanted: PathRequirement, progress: Progress) -> Synthesis[LinkageParams]:
    """Linkages a point of which goes through points, as drawn linkages where they have to stand."""

    def design(found: Found) -> Designed | None:
        task = found.task
        assert isinstance(task, Leading)  # noqa: S101 - as the search was asked for
        if not task.in_order(found.x):
            return None
        _, _, off = task.fitted(found.x[None])
        return _drawn(task, found), Scalar(float(np.sqrt(np.mean(np.abs(off) ** 2))), "mm")

    found = search(
        wanted, lambda unknowns: Leading(unknowns, wanted), wanted.tolerance / 100, _part(progress)
    )
    return _synthesis(found, design, wanted, "path", progress)


def _part(progress: Progress) -> Progress:
    return lambda done, what: progress(SHARE * done, what)


def _of_catalogue(found: Found) -> LinkageParams:
    unknowns = found.task.unknowns
    entry = unknowns.plain(found.task.split(found.x[None])[0][0])
    name = next(name for name, kind in LinkageParams.model_fields.items() if kind.annotation is type(entry))
    return LinkageParams.model_validate({"linkage": name.replace("_", "-"), name: entry})


def _drawn(task: Leading, found: Found) -> LinkageParams:
    """The linkage in its first position, shifted, turned and scaled to where the path is."""
    dimensions = task.split(found.x[None])[0]
    shift, turn, _ = task.fitted(found.x[None])
    linkage, motion = task.unknowns.moved(dimensions, task.inputs(found.x[None])[:, :1])
    points: dict[str, dict[str, float]] = {}
    links: dict[str, list[str]] = {}
    named = {point for link, point in linkage.traces.values()}
    named |= {joint.name.partition("-")[0] for joint in linkage.machine.joints if isinstance(joint, Revolute)}
    for link, own in linkage.points.items():
        for name, place in own.items():
            if name not in named:
                continue
            at = motion.bodies[link].point(place).position
            moved = complex(np.ravel(shift + turn * at)[0])
            points[name] = {"x": round(moved.real, 6), "y": round(moved.imag, 6)}
            links.setdefault(link, []).append(name)
    slides = [
        {
            "block": joint.block,
            "guide": joint.guide,
            "point": next(name for name in links[joint.block]),
            "angle": round(math.degrees(_direction(joint, motion) + float(np.angle(turn[0, 0]))) % 360, 9),
        }
        for joint in linkage.machine.joints
        if isinstance(joint, Prismatic)
    ]
    return LinkageParams.model_validate(
        {
            "linkage": "drawn",
            "points": points,
            "links": {link: tuple(own) for link, own in links.items()},
            "slides": tuple(slides),
            "driver": linkage.machine.drives[0].link,
            "output": linkage.output,
        }
    )


def _direction(joint: Prismatic, motion: object) -> float:
    body = motion.bodies[joint.guide]  # type: ignore[attr-defined]
    return float(np.ravel(body.turning.theta + np.asarray(joint.line_angle))[0])


def _synthesis(
    found: list[Found],
    design: Callable[[Found], Designed | None],
    wanted: LinkageSearch,
    kind: str,
    progress: Progress,
) -> Synthesis[LinkageParams]:
    """Designs of what was found, each looked at by the family's rules."""
    rejected = Rejected()
    candidates: list[Candidate[LinkageParams]] = []
    for number, one in enumerate(found):
        if len(candidates) == wanted.designs:
            rejected.beyond(wanted.designs, len(found) - number)
            break
        progress(SHARE + (1 - SHARE) * number / len(found), "designs")
        try:
            made = design(one)
        except ValidationError as error:
            rejected.because("linkage.bounds", error.errors(include_url=False)[0]["msg"])
            continue
        if made is None:
            rejected.because(f"{kind}.order", "the input does not go one way through the points")
            continue
        params, residual = made
        table = LinkageTable(params)
        if rejected.by(errors(RULES.findings(table, quick=True))):
            continue
        least = Scalar(float(least_transmission(table)), "rad")
        candidates.append(Candidate(params, residual, {"least_transmission_angle": least}))
    return Synthesis(tuple(candidates), _said(kind, candidates, wanted), rejected.reasons)


def _said(
    kind: str, candidates: list[Candidate[LinkageParams]], wanted: LinkageSearch
) -> tuple[Finding, ...]:
    tolerance = float(getattr(wanted, "tolerance", 0.0))
    if not candidates:
        return (
            Finding.error(
                f"{kind}.none",
                "linkages",
                f"no linkage was found among {wanted.starts} random ones of each kind that keeps all limits",
                remedy="allow a smaller least_transmission_angle, other lengths, more starts or linkages",
            ),
        )
    best = candidates[0].shown["residual"]
    if best.value <= tolerance:
        return ()
    return (
        Finding.warning(
            f"{kind}.missed",
            "tolerance",
            f"the best linkage misses the requirement by {best}; {tolerance:g} is allowed",
            best.value,
            tolerance,
            best.unit,
            "allow a larger tolerance, more starts, or other linkages",
        ),
    )
