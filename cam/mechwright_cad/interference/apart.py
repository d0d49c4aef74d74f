"""Bodies whose boxes never meet: they need no look at their surfaces."""

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.by_form import kept_by_form
from mechwright.contracts.part import Instance, Part
from mechwright_cad.bodies import Body


def apart(one: Body, two: Body, rotation: Array, position: Array) -> bool:
    """Whether the boxes of two bodies stay apart over a motion.

    Between two samples a corner is at most its way between them from where it was at either.

    Parameters
    ----------
    rotation, position
        Of the second body in the frame of the first, (n, 3, 3) and (n, 3), mm.
    """
    box, other = box_of(one.part, one.instance), box_of(two.part, two.instance)
    corners = np.stack(np.meshgrid(*other.T, indexing="ij"), axis=-1).reshape(-1, 3)
    seen = np.einsum("nij,kj->nki", rotation, corners) + position[:, None]
    way = np.linalg.norm(np.diff(seen, axis=0), axis=2).max(initial=0.0)
    low, high = seen.min(axis=1) - way, seen.max(axis=1) + way
    return bool(((low > box[1]) | (high < box[0])).any(axis=1).all())


def box_of(part: Part, instance: Instance) -> Array:
    """The least and the greatest corner (2, 3) of a box round a body, in the body's frame, mm."""
    lifted: Array = np.add(_box(part), (0.0, 0.0, instance.z))
    return lifted


@kept_by_form(512)
def _box(part: Part) -> Array:
    if part.outline is not None:
        x0, y0, x1, y1 = part.outline.bounds
        low, high = 0.0, part.thickness
    else:
        from mechwright_cad.solids.solid import part_solid

        box = part_solid(part).BoundingBox()
        x0, y0, x1, y1, low, high = box.xmin, box.ymin, box.xmax, box.ymax, box.zmin, box.zmax
    return np.array(((x0, y0, low), (x1, y1, high)))
