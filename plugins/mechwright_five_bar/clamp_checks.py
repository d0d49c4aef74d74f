"""Whether the machine can be set from phase to phase, how, and whether its clamps hold."""

import math
from collections.abc import Iterator

from mechwright import Finding, Stage, of_stage
from mechwright.mechanics.linkage.clamp_findings import clamped, no_clamp, too_near
from mechwright.mechanics.linkage.setting_findings import Places, Turned, setting_order
from mechwright.tolerances import exceeds, falls_short
from mechwright_five_bar.hardware import clamp_of_design, turning_bore
from mechwright_five_bar.hub import hub_of
from mechwright_five_bar.joints import slotted
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.peaks import peaks_of
from mechwright_five_bar.phases import pose_angles, set_joints


def setting_findings(params: FiveBarParams) -> Iterator[Finding]:
    """Whether the machine can be set, and in which order; ``params`` as the design has them."""

    def pose() -> list[Turned]:
        crank, rocker = pose_angles(params)
        ways = set_joints(params)
        return [
            Turned("A", "crank", crank, params.crank, ways["A"].slot is not None),
            Turned("C", "rocker", rocker, params.rocker, ways["C"].slot is not None),
        ]

    return setting_order(
        "five-bar.setting",
        pose,
        params.setting_angle,
        [(row.crank_turn, row.rocker_turn) for row in params.phases],
        lambda own: (
            "open the clamp of the arm's gear and hold the arm",
            own[0],
            "close the clamp of the arm's gear",
            own[1],
            "draw the pins and see the point on its mark",
        ),
    )


@of_stage(Stage.PARTS)
def places_apart(params: FiveBarParams) -> Iterator[Finding]:
    """Whether holes, slots and the point leave material between them in the coupler."""
    ways, pin = set_joints(params), params.pin_diameter
    places = Places((ways["A"], ways["C"]), params.coupler_point, turning_bore(params), pin)
    if clamp_of_design(params) is None and places.slotted:
        yield no_clamp("five-bar.phases", pin, params.thickness)
        return
    gap = places.nearest
    if not falls_short(gap.land, params.rim):
        return
    if params.phases:
        yield too_near("five-bar.phases", gap, params.rim, pin)
        return
    yield Finding.error(
        "five-bar.bores",
        "coupler_point_x" if gap in places.to_point else "coupler",
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
