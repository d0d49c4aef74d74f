"""From a requirement to designs: lengths, plates that can be built, and the simulated proof."""

import math
from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np
from pydantic import ValidationError

from mechwright import Candidate, Finding, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.mechanics.planar.accelerating import common_ratio, of_several_ratios
from mechwright_slider_crank.kinematics.limits import least_transmission_angle
from mechwright_slider_crank.kinematics.simulated_stroke import simulated
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_slider_crank.parts.dimensions import dimensions_of
from mechwright_slider_crank.requirements import PolesRequirement, StrokeRequirement
from mechwright_slider_crank.rules.rule_table import RULES
from mechwright_slider_crank.synthesis.poles.all_poles import AllPoles, all_linkages
from mechwright_slider_crank.synthesis.poles.synthesis import ACCURACY, Found, completed, through_poles
from mechwright_slider_crank.synthesis.stroke import Lengths, bounds, lengths_of
from mechwright_slider_crank.table import SliderCrankTable

Design = SliderCrankParams

_PIN_SHARES = (1.0, 0.75, 0.5)
"""Pins that are tried, over the usual ones: where the parts are in each other's way, slender ones may do."""

DIGITS = 10
"""Decimals of a length, mm: far below what anybody makes, and enough for the stroke to hold."""

LEAST_PIN = 1.5
"""mm, the thinnest pin that a synthesis chooses by itself."""


def buildable(lengths: Mapping[str, Any]) -> tuple[Design | None, str]:
    """The first design of these lengths without an error: stout pins first, a disc before an arm.

    Without one, the text says why.
    """
    try:
        usual = Design.model_validate(lengths)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        return None, f"{'.'.join(map(str, first['loc']))} {first['msg'].removeprefix('Input ')}"
    sizes, why = dimensions_of(usual), ""
    for share, shape in product(_PIN_SHARES, ("disc", "arm")):
        thinner = {} if share == 1 else {"pin": max(LEAST_PIN, round(share * sizes.pin, 1))}
        params = Design.model_validate({**lengths, **thinner, "crank_shape": shape})
        found = errors(RULES.findings(SliderCrankTable.of(params), quick=True))
        if not found:
            return params, ""
        why = why or f"{found[0].parameter}: {found[0].message}"
    return None, why


def from_stroke(wanted: StrokeRequirement) -> Synthesis[Design]:
    """The slider-crank with this stroke and time ratio, its offset on the side of the wanted quick stroke."""
    refused = tuple(bounds(wanted))
    if refused:
        return Synthesis((), refused)
    exact = lengths_of(wanted)
    lengths = Lengths(*(round(one, DIGITS) for one in (exact.crank, exact.rod, exact.offset)))
    # With a slide to the left, e > 0, a crank that turns counter-clockwise takes longer for the way back.
    offset = lengths.offset if wanted.quick == "outward" or not lengths.offset else -lengths.offset
    params, why = buildable(
        {
            "crank": lengths.crank,
            "rod": lengths.rod,
            "offset": offset,
            "slide_direction": wanted.slide_direction,
        }
    )
    if params is None:
        fault = Finding.error(
            "slider-crank.not-buildable",
            "crank",
            f"crank {lengths.crank:.6g}, rod {lengths.rod:.6g} and offset {lengths.offset:.6g} mm have this "
            f"stroke and time ratio, but cannot be built: {why}",
            remedy="choose another length inside its range, or a larger stroke",
        )
        rejected = Rejected()
        rejected.because("slider-crank.not-buildable", why)
        return Synthesis((), (fault,), rejected.reasons)
    stroke, ratio = simulated(params.linkage)
    figures = {
        "least_transmission_angle": Scalar(_transmission(params), "deg"),
        "stroke_simulated": Scalar(stroke, "mm"),
        "time_ratio_simulated": Scalar(ratio, ""),
        **_lengths(params),
    }
    candidate = Candidate(params, Scalar(abs(stroke - wanted.stroke), "mm"), figures)
    if not offset:
        return Synthesis((candidate,))
    said = (
        f"the mirror image, offset = {-offset:.6g} and clockwise = true, does the same; with one of the two "
        "alone the other stroke is the quick one"
    )
    note = Finding.note("slider-crank.mirror", said, -offset, "mm")
    return Synthesis((candidate,), (note,))


def _lengths(params: Design) -> dict[str, Scalar]:
    return {
        "crank": Scalar(params.crank, "mm"),
        "rod": Scalar(params.rod, "mm"),
        "offset": Scalar(params.offset, "mm"),
    }


def _transmission(params: Design) -> float:
    return math.degrees(least_transmission_angle(params.crank, params.rod, params.offset))


def from_poles(wanted: PolesRequirement, progress: Progress) -> Synthesis[Design]:
    """Slider-cranks through the poles, by transmission angle.

    Two poles at constant speed are also solved completely, and the first finding says how many solutions of
    how many are known; of other poles it says in how many starts linkages were sought.
    """
    turn = np.exp(-1j * math.radians(wanted.slide_direction))
    places = np.array([complex(x, y) for x, y in wanted.poles]) * turn
    rotations = np.radians(np.array(wanted.rotations, dtype=float))
    ratios = np.array(wanted.acceleration_ratios)
    solutions, best = through_poles(places, rotations, wanted.starts, wanted.seed, progress, ratios)
    common = common_ratio(wanted.acceleration_ratios)
    every = _every(wanted)
    if every is not None:
        solutions = completed(solutions, every.turning, places, rotations)
    candidates: list[Candidate[Design]] = []
    notes: list[Finding] = []
    rejected = Rejected()
    for found in solutions:
        params, why = buildable(
            {
                "crank": found.crank,
                "rod": found.rod,
                "offset": found.offset,
                "assembly": _side(found),
                "slide_direction": wanted.slide_direction,
                "acceleration_ratio": common or 0.0,
            }
        )
        if params is None:
            notes.append(_left_out(found, why))
            rejected.because("slider-crank.not-buildable", why)
            continue
        if any(params == other.params for other in candidates):
            continue  # the same linkage meets the poles at other crank angles as well
        angles = {
            f"phi_{number}": Scalar((math.degrees(angle) + wanted.slide_direction) % 360, "deg")
            for number, angle in enumerate(found.angles, start=1)
        }
        figures = {
            "least_transmission_angle": Scalar(_transmission(params), "deg"),
            **_lengths(params),
            **angles,
        }
        candidates.append(Candidate(params, Scalar(found.residual, "mm"), figures))
    if common is None and candidates:
        notes.append(of_several_ratios("slider-crank.ratios", wanted.acceleration_ratios))
    if candidates:
        notes.insert(0, _count(len(solutions), every, wanted))
    else:
        notes.insert(0, _none_found(notes, best, wanted, every))
    return Synthesis(tuple(candidates), tuple(notes), rejected.reasons)


def _every(wanted: PolesRequirement) -> AllPoles | None:
    """All slider-cranks through two poles at constant speed; None for other poles."""
    if not wanted.rotations or any(wanted.acceleration_ratios):
        return None
    return all_linkages(wanted.poles, wanted.rotations[0], wanted.slide_direction)


def _count(found: int, every: AllPoles | None, wanted: PolesRequirement) -> Finding:
    if every is not None:
        lost = len(every.turning) - found
        rounded = f"; {lost} of them turn so barely that rounded lengths miss the poles" if lost > 0 else ""
        return Finding.note("slider-crank.count", every.count + rounded, float(found))
    return Finding.note(
        "slider-crank.count",
        f"{found} found in {2 * wanted.starts} starts; whether there are more is not known",
        float(found),
    )


def _side(found: Found) -> str:
    return "ahead" if found.branch > 0 else "behind"


def _left_out(found: Found, why: str) -> Finding:
    return Finding.note(
        "slider-crank.left-out",
        f"crank {found.crank:.6g}, rod {found.rod:.6g}, offset {found.offset:.6g} mm, {_side(found)}, has "
        f"the poles as well, but cannot be built: {why}",
        found.residual,
        "mm",
    )


def _none_found(
    left_out: Sequence[Finding], best: float, wanted: PolesRequirement, every: AllPoles | None
) -> Finding:
    if left_out:
        return Finding.error(
            "slider-crank.not-buildable",
            "poles",
            f"{len(left_out)} slider-cranks have these poles, but none can be built: {left_out[0].message}",
            remedy="scale the poles up, or move them",
        )
    nearest = f"the best residual found is {best:.4g} mm" if math.isfinite(best) else "none came near"
    return Finding.error(
        "slider-crank.no-solution",
        "poles",
        f"no slider-crank with a crank that turns was found for these poles in {2 * wanted.starts} starts; "
        f"{nearest}" + (f"; {every.count}" if every is not None else ""),
        best if math.isfinite(best) else None,
        ACCURACY,
        "mm",
        "move a pole, change the rotation, or give more starts",
    )
