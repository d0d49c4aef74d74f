"""Whether a four-bar can be set from phase to phase, in which order, and whether its clamps hold."""

import math
from collections.abc import Iterator

from mechwright import Finding, KinematicsError, Severity, Stage, of_stage
from mechwright.mechanics.linkage.clamp_findings import clamped, no_clamp, too_near
from mechwright.mechanics.linkage.slots import gaps, point_gaps
from mechwright.tolerances import falls_short
from mechwright_four_bar.params import FourBarParams
from mechwright_four_bar.peaks import peaks_of
from mechwright_four_bar.phases import clamp_of_design, pose_angles, set_joints
from mechwright_four_bar.sizes import turning_bore


def setting_findings(params: FourBarParams) -> Iterator[Finding]:
    """Whether the machine can be set, and in which order; ``params`` as the design has them."""
    if not params.phases:
        return
    try:
        crank, follower = pose_angles(params)
    except KinematicsError as error:
        said, _, remedy = str(error).partition("; ")
        yield Finding.error(
            "four-bar.setting", "setting_angle", said.partition(": ")[2], params.setting_angle, unit="deg",
            remedy=remedy,
        )  # fmt: skip
        return
    slots = {name for name, one in set_joints(params).items() if one.slot is not None}
    for number, row in enumerate(params.phases, start=2):
        steps = [
            f"turn the crank to {crank:.6g} degrees in phase 1 and pin the coupler to the ground",
            f"{_open('A', slots)}, turn the crank by {row.crank_turn:+.6g} degrees to "
            f"{_angle(crank + row.crank_turn):.6g} and fasten A",
            f"{_open('B', slots)}, turn the follower by {row.follower_turn:+.6g} degrees to "
            f"{_angle(follower + row.follower_turn):.6g} and fasten B",
            "draw the pins",
        ]
        yield Finding(
            "four-bar.setting",
            Severity.NOTE,
            "phases",
            f"phase {number}: "
            + "; ".join(f"{step}. {what}" for step, what in enumerate(steps, start=1))
            + f". The places are {_chord(params.crank, row.crank_turn):.4g} mm (A) and "
            f"{_chord(params.follower, row.follower_turn):.4g} mm (B) from those of phase 1",
            stage=Stage.PARTS,
        )


def _open(name: str, slots: set[str]) -> str:
    return f"loosen the clamp of {name}" if name in slots else f"take {name} out of its hole"


def _angle(degrees: float) -> float:
    """From -180 to 180."""
    return math.remainder(degrees, 360.0)


def _chord(radius: float, degrees: float) -> float:
    return 2 * radius * abs(math.sin(math.radians(degrees) / 2))


@of_stage(Stage.PARTS)
def places_apart(params: FourBarParams) -> Iterator[Finding]:
    """Whether holes, slots and the point of several phases leave material between them in the coupler."""
    if not params.phases:
        return
    ways, bore, pin = set_joints(params), turning_bore(params), params.pin_diameter
    if clamp_of_design(params) is None and any(one.slot is not None for one in ways.values()):
        yield no_clamp("four-bar.phases", pin, params.thickness)
        return
    a, b = ways["A"], ways["B"]
    found = gaps(a, b, bore)
    if params.coupler_point is not None:
        found += [gap for one in (a, b) for gap in point_gaps(one, params.coupler_point, bore, pin)]
    gap = min(found, key=lambda gap: gap.land)
    if falls_short(gap.land, params.rim):
        yield too_near("four-bar.phases", gap, params.rim, pin)


@of_stage(Stage.PARTS)
def clamps_hold(params: FourBarParams) -> Iterator[Finding]:
    """Whether friction holds more than what pulls."""
    clamp = clamp_of_design(params)
    for name, one in set_joints(params).items():
        if one.slot is not None and clamp is not None:
            yield from clamped("four-bar.clamp", name, clamp, peaks_of(params)[f"force_{name}"].value)
