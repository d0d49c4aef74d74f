"""Where the printed parts lie: on as many beds as they take, largest first."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import DesignError
from mechwright.geometry.packing import on_plate
from mechwright_print.meshes.printed_mesh import PrintedMesh
from mechwright_print.printer.settings import Bed

MOST = 400
"""No more copies in one print job: their number comes from a file."""
_QUARTER = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
"""A row (x, y, z) times this is turned by 90 degrees about Z."""


@dataclass(frozen=True, eq=False)
class Placed:
    """A copy of a part on a bed: its name, its transform (4, 3) from its mesh to the bed, its box; mm."""

    name: str
    transform: Array
    box: tuple[float, float, float, float]


def laid_out(
    meshes: Sequence[tuple[str, PrintedMesh, int]], bed: Bed, gap: float, *, turn: bool = True
) -> list[list[Placed]]:
    """The copies of parts on beds, each bed a list; the layout stands in the middle of its bed.

    Parameters
    ----------
    meshes
        Name, mesh and number of copies of each part.
    bed
        Its size and the rim that stays free.
    gap
        Between two parts at least, mm.
    turn
        Whether parts may be turned by 90 degrees.

    Raises
    ------
    DesignError
        There are too many copies, or one does not fit on the bed; it names the bed that would do.
    """
    copies = [(name, mesh) for name, mesh, count in meshes for _ in range(count)]
    if len(copies) > MOST:
        raise DesignError(
            f"print: {len(copies)} copies, at most {MOST}; give parts to another process, as process.parts"
        )
    for name, mesh, _ in meshes:
        if (fault := too_large(name, mesh, bed)) is not None:
            raise DesignError(fault)
    copies.sort(key=lambda one: (-max(one[1].size[:2]), -min(one[1].size[:2])))
    inside = (bed.x - 2 * bed.margin, bed.y - 2 * bed.margin)
    beds: list[list[Placed]] = []
    while copies:
        taken: list[tuple[str, PrintedMesh]] = []
        spots = None
        for one in list(copies):
            layout = on_plate([mesh.size[:2] for _, mesh in [*taken, one]], *inside, gap, turn)
            if layout is not None:
                taken.append(one)
                spots = layout
                copies.remove(one)
        assert spots is not None  # noqa: S101 - each fits by itself
        shift = ((bed.x - spots.width) / 2, (bed.y - spots.height) / 2)
        beds.append(
            [
                _placed(name, mesh, (x + shift[0], y + shift[1]), turned)
                for (name, mesh), (x, y, turned) in zip(taken, spots.spots, strict=True)
            ]
        )
    return beds


def too_large(name: str, mesh: PrintedMesh, bed: Bed) -> str | None:
    """What is wrong where a part does not fit on a bed by itself; None if it does."""
    x, y, z = mesh.size
    room = (bed.x - 2 * bed.margin, bed.y - 2 * bed.margin)
    if z > bed.z or min(x, y) > min(room) or max(x, y) > max(room):
        needs = (math.ceil(max(x, y) + 2 * bed.margin), math.ceil(min(x, y) + 2 * bed.margin))
        return (
            f"bed: {name} takes {x:.1f} x {y:.1f} x {z:.1f} mm, and the bed has {room[0]:g} x {room[1]:g} x "
            f"{bed.z:g} mm within its margin; a bed of {needs[0]} x {needs[1]} x {math.ceil(z)} mm takes it"
        )
    return None


def _placed(name: str, mesh: PrintedMesh, corner: tuple[float, float], turned: bool) -> Placed:
    low = mesh.mesh.points.min(axis=0)
    high = mesh.mesh.points.max(axis=0)
    turn = _QUARTER if turned else np.eye(3)
    ends = np.array([low, high]) @ turn
    left, lower = ends[:, 0].min(), ends[:, 1].min()
    size = np.ptp(ends, axis=0)
    shift = np.array([corner[0] - left, corner[1] - lower, 0.0])
    box = (corner[0], corner[1], corner[0] + float(size[0]), corner[1] + float(size[1]))
    return Placed(name, np.vstack((turn, shift)), box)
