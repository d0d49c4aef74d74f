"""Faces that hang over nothing: bridges and overhangs of a part as it lies on the bed."""

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
import shapely

from mechwright.contracts.part import Part
from mechwright.contracts.sections import sections
from mechwright_print.printer.facts import STEEP

if TYPE_CHECKING:
    from mechwright_print.meshes.printed_mesh import PrintedMesh

SPECK = 0.5
"""A face that hangs over less than this area is none, mm²: a line or two hold it."""
CHORD = 0.02
"""Chord error of the sections, mm."""


@dataclass(frozen=True)
class Hanging:
    """A level face over nothing: its height above the bed and its narrow side, mm, and its area, mm²."""

    height: float
    span: float
    area: float


def hanging_faces(part: Part, *, on_top: bool) -> list[Hanging]:
    """The level faces of a plate that a printer has to bridge."""
    layers = list(sections(part, CHORD, 0))  # from the top face down
    if on_top:
        layers = layers[::-1]
    found = []
    for above, below in pairwise(layers):
        free = shapely.difference(above.shape, below.shape)
        for piece in shapely.get_parts(free).tolist():
            if piece.area < SPECK:
                continue
            level = above.top if on_top else part.thickness - above.bottom
            found.append(Hanging(float(level), _span(piece), float(piece.area)))
    return found


def _span(piece: "shapely.Polygon") -> float:
    """The narrow side of the least rectangle around a shape, mm."""
    corners = np.asarray(shapely.minimum_rotated_rectangle(piece).exterior.coords)
    sides = np.hypot(*(corners[1:3] - corners[:2]).T)
    return float(sides.min())


def overhanging_area(mesh: "PrintedMesh") -> float:
    """Area that leans out over the bed by more than 45 degrees and does not lie on it, mm²."""
    points = mesh.mesh.points
    a, b, c = points[mesh.mesh.triangles].transpose(1, 0, 2)
    cross = np.cross(b - a, c - a)
    area = np.linalg.norm(cross, axis=1) / 2
    down = -cross[:, 2] / np.maximum(2 * area, np.finfo(float).tiny)
    lowest = np.minimum(np.minimum(a[:, 2], b[:, 2]), c[:, 2])
    leaning = (down > np.cos(np.radians(90 - STEEP)) + 1e-6) & (lowest > 1e-3)
    return float(area[leaning].sum())
