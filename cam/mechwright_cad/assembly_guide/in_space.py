"""What the viewer of the assembly page holds: bodies in space, their shifts, and what their parts are."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mechwright.contracts.part import Part
from mechwright.pipeline import Build
from mechwright.pipeline.file_names import files_of
from mechwright_cad.animation.figures import DRAWN, rounded
from mechwright_cad.animation.scene import scene
from mechwright_cad.assembly_guide.exploded import Shifts
from mechwright_cad.assembly_order.plan import Plan
from mechwright_cad.bodies import bodies_of
from mechwright_cad.viewer.groups import FASTENERS

SAMPLES = 181
"""Positions of the input: every second degree of a turn, and straight on between two of them."""

GRAM = 2
"""Decimals of a mass, g."""


def assembly_scene(build: Build, plan: Plan, shifts: Shifts, masses: Mapping[str, float]) -> dict[str, Any]:
    """The mechanism in space, as :func:`~mechwright_cad.animation.scene.scene` gives it.

    Each body has its shift in the exploded view and the number of its part. ``at`` is the share of the motion
    at which the mechanism is put together. ``masses`` are those of one of each part, g.
    """
    parts = build.parts
    motion = build.design.solve(SAMPLES if build.design.family.moves else 2)
    found = scene(parts, motion, solids=True, space=True, plan=False)
    number = {part.name: place for place, part in enumerate(parts)}
    bodies = bodies_of(parts, motion)
    for mesh, body, k in zip(found["meshes"], bodies, range(len(bodies)), strict=not found.get("large")):
        mesh["part"] = number[body.part.name]
        mesh["shift"] = rounded(shifts[k], DRAWN)
        mesh.pop("off", None)  # screws belong to what is put together
    wanted = float(plan.motion.channels[motion.input_name].values[plan.sample])
    nearest = int(np.abs(motion.channels[motion.input_name].values - wanted).argmin())
    kept = {motion.input_name, motion.over}
    return found | {
        "channels": {name: channel for name, channel in found["channels"].items() if name in kept},
        "parts": parts_of(parts, masses, names_of(build)),
        "at": round(nearest / (motion.samples - 1), 6),
        "fasteners": FASTENERS,
    }


def parts_of(
    parts: Sequence[Part], masses: Mapping[str, float], files: Mapping[str, Sequence[str]]
) -> list[dict[str, Any]]:
    """Of each part its name, what it is made of or ordered as, its mass, g, and its files."""
    return [
        {
            "name": part.name,
            "what": part.bought.designation if part.bought else part.material,
            **({"mass": round(masses[part.name], GRAM)} if part.name in masses else {}),
            "files": list(files.get(part.name, ())),
        }
        for part in parts
    ]


def names_of(build: Build) -> dict[str, list[str]]:
    """Part to the names of its files: solid, drawing, program, setup sheet."""
    names = sorted((part.name for part in build.parts), key=len, reverse=True)
    found: dict[str, list[str]] = {}
    for file in dict.fromkeys(one.name for one in files_of(build, build.wanted)):
        owner = next((name for name in names if file.startswith((f"{name}.", f"{name}-"))), None)
        if owner is not None:
            found.setdefault(owner, []).append(file)
    return found
