"""What recesses take of a plate, as solids. Imports the CAD kernel."""

from collections.abc import Sequence

import cadquery as cq
import numpy as np
import shapely
from OCP.Standard import Standard_Failure
from OCP.StdFail import StdFail_NotDone

from mechwright.contracts.part import Bore, Feature, Part, Pocket, Profile
from mechwright.contracts.sections import walls
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline, circle
from mechwright.tolerances import TOLERANCES
from mechwright_cad.solids.wires import extruded

ON_RIM = TOLERANCES.outline
"""An edge this near to a wall is at its foot, mm."""
PLACES = 64
"""Places of an edge that are looked at."""
AROUND = 4.0
"""What stands outside of a step is cut by a disc so many times as large as the step."""
BEYOND = 1.0
"""A cut from the top face starts this far above it, mm: the kernel is spared a common face."""


NOT_QUITE = (1e-6, 1e-5)
"""A fillet is made smaller by such a share: the kernel does not make two that just meet in the middle."""


def round_floored(solid: cq.Solid, feature: Feature, part: Part) -> cq.Solid:
    """What a recess takes, with fillets along those bottom edges at which a wall of the part stands."""
    if not (isinstance(feature, Pocket) and feature.floor_radius > 0):
        return solid
    at = walls(part, feature)
    edges = [edge for edge in solid.faces("<Z").Edges() if shapely.dwithin(at, _chords(edge), ON_RIM)]
    if not edges:
        return solid
    for share in NOT_QUITE:
        try:
            made = solid.fillet(feature.floor_radius * (1 - share), edges)
            break
        except (Standard_Failure, StdFail_NotDone, ValueError):
            continue
    else:
        raise GeometryError(
            f"the CAD kernel cannot make the fillet of {feature.floor_radius:g} mm on the floor of "
            f"{feature.name}; give the corners of the recess larger radii than that"
        )
    one: cq.Solid = made.Solids()[0]
    return one


def _chords(edge: cq.Edge) -> "shapely.MultiPoint":
    """Points along an edge, plan view."""
    places = [edge.positionAt(share).toTuple()[:2] for share in np.linspace(0, 1, PLACES + 2)[1:-1]]
    return shapely.MultiPoint(places)


def edges_of(feature: Feature) -> list[tuple[Loop, str]]:
    """The loops around what a recess takes, that on their left, and on which side of them it lies."""
    match feature:
        case Bore():
            return [(Loop((circle(feature.centre, feature.diameter / 2),)), "inside")]
        case Profile():
            loop = _forwards(feature.loop)
            if feature.side == "inside":
                return [(loop, "inside")]
            x0, y0, x1, y1 = loop.bounds
            disc = circle(((x0 + x1) / 2, (y0 + y1) / 2), AROUND * (x1 - x0 + y1 - y0))
            return [(Loop((disc,)), ""), (loop.reversed(), "outside")]
        case Pocket():
            islands = [(_forwards(island).reversed(), "outside") for island in feature.islands]
            return [(_forwards(feature.boundary), "inside"), *islands]


def taken(feature: Feature, part: Part) -> cq.Shape:
    """The solid that a recess takes out of the plate."""
    above = BEYOND if feature.top <= 0 else 0.0
    loops = [loop for loop, _ in edges_of(feature)]
    solid = extruded(Outline(loops[0], tuple(loops[1:])), feature.depth + above)
    return round_floored(solid, feature, part).translate(
        cq.Vector(0, 0, part.thickness - feature.top - feature.depth)
    )


def cut_out(whole: cq.Solid, tools: Sequence[cq.Shape]) -> cq.Solid:
    """A plate less what its recesses take; raises GeometryError if the kernel cannot, or nothing holds it."""
    try:
        pieces = whole.cut(*tools).clean().Solids()
    except Standard_Failure as error:
        raise GeometryError(f"the CAD kernel cannot cut the recesses into the plate ({error})") from error
    if len(pieces) != 1:
        raise GeometryError(f"the recesses cut the plate into {len(pieces)} pieces; make them shallower")
    return pieces[0]


def _forwards(loop: Loop) -> Loop:
    return loop if loop.area > 0 else loop.reversed()
