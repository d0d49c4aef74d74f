"""Which designs on a path are one: near-identical ones, cognates, images under a symmetry."""

import math
from collections.abc import Callable, Sequence
from itertools import permutations

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.cognates import third_pivot
from mechwright_four_bar.paths.asked import PathProblem
from mechwright_four_bar.paths.search import PathSolution

SAME = 0.02
"""Share of the path's size, or of the links where these are larger, within which two designs are one."""

SYMMETRIC = 1e-6
"""Share of the path's size within which points are their own image."""

Image = Callable[[Plane], Plane]


def symmetries(problem: PathProblem) -> list[Image]:
    """Turns and reflections of the plane, other than none, that take the points to themselves in their order.

    The order may be the reverse one; closed paths may begin anywhere. Timed points keep their crank angles.
    """
    unit, n = problem.unit, problem.targets.size
    found: list[Image] = []
    shifts = range(n) if problem.closed else range(1)
    for shift in shifts:
        for back in (False, True):
            image = np.roll(unit[::-1] if back else unit, shift)
            if problem.turns is not None and back and not _even(problem.turns):
                continue
            for mirrored in (False, True):
                if (shift, back, mirrored) == (0, False, False):
                    continue
                turn = complex(np.vdot(np.conj(unit) if mirrored else unit, image))
                if abs(turn) == 0:
                    continue
                turn /= abs(turn)
                if np.abs(turn * (np.conj(unit) if mirrored else unit) - image).max() < SYMMETRIC:
                    found.append(_map(problem.centre, turn, mirrored))
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


def signature(one: PathSolution) -> tuple[Plane, Array]:
    """The pivots (3,) of the cognates and the two links (3, 2), shorter first, that turn about each."""
    bar, share = one.bar, one.point / one.bar.coupler
    a, c, b, _ = bar.lengths
    ground = bar.ground * complex(math.cos(bar.ground_angle), math.sin(bar.ground_angle))
    pivots = np.array([one.pivot, one.pivot + ground, third_pivot(bar, one.pivot, one.point)])
    near, far = abs(share), abs(1 - share)
    return pivots, np.sort([[a, near * c], [b, far * c], [near * b, far * a]], axis=1)


def distinct(found: Sequence[PathSolution], problem: PathProblem, most: int) -> list[PathSolution]:
    """The first ``most`` designs, none near-identical to, a cognate of, or an image of an earlier one."""
    images: list[Image] = [lambda z: z, *symmetries(problem)]
    kept: list[PathSolution] = []
    taken: list[tuple[Plane, Array]] = []
    for one in found:
        pivots, links = signature(one)
        room = SAME * max(problem.size, min(one.bar.lengths))
        if not any(_same(pivots, links, *other, images, room) for other in taken):
            kept.append(one)
            taken.append((pivots, links))
            if len(kept) == most:
                break
    return kept


def _same(
    pivots: Plane, links: Array, others: Plane, other_links: Array, images: Sequence[Image], room: float
) -> bool:
    for order in permutations(range(3)):
        index = list(order)
        if np.abs(links[index] - other_links).max() < room:
            for image in images:
                if np.abs(image(pivots)[index] - others).max() < room:
                    return True
    return False
