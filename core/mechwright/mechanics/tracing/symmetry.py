"""Images under which points of the plane are themselves: what they turn a linkage into draws them as well."""

from collections.abc import Callable

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar import Plane

SYMMETRIC = 1e-6
"""Share of the path's size within which points are their own image."""

Image = Callable[[Plane], Plane]


def symmetries(targets: Plane, closed: bool, turns: Array | None) -> list[Image]:
    """Turns and reflections of the plane, other than none, that take the points to themselves in their order.

    The order may be the reverse one; closed paths may begin anywhere. Timed points keep their crank angles.
    """
    centre, n = complex(targets.mean()), targets.size
    unit = (targets - centre) / np.abs(targets - centre).max()
    found: list[Image] = []
    shifts = range(n) if closed else range(1)
    for shift in shifts:
        for back in (False, True):
            image = np.roll(unit[::-1] if back else unit, shift)
            if turns is not None and back and not _even(turns):
                continue
            for mirrored in (False, True):
                if (shift, back, mirrored) == (0, False, False):
                    continue
                turn = complex(np.vdot(np.conj(unit) if mirrored else unit, image))
                if abs(turn) == 0:
                    continue
                turn /= abs(turn)
                if np.abs(turn * (np.conj(unit) if mirrored else unit) - image).max() < SYMMETRIC:
                    found.append(_map(centre, turn, mirrored))
    return found


def _even(turns: Array) -> bool:
    """Whether crank angles are the same read from the end."""
    return bool(np.allclose(turns[-1] - turns[::-1], turns, atol=1e-9))


def _map(centre: complex, turn: complex, mirrored: bool) -> Image:
    def image(z: Plane) -> Plane:
        about = z - centre
        moved: Plane = centre + turn * (np.conj(about) if mirrored else about)
        return moved

    return image
