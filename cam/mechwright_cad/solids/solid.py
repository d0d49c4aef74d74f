"""Solids: a plate is its outline, extruded, less its recesses; an assembly is its parts in their poses.

Every segment becomes exactly one edge and one wall: lines and arcs as they are, B-splines pole by pole.
Neighbouring edges share their vertex, openings are inner wires, and nothing is cut, fused or cleaned up, but
for recesses: those are cut by the kernel, and held against the part's sections afterwards.
This module imports the CAD kernel (1.6 s).
"""

import math
from collections.abc import Sequence

import cadquery as cq
import numpy as np
from OCP.gp import gp_Trsf

from mechwright.contracts.by_form import kept_by_form
from mechwright.contracts.details import Chamfer, Engraving, Thread
from mechwright.contracts.motion import Motion, Poses
from mechwright.contracts.part import Part
from mechwright.contracts.sections import blind
from mechwright.errors import GeometryError
from mechwright.geometry import Outline
from mechwright_cad.bodies import assembly_name, bodies_of
from mechwright_cad.solids.detailed import detailed
from mechwright_cad.solids.recess_tools import cut_out, taken
from mechwright_cad.solids.solid_check import check_plate, check_recessed, check_solid
from mechwright_cad.solids.wires import extruded


def plate(outline: Outline, thickness: float) -> cq.Solid:
    """The outline extruded from z = 0 up to ``thickness``, mm; raises GeometryError as ``check_plate`` does.

    >>> from mechwright.geometry import Loop, Outline
    >>> square = Outline(Loop.polygon([(0, 0), (4, 0), (4, 4), (0, 4)]))
    >>> round(plate(square, 2.0).Volume(), 9)
    32.0
    """
    if not (thickness > 0 and math.isfinite(thickness)):
        raise GeometryError(f"a plate needs a thickness above 0 mm, not {thickness}")
    solid = extruded(outline, thickness)
    check_plate(solid, outline, thickness)
    return solid


@kept_by_form(128)
def part_solid(part: Part) -> cq.Solid:
    """The checked solid of a part, recesses cut, made once per process; a GeometryError names the part."""
    try:
        if part.outline is not None:
            if any(isinstance(detail, Chamfer) for detail in part.details):
                made = detailed(part)
            else:
                made = plate(part.outline, part.thickness)
                if not blind(part):
                    return made
                made = cut_out(made, [taken(feature, part) for feature in blind(part)])
            check_recessed(made, part)
            return made
        assert part.build is not None  # noqa: S101 - Part has either an outline or this
        solid = part.build()
        check_solid(solid)
        return solid
    except GeometryError as error:
        raise GeometryError(f"part {part.name}: {error}") from error


def part_shape(part: Part) -> cq.Shape:
    """The solid of a part, and for each thread and engraving curves on the top face.

    CAD systems show threads so, by a circle of the nominal diameter; the hole itself has that of the core.
    """
    curves = [curve for _, curve in marks(part)]
    return cq.Compound.makeCompound([part_solid(part), *curves]) if curves else part_solid(part)


def marks(part: Part) -> list[tuple[str, cq.Shape]]:
    """The curves on the top face, one for each thread and each stroke, with their names in STEP files."""
    found: list[tuple[str, cq.Shape]] = []
    z = part.thickness
    for detail in part.details:
        match detail:
            case Thread():
                circle = cq.Edge.makeCircle(detail.diameter / 2, cq.Vector(*detail.centre, z))
                found.append((f"{detail.name}: {detail.designation}", circle))
            case Engraving():
                name = f"{detail.name}: engraved {detail.depth:g} mm deep"
                for stroke in detail.strokes:
                    line = cq.Wire.makePolygon([cq.Vector(*point, z) for point in stroke])
                    found.append((name, line))
    return found


def assembly(name: str, parts: Sequence[Part], motion: Motion, sample: int = 0) -> cq.Assembly:
    """All instances of the parts in their poses at one sample of the motion, see :func:`bodies_of`.

    The whole has its name by :func:`assembly_name`. Raises GeometryError as :func:`bodies_of` does.
    """
    bodies = bodies_of(parts, motion, sample)
    whole = cq.Assembly(name=assembly_name(name, bodies))
    # One shape for all copies of a part: two compounds of a plate and its marks would be two products.
    shapes = {part.name: part_shape(part) for part in parts}
    for body in bodies:
        place = _location(body.poses, sample, body.instance.z)
        colour = cq.Color(*body.part.colour_of(body.instance))
        whole.add(shapes[body.part.name], name=body.name, loc=place, color=colour)
    return whole


def _location(pose: Poses, sample: int, z: float) -> cq.Location:
    turn = pose.rotation[sample]
    shift = pose.position[sample] + turn @ (0.0, 0.0, z)
    rows = np.column_stack((turn, shift)).tolist()
    placed = gp_Trsf()
    placed.SetValues(*rows[0], *rows[1], *rows[2])
    return cq.Location(placed)
