"""Whether the machine can be set from phase to phase, how, and whether its clamps hold."""

import math
from collections.abc import Iterator

from mechwright import Finding, KinematicsError, Severity, Stage, of_stage
from mechwright.mechanics.linkage.clamp_findings import clamped, no_clamp, too_near
from mechwright.mechanics.linkage.slots import gaps, point_gaps
from mechwright.tolerances import exceeds, falls_short
from mechwright_five_bar.hardware import clamp_of_design, turning_bore
from mechwright_five_bar.hub import hub_of
from mechwright_five_bar.joints import slotted
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.peaks import peaks_of
from mechwright_five_bar.phases import pose_angles, set_joints


def setting_findings(params: FiveBarParams) -> Iterator[Finding]:
    """Whether the machine can be set, and in which order; ``params`` as the design has them."""
    if not params.phases:
        return
    try:
        crank, rocker = pose_angles(params)
    except KinematicsError as error:
        said, _, remedy = str(error).partition("; ")
        yield Finding.error(
            "five-bar.setting", "setting_angle", said.partition(": ")[2], params.setting_angle, unit="deg",
            remedy=remedy,
        )  # fmt: skip
        return
    ways = set_joints(params)
    for number, row in enumerate(params.phases, start=2):
        steps = [
            f"turn the crank to {crank:.6g} degrees in phase 1 and pin the coupler to the ground",
            "open the clamp of the arm's gear and hold the arm",
            f"{_open(ways['A'].slot is not None, 'A')}, turn the crank by {row.crank_turn:+.6g} degrees to "
            f"{crank + row.crank_turn:.6g} and fasten A",
            "close the clamp of the arm's gear",
            f"{_open(ways['C'].slot is not None, 'C')}, turn the rocker by {row.rocker_turn:+.6g} degrees to "
            f"{_angle(rocker + row.rocker_turn):.6g} and fasten C",
            "draw the pins and see the point on its mark",
        ]
        yield Finding(
            "five-bar.setting",
            Severity.NOTE,
            "phases",
            f"phase {number}: "
            + "; ".join(f"{step}. {what}" for step, what in enumerate(steps, start=1))
            + f". The places are {_chord(params.crank, row.crank_turn):.4g} mm (A) and "
            f"{_chord(params.rocker, row.rocker_turn):.4g} mm (C) from those of phase 1",
            stage=Stage.PARTS,
        )


def _open(slot: bool, name: str) -> str:
    return f"loosen the clamp of {name}" if slot else f"take {name} out of its hole"


def _angle(degrees: float) -> float:
    """From -180 to 180."""
    return math.remainder(degrees, 360.0)


def _chord(radius: float, degrees: float) -> float:
    return 2 * radius * abs(math.sin(math.radians(degrees) / 2))


@of_stage(Stage.PARTS)
def places_apart(params: FiveBarParams) -> Iterator[Finding]:
    """Whether holes, slots and the point leave material between them in the coupler."""
    ways, bore, pin = set_joints(params), turning_bore(params), params.pin_diameter
    if clamp_of_design(params) is None and any(one.slot is not None for one in ways.values()):
        yield no_clamp("five-bar.phases", pin, params.thickness)
        return
    a, c = ways["A"], ways["C"]
    own = [gap for one in (a, c) for gap in point_gaps(one, params.coupler_point, bore, pin)]
    gap = min([*gaps(a, c, bore), *own], key=lambda gap: gap.land)
    if not falls_short(gap.land, params.rim):
        return
    if params.phases:
        yield too_near("five-bar.phases", gap, params.rim, pin)
        return
    yield Finding.error(
        "five-bar.bores",
        "coupler_point_x" if gap in own else "coupler",
        f"{gap.what} are {gap.distance:.4g} mm apart in the coupler and leave less than the rim of "
        f"{params.rim:g} mm",
        gap.distance,
        gap.walls + params.rim,
        "mm",
        "move the point, lengthen the coupler, or take smaller pins, bushings or rims",
    )


@of_stage(Stage.PARTS)
def clamps_hold(params: FiveBarParams) -> Iterator[Finding]:
    """Whether friction holds more than what pulls."""
    clamp, hub, peaks = clamp_of_design(params), hub_of(params), peaks_of(params)
    for name in "AC":
        if clamp is not None and slotted(params, name):
            yield from clamped("five-bar.clamp", name, clamp, peaks[f"force_{name}"].value)
    if hub is not None:
        torque, held = peaks["arm_torque"].value, hub.torque(params.pin_diameter)
        if exceeds(torque, held):
            yield Finding.warning(
                "five-bar.clamp",
                "pin_diameter",
                f"the clamp of the arm's gear holds {held:.4g} N m, and it carries up to {torque:.4g} N m",
                torque,
                held,
                "N*m",
                "take thicker pins, whose screws are larger, a smaller load or a lower speed",
            )
        yield Finding.note(
            "five-bar.clamp",
            f"the arm's gear is clamped by two M{hub.clamp.size.size:g} over {math.degrees(hub.sweep):.4g} "
            "degrees; "
            f"they hold {held:.4g} N m with safety, and carry up to {torque:.4g} N m",
            held,
            "N*m",
        )
