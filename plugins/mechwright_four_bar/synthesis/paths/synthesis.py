"""Synthesis of a path: a coupler point through points, timed or untimed, within limits.

The points of a path as they are asked for: as numbers.

Which designs on a path are one: near-identical ones, cognates, images under a symmetry.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import permutations

import numpy as np

from mechwright import Array, Finding, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.contracts.synthesis import ALIKE
from mechwright.mechanics.planar import Plane
from mechwright.mechanics.tracing.points import all_angles, in_plane, thinned
from mechwright.mechanics.tracing.requirement import SENSES, faults
from mechwright.mechanics.tracing.search import EXACT, MORE, SEARCH
from mechwright.mechanics.tracing.symmetry import Image, symmetries
from mechwright_four_bar.kinematics.cognates import Drawing, cognates, third_pivot
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.requirements import PathRequirement
from mechwright_four_bar.synthesis.candidates import GOOD_ANGLE, Found, buildable, building
from mechwright_four_bar.synthesis.paths.asked import Limits, PathProblem
from mechwright_four_bar.synthesis.paths.refit import fitted, rounded
from mechwright_four_bar.synthesis.paths.search import PathSearch, PathSolution, path, search


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


def problem_of(wanted: PathRequirement) -> PathProblem:
    """The requirement in complex numbers and radians.

    A first point that comes again at the end closes the path.
    """
    targets = np.array([complex(x, y) for x, y in wanted.points])
    turns = None if wanted.crank_turns is None else np.radians(wanted.crank_turns)
    again = targets.size > 3 and targets[0] == targets[-1] and turns is None
    return PathProblem(
        targets[:-1] if again else targets,
        turns,
        SENSES[wanted.sense],
        wanted.closed or bool(again),
        math.radians(wanted.order_tolerance),
        Limits(
            wanted.shortest_link,
            wanted.longest_link,
            math.radians(wanted.least_transmission_angle),
            wanted.frame,
        ),
    )


TIED = 1e-12
"""rad. Crank angles nearer than this are one: two points share it because their order would be another."""

SAME_TIMING = 1e-7
"""rad. By how much a cognate's crank angles may miss those that are prescribed: rounding."""


def through_points(wanted: PathRequirement, progress: Progress) -> Synthesis[FourBarParams]:
    """Linkages whose coupler point runs through the points in their order, within one turn of the crank.

    The crank turns fully and the linkage is never taken apart: there is no branch, circuit or order defect.
    Every design keeps all limits. Of a design and its cognates the one that builds best is given. Designs
    that meet the points exactly or within the tolerance come first: those with a good transmission angle, the
    smallest leading, then the others, the best transmission angle leading. Then come the designs that do not,
    the nearest first.
    """
    problem = problem_of(wanted)
    wrong = faults(wanted, problem.limits.contradiction(), "linkage")
    if errors(wrong):
        return Synthesis((), wrong)
    chosen = thinned(in_plane(problem.targets), problem.closed)
    turns = None if problem.turns is None else problem.turns[chosen]
    few = replace(problem, targets=problem.targets[chosen], turns=turns)
    met = max(wanted.tolerance, EXACT * problem.size)
    result = search(
        few,
        wanted.starts,
        MORE * wanted.designs,
        wanted.seed,
        lambda part: progress(SEARCH * part, "linkages through the points"),
        wanted.tolerance,
    )
    rejected = Rejected()
    good = _designs(result, few, problem, wanted, chosen, rejected)
    good.sort(key=lambda one: _rank(one, met))
    candidates, reason = buildable(
        ((_found(_best_built(one, problem, wanted)),) for one in good),
        wanted.designs,
        rejected,
        lambda part: progress(SEARCH + (1 - SEARCH) * part, "designs"),
        len(good),
    )
    if not candidates:
        return Synthesis((), (_refusal(wanted, result, good, reason),), rejected.reasons)
    best = min(good, key=lambda one: one.squares)
    said = _said(wanted, problem, best, candidates[0].residual.value, met)
    return Synthesis(tuple(candidates), (*wrong, _count(result, len(good)), *said), rejected.reasons)


def _designs(
    result: PathSearch, few: PathProblem, problem: PathProblem, wanted: PathRequirement, chosen: np.ndarray,
    rejected: Rejected,
) -> list[PathSolution]:  # fmt: skip
    """The distinct designs that are looked at, fitted to all points and rounded if that is asked for."""
    most = MORE * wanted.designs
    found = distinct(result.solutions, few, most)
    if len(chosen) < problem.targets.size:
        every = (
            fitted(one, problem, all_angles(chosen, one.phi, problem.targets.size, problem.closed))
            for one in found
        )
        found = [one for one in every if one is not None]
    if not wanted.length_step:
        return found
    good = []
    for one in found:
        stepped = rounded(one, problem, wanted.length_step)
        if stepped is None:
            rejected.because("path.length-step", f"no multiples of {wanted.length_step:g} mm keep the limits")
        else:
            good.append(stepped)
    return good


def _rank(one: PathSolution, met: float) -> tuple[float, float, float]:
    angle = min(one.bar.least_transmission_angle(), GOOD_ANGLE)
    return (0.0, -angle, one.longest) if one.mean <= met else (one.mean, -angle, one.longest)


def _best_built(one: PathSolution, problem: PathProblem, wanted: PathRequirement) -> tuple[PathSolution, int]:
    """Of a design and its cognates the one that builds best, and which it is: 1 the design itself.

    A cognate has no lengths in steps.
    """
    choices = [(one, 1)]
    if not wanted.length_step:
        choices += [
            (other, drawing.number)
            for drawing in cognates(one.bar, one.pivot, one.point, one.phi)[1:]
            if (other := _as_solution(drawing, one, problem)) is not None
        ]
    if len(choices) == 1:
        return choices[0]
    return min(choices, key=lambda choice: building(_found(choice)))


def _as_solution(drawing: Drawing, one: PathSolution, problem: PathProblem) -> PathSolution | None:
    """A cognate as a design; None where its crank does not turn, or as it should, or it breaks a limit."""
    if not drawing.bar.kind.full_turn or problem.limits.broken(drawing.bar, drawing.pivot, drawing.point)[0]:
        return None
    phi = drawing.phi
    if problem.turns is not None:
        if np.abs(phi - phi[0] - problem.turns).max() > SAME_TIMING:
            return None
    elif (1 if phi[-1] > phi[0] else -1) not in problem.senses:
        return None
    squares = float(
        np.sum(np.abs(path(drawing.bar, drawing.pivot, drawing.point, phi) - problem.targets) ** 2)
    )
    if not squares <= one.squares + (EXACT * problem.size) ** 2 * phi.size:
        return None
    return PathSolution(drawing.bar, drawing.pivot, drawing.point, phi, squares, one.held)


def _found(chosen: tuple[PathSolution, int]) -> Found:
    one, number = chosen
    figures = {
        "least_transmission_angle": Scalar(one.bar.least_transmission_angle(), "rad"),
        "longest_link": Scalar(one.longest, "mm"),
        "shortest_link": Scalar(min(one.bar.lengths), "mm"),
        "sum_of_squares": Scalar(one.squares, "mm^2"),
        "first_crank_angle": Scalar(float(one.phi[0] % math.tau), "rad"),
        "crank_turn": Scalar(float(one.phi[-1] - one.phi[0]), "rad"),
        "cognate": Scalar(float(number), ""),
    }
    return Found(one.bar, Scalar(one.mean, "mm"), figures, one.pivot, one.point, one.sense)


def _count(result: PathSearch, looked: int) -> Finding:
    """How many linkages there were to choose from."""
    return Finding.note(
        "path.found",
        f"in {result.starts} starts {len(result.solutions)} linkages came to rest within the limits and "
        f"{result.unsettled} beyond one; the {looked} nearest that differ were looked at",
        float(len(result.solutions)),
    )


def _said(
    wanted: PathRequirement, problem: PathProblem, best: PathSolution, residual: float, met: float
) -> list[Finding]:
    held = " and ".join(best.held)
    said: list[Finding] = []
    if residual > met and wanted.tolerance > 0:
        said.append(
            Finding.warning(
                "path.missed",
                "coupler_point_x",
                f"no design was found that meets the points within {wanted.tolerance:g} mm in the mean: "
                f"within the "
                f"limits the best one misses them by {residual:.4g} mm"
                + (f", held back by {held}" if held else ""),
                residual,
                wanted.tolerance,
                "mm",
                f"allow a larger tolerance, or widen {held}" if held else "allow a larger tolerance",
            )
        )
    elif residual > met and held:
        hold = "hold" if len(best.held) > 1 else "holds"
        message = f"{held} {hold} the nearest design back: it would come nearer without"
        said.append(Finding.note("path.held", message, residual, "mm"))
    tied = 0 if problem.turns is not None else int(np.sum(np.abs(np.diff(best.phi)) < TIED))
    if tied:
        said.append(
            Finding.note(
                "path.order",
                f"{tied} of {problem.targets.size} points step back along the path: the nearest design "
                f"passes each "
                "of them together with the one before it",
                float(tied),
            )
        )
    return said


def _refusal(wanted: PathRequirement, result: PathSearch, good: list[PathSolution], reason: str) -> Finding:
    if good:
        nearest = min(good, key=lambda one: one.squares)
        return Finding.error(
            "path.unbuildable",
            "crank",
            f"{len(good)} distinct linkages keep the limits, the nearest missing the points by "
            f"{nearest.mean:.3g} mm, "
            f"but none of them can be built: {reason}",
            remedy="scale the points, or change shortest_link and longest_link",
        )
    if result.solutions:
        return Finding.error(
            "path.length-step",
            "length_step",
            f"linkages keep the limits, but none with lengths in multiples of {wanted.length_step:g} mm",
            wanted.length_step,
            remedy="make length_step smaller",
        )
    near = result.nearest
    said = (
        ""
        if near is None
        else f": the nearest misses the points by {near.mean:.3g} mm and breaks {near.key}: {near.said}"
    )
    return Finding.error(
        "path.none",
        "crank",
        f"in {result.starts} starts no linkage was found that keeps the limits and passes near the points "
        f"in their "
        f"order{said}",
        remedy=f"widen {near.key}, or use more starts" if near else "use more starts, or widen the limits",
    )
