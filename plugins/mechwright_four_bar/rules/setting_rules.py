"""Whether a four-bar can be set from phase to phase, and in which order."""

from collections.abc import Iterator

from mechwright import Finding, Severity
from mechwright.contracts.procedure import Procedure
from mechwright.mechanics.linkage.setting_findings import Turned, setting_order
from mechwright_four_bar.parts.phases import pose_angles, set_joints
from mechwright_four_bar.table import FourBarTable


def _setting(m: FourBarTable) -> Iterator[Finding]:
    params = m.given

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


def _errors(m: FourBarTable) -> list[Finding]:
    return [one for one in _setting(m) if one.severity is Severity.ERROR]


def _steps(m: FourBarTable) -> list[Finding]:
    return [one for one in _setting(m) if one.severity is not Severity.ERROR]


CAN_BE_SET = Procedure[FourBarTable](("four-bar.setting",), _errors, when=lambda t: bool(t.given.phases))
STEPS = Procedure[FourBarTable](("four-bar.setting",), _steps, when=lambda t: bool(t.given.phases))
