"""Rules of setting: whether the machine can be set from phase to phase, how, and whether its clamps hold."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Finding, Stage
from mechwright.contracts.design_rule import DesignRule
from mechwright.contracts.finding import at_stage
from mechwright.contracts.procedure import Procedure
from mechwright.mechanics.linkage.clamp_findings import clamped
from mechwright.mechanics.linkage.setting_findings import Turned, setting_order
from mechwright.tolerances import exceeds
from mechwright_five_bar.kinematics.loads import loads_of
from mechwright_five_bar.kinematics.phases import pose, pose_angles, set_joints
from mechwright_five_bar.parameters import FiveBarParams
from mechwright_five_bar.parts.hardware import clamp_of_design
from mechwright_five_bar.parts.hub import hub_of
from mechwright_five_bar.parts.joints import slotted
from mechwright_five_bar.table import FiveBarTable


def _order(params: FiveBarParams) -> Iterator[Finding]:
    """In which order a machine is set; ``params`` as the design has them."""

    def turned() -> list[Turned]:
        crank, rocker = pose_angles(params)
        ways = set_joints(params)
        return [
            Turned("A", "crank", crank, params.crank, ways["A"].slot is not None),
            Turned("C", "rocker", rocker, params.rocker, ways["C"].slot is not None),
        ]

    return setting_order(
        "five-bar.setting",
        turned,
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


def _clamps(m: FiveBarTable) -> Iterator[Finding]:
    """Whether friction holds more than what pulls."""
    params = m.params
    clamp, hub, peaks = clamp_of_design(params), hub_of(params), loads_of(m).peaks
    for name in "AC":
        if clamp is not None and slotted(params, name):
            yield from clamped("five-bar.clamp", name, clamp, peaks[f"force_{name}"].value)
    if hub is None:
        return
    torque, holds = peaks["arm_torque"].value, hub.torque(params.pin_diameter)
    if exceeds(torque, holds):
        yield Finding.warning(
            "five-bar.clamp",
            "pin_diameter",
            f"the clamp of the arm's gear holds {holds:.4g} N m, and it carries up to {torque:.4g} N m",
            torque,
            holds,
            "N*m",
            "take thicker pins, whose screws are larger, a smaller load or a lower speed",
        )
    yield Finding.note(
        "five-bar.clamp",
        f"the arm's gear is clamped by two M{hub.clamp.size.size:g} over {math.degrees(hub.sweep):.4g} "
        "degrees; "
        f"they hold {holds:.4g} N m with safety, and carry up to {torque:.4g} N m",
        holds,
        "N*m",
    )


POSE = DesignRule[FiveBarTable](
    "five-bar.setting",
    "setting_angle",
    "the links of phase 1 cannot be joined with the crank at {m.given.setting_angle:g} degrees",
    value=lambda m: np.isfinite(pose(m.given)[1]),
    limit=1,
    unit="deg",
    remedy="set the machine where they can",
    stage=Stage.MOTION,
    when=lambda m: bool(m.given.phases),
    reported=lambda f: (f.m.given.setting_angle, None),
)
ORDER = Procedure[FiveBarTable](("five-bar.setting",), lambda m: _order(m.given), warns=True)
CLAMPS = Procedure[FiveBarTable](("five-bar.clamp",), lambda m: at_stage(Stage.PARTS, _clamps(m)), warns=True)
