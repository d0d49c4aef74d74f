"""Synthesis of a path: a coupler point through 3 to 35 points, timed or untimed."""

import math

import numpy as np

from mechwright import Finding, Progress, Rejected, Scalar, Synthesis
from mechwright.mechanics.multistart import distinct
from mechwright_four_bar.candidates import Found, buildable
from mechwright_four_bar.checks import GOOD_TRANSMISSION
from mechwright_four_bar.params import FourBarParams
from mechwright_four_bar.path_search import PathSolution, search
from mechwright_four_bar.requirements import PathRequirement

SAME = 1e-3
"""Linkages whose lengths agree to this share of themselves are one: nobody would choose between them."""

EXACT = 1e-11
"""Mean distance, as a share of the path's size, that is rounding: the points are met."""

GOOD_ANGLE = math.radians(GOOD_TRANSMISSION)
"""Transmission angle from which a larger one is not worth longer links."""

SEARCH = 0.9
"""Part of the work that is the search; the rest looks whether the designs can be built."""


def through_points(wanted: PathRequirement, progress: Progress) -> Synthesis[FourBarParams]:
    """Linkages whose coupler point runs through the points in their order, within one turn of the crank.

    The crank turns fully and the linkage is never taken apart: there is no branch, circuit or order defect.
    Designs that meet the points exactly or within the tolerance come first: those with a good transmission
    angle, the smallest leading, then the others, the best transmission angle leading. Then come the designs
    that do not, the nearest first.
    """
    targets = np.array([complex(x, y) for x, y in wanted.points])
    turns = None if wanted.crank_turns is None else np.radians(wanted.crank_turns)
    found = search(
        targets,
        turns,
        wanted.sense,
        wanted.starts,
        wanted.seed,
        math.radians(wanted.least_transmission_angle) / 2,
        lambda part: progress(SEARCH * part, "linkages through the points"),
    )
    rejected = Rejected()
    good = [one for one in found if _fits(one, wanted, rejected)]
    features = np.log([[*one.bar.lengths, abs(one.point)] for one in good]) if good else np.empty((0, 5))
    ways = np.array([[one.bar.branch, one.sense] for one in good]).reshape(len(good), 2)
    good = [good[index] for index in distinct(np.hstack((features, ways)), SAME)]
    met = max(wanted.tolerance, EXACT * float(np.ptp(targets.real) + np.ptp(targets.imag)))
    good.sort(key=lambda one: _rank(one, met))
    candidates, reason = buildable(
        (_found(one) for one in good),
        wanted.designs,
        rejected,
        lambda part: progress(SEARCH + (1 - SEARCH) * part, "designs"),
    )
    if not candidates:
        return Synthesis((), (_refusal(wanted, found, bool(good), reason),), rejected.reasons)
    best = candidates[0].residual.value
    findings = (_missed(wanted, best),) if best > met and wanted.tolerance > 0 else ()
    return Synthesis(tuple(candidates), findings, rejected.reasons)


def mean_distance(one: PathSolution) -> float:
    """Root mean square distance from the points, mm."""
    return math.sqrt(one.squares / one.phi.size)


def _rank(one: PathSolution, met: float) -> tuple[float, float, float]:
    mean = mean_distance(one)
    angle = min(one.bar.least_transmission_angle(), GOOD_ANGLE)
    return (0.0, -angle, one.longest) if mean <= met else (mean, -angle, one.longest)


def _fits(one: PathSolution, wanted: PathRequirement, rejected: Rejected) -> bool:
    """Whether a linkage keeps the limits; one that does not is counted under the first that it breaks."""
    angle, shortest = math.degrees(one.bar.least_transmission_angle()), min(one.bar.lengths)
    broken = {
        "path.longest-link": (one.longest > wanted.longest_link, f"a link is {one.longest:.4g} mm long"),
        "path.shortest-link": (shortest < wanted.shortest_link, f"a link is {shortest:.4g} mm long"),
        "path.transmission": (
            angle < wanted.least_transmission_angle,
            f"the transmission angle falls to {angle:.3g} degrees",
        ),
    }
    for code, (breaks, message) in broken.items():
        if breaks:
            rejected.because(code, message)
            return False
    return True


def _found(one: PathSolution) -> Found:
    figures = {
        "least_transmission_angle": Scalar(one.bar.least_transmission_angle(), "rad"),
        "longest_link": Scalar(one.longest, "mm"),
        "sum_of_squares": Scalar(one.squares, "mm^2"),
        "first_crank_angle": Scalar(float(one.phi[0] % math.tau), "rad"),
        "crank_turn": Scalar(float(one.phi[-1] - one.phi[0]), "rad"),
    }
    return Found(one.bar, Scalar(mean_distance(one), "mm"), figures, one.pivot, one.point, one.sense)


def _missed(wanted: PathRequirement, residual: float) -> Finding:
    return Finding.warning(
        "path.missed",
        "coupler_point_x",
        f"no linkage meets the points within {wanted.tolerance:g} mm in the mean: the best one found misses "
        f"them by {residual:.4g} mm",
        residual,
        wanted.tolerance,
        "mm",
        "allow a larger tolerance, leave crank_turns out, or use fewer points",
    )


def _refusal(wanted: PathRequirement, found: list[PathSolution], good: bool, reason: str) -> Finding:
    if good:
        return Finding.error(
            "path.unbuildable",
            "crank",
            f"no linkage through the points can be built: {reason}",
            remedy="scale the points, or change shortest_link and longest_link",
        )
    if not found:
        return Finding.error(
            "path.none",
            "crank",
            "no linkage passes near the points in their order within one turn",
            remedy="use more starts, leave crank_turns out, or leave points out",
        )
    best = found[0]
    angle = math.degrees(best.bar.least_transmission_angle())
    return Finding.error(
        "path.limits",
        "crank",
        "no linkage through the points keeps the limits: the nearest one misses the points by "
        f"{mean_distance(best):.3g} mm, its links are {min(best.bar.lengths):.4g} to {best.longest:.4g} mm "
        f"long and its transmission angle is {angle:.3g} degrees",
        angle,
        wanted.least_transmission_angle,
        "deg",
        "ask for a smaller least_transmission_angle or shortest_link, or a larger longest_link",
    )
