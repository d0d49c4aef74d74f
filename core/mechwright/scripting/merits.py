"""What the designs of a synthesis are compared by, and which of them no other one beats."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.contracts.motion import Motion, Scalar
from mechwright.contracts.synthesis import Candidate
from mechwright.scripting.mechanism import Mechanism
from mechwright.scripting.pareto import front_of

SENSES = {
    "error": 1,
    "size": 1,
    "least_transmission_angle": -1,
    "peak_acceleration": 1,
    "drive_torque": 1,
    "minutes": 1,
}
"""Objectives: 1 where less is better, -1 where more is."""

TRANSMISSION = ("least_transmission_angle", "least_transmission", "transmission_min")
"""Names of the least transmission angle among a candidate's figures and a motion's scalars."""

SAMPLES = 361
"""Of a period, for the peak of an acceleration."""

SAME_MERIT, ROUNDING = 1e-9, 1e-9
"""Share of an objective's greatest value, and the value itself, that is rounding: it decides between no two
designs."""


def merits(candidate: Candidate[Any], mechanism: Mechanism, minutes: bool = False) -> dict[str, Scalar]:
    """Objective to figure of a design; those that its family does not tell are left out.

    ``error`` is the residual; ``size`` the longest link, or the greatest length of an outline, mm;
    ``peak_acceleration`` that of the traced points, mm/s² at the design's speed; ``drive_torque`` the
    greatest, N m. With ``minutes`` those on the mill are told as well: its programs are made and proven.
    """
    motion = mechanism.design.solve(SAMPLES)
    told = {**motion.scalars, **candidate.figures}
    found = {"error": candidate.residual}
    size = told.get("longest_link") or _extent(mechanism)
    if size is not None:
        found["size"] = size
    angles = [told[name] for name in TRANSMISSION if name in told]
    if angles:
        found["least_transmission_angle"] = angles[0]
    peak = _peak(motion)
    if peak is not None:
        found["peak_acceleration"] = peak
    if "drive_torque_max" in told:
        found["drive_torque"] = told["drive_torque_max"]
    if minutes:
        found["minutes"] = Scalar(float(mechanism.result("minutes")), "min")
    return found


def _extent(mechanism: Mechanism) -> Scalar | None:
    """The greatest side of an outline's box."""
    sides = []
    for part in mechanism.design.parts():
        if part.outline is not None:
            sides.append(float(np.ptp(part.outline.outer.flatten(), axis=0).max()))
    return Scalar(max(sides), "mm") if sides else None


def _peak(motion: Motion) -> Scalar | None:
    """The greatest acceleration of a traced point; None where the motion has no such channels."""
    found = []
    for name in motion.traces:
        keys = [f"a{axis}{name}" for axis in "xyz"]
        rates = [motion.channels[key].values for key in keys if key in motion.channels]
        if rates:
            found.append(float(np.sqrt(np.square(rates).sum(axis=0)).max()))
    return Scalar(max(found), "mm/s^2") if found else None


def best_of(rows: Sequence[Mapping[str, Scalar]]) -> NDArray[np.int64]:
    """Numbers of the designs that no other beats in one objective without losing in another.

    Only objectives that all designs have count; differences that are rounding do not.

    >>> rows = [{"error": Scalar(x, "mm"), "size": Scalar(y, "mm")} for x, y in ((0, 9), (1, 5), (1, 9))]
    >>> best_of(rows).tolist()
    [0, 1]
    """
    names = [name for name in SENSES if rows and all(name in row for row in rows)]
    costs = np.array([[SENSES[name] * row[name].value for name in names] for row in rows])
    if not names:
        return np.arange(len(rows))
    step = np.maximum(SAME_MERIT * np.abs(costs).max(axis=0), ROUNDING)
    return front_of(np.round(costs / step))


def in_words(figure: Scalar) -> str:
    """A figure as people are told it: angles in degrees, four digits, rounding as 0.

    >>> in_words(Scalar(1.5e-14, "mm")), in_words(Scalar(12.3456, "mm/s^2"))
    ('0 mm', '12.35 mm/s²')
    """
    value = 0.0 if abs(figure.value) < ROUNDING else figure.value
    if figure.unit == "rad":
        return f"{math.degrees(value):.4g}°"
    unit = figure.unit.replace("^2", "²").replace("*", " ")
    return f"{value:.4g} {unit}".rstrip()
