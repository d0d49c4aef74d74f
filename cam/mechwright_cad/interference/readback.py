"""Parts made of what a STEP file holds, so that a check starts at the file and not at what wrote it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import cadquery as cq
import numpy as np
import shapely

from mechwright.contracts.part import Part
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline
from mechwright_cad.exporters.step_read import plan_of, read_step_solids


def parts_from_step(parts: Sequence[Part], files: Mapping[str, Path]) -> list[Part]:
    """The same parts, each with the shape that its file holds.

    Parameters
    ----------
    parts
        Of a mechanism.
    files
        Part name to its STEP file.

    Returns
    -------
    parts
        A plate without recesses has its plan view from the file, all other parts the solid.

    Raises
    ------
    OutputError
        A file cannot be read as STEP.
    GeometryError
        A file holds another number of solids than one, or a plate of another thickness.
    """
    found = []
    for part in parts:
        solids = read_step_solids(files[part.name])
        if len(solids) != 1:
            raise GeometryError(f"{files[part.name]} holds {len(solids)} solids; a part is one")
        found.append(part_from_solid(part, solids[0]))
    return found


def part_from_solid(part: Part, solid: cq.Solid) -> Part:
    """The same part with the shape of a solid; raises GeometryError if a plate has another thickness."""
    if part.outline is None or any(f.top > 0 or f.depth < part.thickness for f in part.features):
        return replace(part, outline=None, thickness=0.0, machined=(), build=lambda: solid)
    box = solid.BoundingBox()
    if abs(box.zlen - part.thickness) > 1e-3 or abs(box.zmin) > 1e-3:
        raise GeometryError(
            f"part {part.name} is {part.thickness:g} mm thick and stands on Z0; its solid reaches from "
            f"{box.zmin:.4f} to {box.zmax:.4f}"
        )
    plan = plan_of(solid)
    outer, *inner = (
        Loop.polygon(map(tuple, np.asarray(shapely.get_coordinates(ring))[:-1].tolist()))
        for ring in (plan.exterior, *plan.interiors)
    )
    return replace(part, outline=Outline(outer, tuple(inner)), machined=())
