"""Dwells, strokes and functions as places that a page can draw and drag: about the origin, a unit a mm."""

import cmath
import math
from functools import partial

from mechwright import Target
from mechwright_linkage.requirements import DwellRequirement, FunctionRequirement

RADIUS = 100.0
"""Of the circle on which the angle of a dwell is shown, mm."""

LEAST, MOST, SHORTEST = 5.0, 200.0, 0.1
"""Degrees of a dwell, and the least stroke, to which a target can be dragged."""

PLACES = 4
"""Digits behind the point of what a drag writes."""


def dwell_targets(requirement: DwellRequirement) -> tuple[Target, ...]:
    """The end of the dwell on a circle, and that of the stroke on X.

    >>> dwell, stroke = dwell_targets(DwellRequirement(dwell=90, stroke=40))
    >>> [round(part, 3) for part in dwell.place], stroke.place
    ([0.0, 100.0], (40.0, 0.0))
    >>> dwell.moved((50.0, 50.0)), stroke.moved((55.0, 3.0))
    ({'dwell': 45.0}, {'stroke': 55.0})
    """
    end = cmath.rect(RADIUS, math.radians(requirement.dwell))
    return (
        Target("end of the dwell", (end.real, end.imag), _dwelling),
        Target("stroke", (requirement.stroke, 0.0), _stroke),
    )


def _dwelling(place: tuple[float, ...]) -> dict[str, float]:
    turned = math.degrees(cmath.phase(complex(place[0], place[1]))) % 360
    return {"dwell": round(min(max(turned, LEAST), MOST), PLACES)}


def _stroke(place: tuple[float, ...]) -> dict[str, float]:
    return {"stroke": round(min(max(place[0], SHORTEST), 1000.0), PLACES)}


def function_targets(requirement: FunctionRequirement) -> tuple[Target, ...]:
    """Each output over its input but the first, which is 0; a drag moves the output.

    >>> first, *_ = function_targets(FunctionRequirement())
    >>> first.place, first.moved((99.0, 5.0))["outputs"][:3]
    ((30.0, 2.0), [0.0, 5.0, 8.0])
    """
    pairs = zip(requirement.input_angles, requirement.outputs, strict=True)
    return tuple(
        Target(f"output {number}", pair, partial(_answer, requirement.outputs, number - 1), "outputs")
        for number, pair in enumerate(pairs, start=1)
        if number > 1
    )


def _answer(outputs: tuple[float, ...], index: int, place: tuple[float, ...]) -> dict[str, list[float]]:
    changed = round(min(max(place[1], -1000.0), 1000.0), PLACES)
    return {"outputs": [changed if n == index else value for n, value in enumerate(outputs)]}
