"""Synthesis through prescribed acceleration poles of the coupler: crank-rockers and double cranks."""

import math

import numpy as np

from mechwright import Finding, Progress, Rejected, Scalar, Synthesis
from mechwright.mechanics.planar.accelerating import common_ratio, of_several_ratios
from mechwright_four_bar.kinematics.dimensions import Kind
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.requirements import PolesRequirement
from mechwright_four_bar.synthesis.candidates import Found, buildable
from mechwright_four_bar.synthesis.poles.all_poles import AllPoles, all_linkages
from mechwright_four_bar.synthesis.poles.equations import PoleProblem
from mechwright_four_bar.synthesis.poles.search import PoleSolution, completed, search


def problem_of(wanted: PolesRequirement, full_turn: bool) -> PoleProblem:
    """The equations of a requirement, on the open branch."""
    return PoleProblem(
        np.array([complex(x, y) for x, y in wanted.poles]),
        np.radians(wanted.crank_turns) if wanted.crank_turns else None,
        None if wanted.ground_angle is None else math.radians(wanted.ground_angle),
        wanted.ground,
        1,
        full_turn,
        np.array(wanted.acceleration_ratios),
    )


def through_poles(wanted: PolesRequirement, progress: Progress) -> Synthesis[FourBarParams]:
    """Linkages whose crank turns fully and whose coupler has its acceleration pole in all places.

    All places lie on one branch, hence in one circuit. The designs are sorted by their transmission angle.
    Where none is found, linkages whose crank does not turn are searched too, to say what there is.

    Two poles with a given turn and ground, at constant speed, are also solved completely, and the first
    finding says how many solutions of how many are known; of others it says in how many starts linkages were
    sought.
    """
    problem = problem_of(wanted, full_turn=True)
    result = search(problem, wanted.starts, wanted.seed, lambda part: progress(0.5 * part, "full turns"))
    every = _every(wanted)
    solutions = completed(problem, result.solutions, every.turning) if every is not None else result.solutions
    turning = [one for one in solutions if one.bar.kind.full_turn]
    least = math.radians(wanted.least_transmission_angle)
    good = sorted(
        (one for one in turning if one.bar.least_transmission_angle() >= least),
        key=lambda one: -one.bar.least_transmission_angle(),
    )
    rejected = Rejected()
    for one in turning:
        if one.bar.least_transmission_angle() < least:
            angle = math.degrees(one.bar.least_transmission_angle())
            rejected.because("poles.transmission", f"the transmission angle falls to {angle:.3g} degrees")
    common = common_ratio(wanted.acceleration_ratios)
    candidates, reason = buildable(
        ((_found(one, common or 0.0),) for one in good),
        wanted.designs,
        rejected,
        lambda part: progress(0.5 + 0.3 * part, "designs"),
        len(good),
    )
    if candidates:
        notes = _notes(problem, turning, len(candidates), every, wanted)
        if common is None:
            notes.append(of_several_ratios("poles.ratios", wanted.acceleration_ratios))
        return Synthesis(tuple(candidates), tuple(notes), rejected.reasons)
    refusal = _refusal(wanted, result.nearest, turning, bool(good), reason, every, progress)
    return Synthesis((), (refusal,), rejected.reasons)


def _found(one: PoleSolution, ratio: float) -> Found:
    figures = {
        "least_transmission_angle": Scalar(one.bar.least_transmission_angle(), "rad"),
        **{
            f"crank_angle_{number}": Scalar(float(angle), "rad")
            for number, angle in enumerate(one.phi, start=1)
        },
        "double_crank": Scalar(float(one.bar.kind is Kind.DOUBLE_CRANK), ""),
    }
    return Found(one.bar, Scalar(one.residual, "mm"), figures, acceleration_ratio=ratio, digits=None)


def _every(wanted: PolesRequirement) -> AllPoles | None:
    """All four-bars through two poles with a given turn and ground, at constant speed; None for others."""
    if len(wanted.crank_turns) != 2 or wanted.ground is None or wanted.ground_angle is None:
        return None
    if any(wanted.acceleration_ratios):
        return None
    return all_linkages(wanted.poles, wanted.crank_turns[1], wanted.ground_angle, wanted.ground)


def _notes(
    problem: PoleProblem,
    turning: list[PoleSolution],
    given: int,
    every: AllPoles | None,
    wanted: PolesRequirement,
) -> list[Finding]:
    starts = 2 * wanted.starts
    if every is not None:
        lost = len(every.turning) - len(turning)
        near = f", {lost} so near to a toggle that rounded lengths miss the poles" if lost > 0 else ""
        said = f"{every.count}{near}; {given} of them are given"
    elif problem.freedom > 0:
        said = (
            f"{len(turning)} linkages of infinitely many with a full turn were found in {starts} starts, "
            f"{given} of them are given"
        )
    else:
        said = (
            f"{len(turning)} linkages with a full turn were found in {starts} starts, {given} of them are "
            "given; whether there are more is not known"
        )
    return [Finding.note("poles.found", said, float(len(turning)))]


def _refusal(
    wanted: PolesRequirement,
    nearest: float,
    turning: list[PoleSolution],
    good: bool,
    reason: str,
    every: AllPoles | None,
    progress: Progress,
) -> Finding:
    if good:
        return Finding.error(
            "poles.unbuildable",
            "crank",
            f"{len(turning)} linkages have their poles there, but none can be built: {reason}",
            remedy="scale the places: lengths scale with them",
        )
    if turning:
        best = max(math.degrees(one.bar.least_transmission_angle()) for one in turning)
        return Finding.error(
            "poles.transmission",
            "crank",
            f"the best linkage with its poles there has a transmission angle of {best:.3g} degrees",
            best,
            wanted.least_transmission_angle,
            "deg",
            f"ask for a least_transmission_angle of at most {math.floor(best * 10) / 10:g}, or move a place",
        )
    other = search(
        problem_of(wanted, full_turn=False),
        wanted.starts,
        wanted.seed,
        lambda part: progress(0.5 + 0.5 * part, "linkages without a full turn"),
    )
    without = f"; {len(other.solutions)} others have, but their cranks cannot turn" if other.solutions else ""
    return Finding.error(
        "poles.none",
        "crank",
        f"no linkage with a full turn was found in {2 * wanted.starts} starts whose poles lie there"
        f"{without}: the nearest one misses them by {nearest:.3g} mm in the mean"
        + (f"; {every.count}" if every is not None else ""),
        nearest,
        0.0,
        "mm",
        "move a place, change crank_turns, or use more starts",
    )
