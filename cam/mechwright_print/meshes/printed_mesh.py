"""The triangles that a printer gets: a compensated part on the bed, its first layer stepped back, scaled.

Imports the CAD kernel.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright_cad.exporters.mesh import part_mesh
from mechwright_cad.solids.tessellate import Mesh
from mechwright_print.compensation.plates import Compensated
from mechwright_print.meshes.stacked import stacked
from mechwright_print.printer.settings import Printer

SAME_NORMAL = 1e-3
"""Triangles lie in one face of the part if their normals differ by no more."""


@dataclass(frozen=True, eq=False)
class PrintedMesh:
    """A part as it stands on the bed.

    Parameters
    ----------
    mesh
        Lowest point at z = 0; x and y as in the part, seen from above the bed.
    to_bed
        (3, 3) turn from the part's coordinates to those of the bed.
    scale
        (3,) of the model by which the growth of lengths is taken off.
    foot
        By how much its first layer stands back on each side, mm.
    lift
        What was added to its heights, mm, so that it lies on the bed.
    """

    mesh: Mesh
    to_bed: Array
    scale: Array
    foot: float
    lift: float

    @property
    def size(self) -> tuple[float, float, float]:
        """Along X, Y and Z, mm."""
        x, y, z = np.ptp(self.mesh.points, axis=0).tolist()
        return x, y, z

    @property
    def in_part(self) -> Mesh:
        """The mesh in the part's coordinates, as large as it is on the bed after the print has grown."""
        points: Array = ((self.mesh.points - (0.0, 0.0, self.lift)) / self.scale) @ self.to_bed
        return Mesh(points, self.mesh.triangles)

    def moved(self, points: Array) -> Array:
        """Where points (n, 3) of the compensated model, part coordinates, lie on the mesh, in x and y."""
        turned: Array = (points @ self.to_bed.T) * self.scale
        return turned


def printed_mesh(made: Compensated, printer: Printer, *, on_top: bool, correct: bool) -> PrintedMesh:
    """The mesh of a compensated part.

    Parameters
    ----------
    made
        The part.
    printer
        Its foot and growth of lengths.
    on_top
        Whether the part lies on its top face.
    correct
        Whether foot and growth are taken off; else the slicer does it.

    Raises
    ------
    GeometryError
        The solid cannot be made; the message names the part.
    """
    model = made.model
    foot = printer.deviation.foot if correct else 0.0
    if model.outline is None:
        mesh, foot = part_mesh(model), 0.0
        turn = _largest_face_down(mesh)
        if on_top:
            turn = _OVER @ turn
    else:
        mesh = stacked(model, foot, printer.first, on_top=on_top)
        turn = _OVER if on_top else np.eye(3)
    off = (printer.deviation.scale_x, printer.deviation.scale_y) if correct else (1.0, 1.0)
    scale = np.array([1 / off[0], 1 / off[1], 1.0])
    points = (mesh.points @ turn.T) * scale
    lift = -float(points[:, 2].min())
    points[:, 2] += lift
    return PrintedMesh(Mesh(points, mesh.triangles), turn, scale, foot, lift)


_OVER = np.diag([1.0, -1.0, -1.0])
"""Turned over about X."""


def _largest_face_down(mesh: Mesh) -> Array:
    """The turn (3, 3) that lays a body on the flat face with the largest area of those it can lie on."""
    a, b, c = mesh.points[mesh.triangles].transpose(1, 0, 2)
    cross = np.cross(b - a, c - a)
    area = np.linalg.norm(cross, axis=1) / 2
    normal = cross / np.maximum(2 * area, np.finfo(float).tiny)[:, None]
    names, index = np.unique(np.round(normal / SAME_NORMAL), axis=0, return_inverse=True)
    best, found = 0.0, np.array([0.0, 0.0, -1.0])
    for number in range(len(names)):
        mine = index.ravel() == number
        if area[mine].sum() <= best:
            continue
        along = normal[mine][0]
        level = float((mesh.points @ along).max())
        flat = area[mine][np.abs(a[mine] @ along - level) < SAME_NORMAL].sum()
        if flat > best:
            best, found = float(flat), along
    return _turn_to_bed(found)


def _turn_to_bed(normal: Array) -> Array:
    """The least turn (3, 3) that points a unit vector straight down."""
    down = np.array([0.0, 0.0, -1.0])
    cosine = float(normal @ down)
    if cosine < -1 + 1e-12:
        return _OVER
    axis = np.cross(normal, down)
    x, y, z = axis
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turned: Array = np.eye(3) + skew + skew @ skew / (1 + cosine)
    return turned


def volume(mesh: Mesh) -> float:
    """Volume inside a closed mesh, mm³."""
    a, b, c = mesh.points[mesh.triangles].transpose(1, 0, 2)
    return float(math.fsum(np.einsum("ij,ij->i", a, np.cross(b, c)).tolist()) / 6)
