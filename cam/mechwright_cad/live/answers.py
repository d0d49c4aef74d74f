"""What a page is given for a change of its design: first what is quick, then what takes longer."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mechwright.contracts.finding import Change, Finding, Stage, errors
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright.contracts.table import Table
from mechwright.contracts.target import Target
from mechwright.designs.design import Design, load
from mechwright.errors import MechwrightError
from mechwright.pipeline import Build
from mechwright.plugins.host import host
from mechwright.scripting.checking import checked
from mechwright_cad.animation.scene import PAGE_SAMPLES, scene
from mechwright_cad.live.places import drawn, still

Answer = dict[str, Any]

QUICK = 121
"""Samples of a motion that is shown while one drags: every third degree of a turn."""


def motion(design: Design) -> Answer:
    """The mechanism's own motion without parts, joints and links as points and lines; some milliseconds.

    What stands around it takes a check of the design, and a frame takes seconds: it comes with the parts.
    """
    found = scene((), design.family.solve(design.params, QUICK), solids=False)
    return {"scene": _with_targets(design, found)}


def targets(design: Design) -> Sequence[Target]:
    """The places of a design that a page lets one drag."""
    return design.family.design_targets(design.params)


def _with_targets(design: Design, found: Mapping[str, Any]) -> Answer:
    """A picture of a design that has room for its places, and these."""
    places = targets(design)
    return {**still(places, found), "targets": drawn(places)} if places else dict(found)


def mechanism(design: Design) -> Answer:
    """The mechanism's own parts in motion, before what tables put around it is made; empty without a table.

    A tenth of a second, where a frame takes ten times that. It is empty too where no plate moves, or the
    family's parts cannot be made: :func:`parts` tells what is wrong.
    """
    around = any(
        type(reader).surroundings is not Table.surroundings and reader.name in design.content
        for reader in design.readers
    )
    if not around or errors(design.family.check(design.params), Stage.PARTS):
        return {"scene": None}
    solved = design.family.solve(design.params, PAGE_SAMPLES)
    made = design.family.parts(design.params)
    if design.family.moves and not _seen(made, solved):
        return {"scene": None}
    return {"scene": _with_targets(design, scene(made, solved, solids=False, space=True))}


def parts(design: Design) -> Answer:
    """What the family finds, and the plates in motion where there are any; a fraction of a second."""
    found = list(design.check())
    answer: Answer = {"findings": findings_as_json(found), "scene": None}
    if not errors(found, Stage.MOTION):
        solved = design.solve(PAGE_SAMPLES)
        try:
            made = design.parts()
            # Solids take the CAD kernel: what has no plates that move is shown by its links.
            shown = not design.family.moves or _seen(made, solved)
            answer["scene"] = _with_targets(
                design, scene(made if shown else (), solved, solids=False, space=True)
            )
        except MechwrightError as error:
            answer["unmade"] = str(error)
            answer["scene"] = _with_targets(design, scene((), solved, solids=False))
        answer["figures"] = {
            name: {"value": one.value, "unit": one.unit} for name, one in solved.scalars.items()
        }
    return answer


def _seen(made: Sequence[Part], solved: Motion) -> bool:
    """Whether a plate moves."""
    plates = {one.body for part in made if part.outline is not None for one in part.instances}
    return any(
        np.ptp(poses.position, axis=0).any() or np.ptp(poses.rotation, axis=0).any()
        for name, poses in solved.poses.items()
        if name in plates
    )


def remedies(path: Path, change: Change) -> list[dict[str, Any]]:
    """What ``check`` finds, with remedies that were tried; it may take seconds, in a second process."""
    return findings_as_json(checked(Build(load(path, host()).changed(change), host())))


def findings_as_json(findings: Sequence[Finding]) -> list[dict[str, Any]]:
    """Findings as JSON holds them, the gravest first."""
    order = ["error", "warning", "note"]
    return [one.as_dict() for one in sorted(findings, key=lambda one: order.index(str(one.severity)))]
