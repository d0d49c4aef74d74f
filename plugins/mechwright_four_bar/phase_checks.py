"""Whether a four-bar can be set from phase to phase, in which order, and whether its clamps hold."""

from collections.abc import Iterator

from mechwright import Finding, Stage, of_stage
from mechwright.mechanics.linkage.clamp_findings import clamped, no_clamp, too_near
from mechwright.mechanics.linkage.setting_findings import Places, Turned, setting_order
from mechwright.tolerances import falls_short
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.phases import clamp_of_design, pose_angles, set_joints
from mechwright_four_bar.parts.sizes import turning_bore
from mechwright_four_bar.peaks import peaks_of


def setting_findings(params: FourBarParams) -> Iterator[Finding]:
    """Whether the machine can be set, and in which order; ``params`` as the design has them."""

    def pose() -> list[Turned]:
        crank, follower = pose_angles(params)
        ways = set_joints(params)
        return [
            Turned("A", "crank", crank, params.crank, ways["A"].slot is not None),
            Turned("B", "follower", follower, params.follower, ways["B"].slot is not None),
        ]

    return setting_order(
        "four-bar.setting",
        pose,
        params.setting_angle,
        [(row.crank_turn, row.follower_turn) for row in params.phases],
        lambda own: (*own, "draw the pins"),
    )


@of_stage(Stage.PARTS)
def places_apart(params: FourBarParams) -> Iterator[Finding]:
    """Whether holes, slots and the point of several phases leave material between them in the coupler."""
    if not params.phases:
        return
    ways, pin = set_joints(params), params.pin_diameter
    places = Places((ways["A"], ways["B"]), params.coupler_point, turning_bore(params), pin)
    if clamp_of_design(params) is None and places.slotted:
        yield no_clamp("four-bar.phases", pin, params.thickness)
        return
    if falls_short(places.nearest.land, params.rim):
        yield too_near("four-bar.phases", places.nearest, params.rim, pin)


@of_stage(Stage.PARTS)
def clamps_hold(params: FourBarParams) -> Iterator[Finding]:
    """Whether friction holds more than what pulls."""
    clamp = clamp_of_design(params)
    for name, one in set_joints(params).items():
        if one.slot is not None and clamp is not None:
            yield from clamped("four-bar.clamp", name, clamp, peaks_of(params)[f"force_{name}"].value)
