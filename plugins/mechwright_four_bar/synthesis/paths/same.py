"""Which designs on a path are one: near-identical ones, cognates, images under a symmetry."""

import math
from collections.abc import Sequence
from itertools import permutations

import numpy as np

from mechwright import Array
from mechwright.contracts.synthesis import ALIKE
from mechwright.mechanics.planar import Plane
from mechwright.mechanics.tracing.symmetry import Image, symmetries
from mechwright_four_bar.kinematics.cognates import third_pivot
from mechwright_four_bar.synthesis.paths.asked import PathProblem
from mechwright_four_bar.synthesis.paths.search import PathSolution


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
    images: list[Image] = [lambda z: z, *symmetries(problem.targets, problem.closed, problem.turns)]
    kept: list[PathSolution] = []
    taken: list[tuple[Plane, Array]] = []
    for one in found:
        pivots, links = signature(one)
        room = ALIKE * max(problem.size, min(one.bar.lengths))
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
