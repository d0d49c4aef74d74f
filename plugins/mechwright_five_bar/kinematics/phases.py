"""A five-bar that is set to several phases: its coupler has a place for A and for C in each of them.

In the pose of setting the coupler is held and the arm rests. The gears are open, and the crank turns about A0
to the next phase's A; the rocker turns about B1 to its C. Crank, rocker, arm and ground are the same in all
phases; so is the coupler as a plate, of which other places are A and C, and by the offset of the gears the
crank has another angle to the arm.
"""

from typing import Any

import numpy as np

from mechwright import KinematicsError, kept
from mechwright.contracts.design_table import number
from mechwright.mechanics.linkage.slots import Setting, setting
from mechwright.mechanics.planar.dyad import directions
from mechwright_five_bar.kinematics.dimensions import bar_of
from mechwright_five_bar.parameters import FiveBarParams, PhaseTable
from mechwright_five_bar.parts.hardware import clamp_of_design, turning_bore


def in_phase(params: FiveBarParams) -> FiveBarParams:
    """The same machine as a design whose first phase is the one that is shown.

    Raises
    ------
    KinematicsError
        The links cannot be joined in the pose of setting.
    """
    return params if params.phase == 1 else shown_as(params, params.phase)


def shown_as(params: FiveBarParams, phase: int) -> FiveBarParams:
    """The design with a phase, from 1, as its first one; ``params`` with theirs as they are written."""
    if phase == 1:
        return params.model_copy(update={"phase": 1})
    shown, b1, c = params.phases[phase - 2], *_pose(params)
    first, now = _pivots(params, PhaseTable(), b1, c), _pivots(params, shown, b1, c)
    frame = now[1] - now[0]
    at = first[0] + params.coupler_point * _unit(first[1] - first[0])
    own = (at - now[0]) / _unit(frame)
    changes: dict[str, object] = {
        "coupler": number(abs(frame)),
        "branch": number(np.where((frame * np.conj(b1 - now[0])).imag > 0, "open", "crossed")),
        "phase": 1,
        "setting_angle": _setting_angle(params) + shown.crank_turn,
        "arm_angle": params.arm_angle - params.ratio * shown.crank_turn,
        "coupler_point_x": number(own.real),
        "coupler_point_y": number(own.imag),
    }
    if shown.swing_from is not None:
        changes |= {"swing_from": shown.swing_from, "swing_to": shown.swing_to}
    base = PhaseTable.model_construct(swing_from=params.swing_from, swing_to=params.swing_to)
    changes["phases"] = tuple(
        PhaseTable.model_construct(
            crank_turn=row.crank_turn - shown.crank_turn,
            rocker_turn=row.rocker_turn - shown.rocker_turn,
            swing_from=row.swing_from if row.swing_from is not None else params.swing_from,
            swing_to=row.swing_to if row.swing_to is not None else params.swing_to,
        )
        for row in (base, *(row for row in params.phases if row is not shown))
    )
    return params.model_copy(update=changes)


def phases_of(params: FiveBarParams) -> tuple[FiveBarParams, ...]:
    """All phases as designs, that of ``params`` first; ``params`` shows its first phase."""
    return (params, *(shown_as(params, 2 + place) for place in range(len(params.phases))))


def settings_of(params: FiveBarParams) -> tuple[tuple[Setting, tuple[complex, ...]], ...]:
    """How A and C are set in the coupler, in its frame of phase 1, and their places in all phases, mm.

    Raises KinematicsError where the links cannot be joined in the pose of setting.
    """
    if not params.phases:
        return tuple(
            (Setting(name, (at,)), (at,)) for name, at in (("A", 0j), ("C", complex(params.coupler)))
        )
    b1, c = _pose(params)
    rows = [_pivots(params, row, b1, c) for row in (PhaseTable(), *params.phases)]
    origin, turn = rows[0][0], _unit(rows[0][1] - rows[0][0]).conjugate()
    clamp = clamp_of_design(params)
    found = []
    for place, (name, centre) in enumerate((("A", 0j), ("C", b1))):
        places = tuple((row[place] - origin) * turn for row in rows)
        width = clamp.width if clamp is not None else turning_bore(params)
        one = setting(name, places, (centre - origin) * turn, turning_bore(params), params.rim, width)
        found.append((one, places))
    return tuple(found)


@kept
def set_joints(params: FiveBarParams) -> dict[str, Setting]:
    """The settings by name; with single holes where the pose of setting cannot be joined."""
    try:
        return {one.name: one for one, _ in settings_of(params)}
    except KinematicsError:
        return {one.name: one for one, _ in settings_of(params.model_copy(update={"phases": ()}))}


def pose_angles(params: FiveBarParams) -> tuple[float, float]:
    """Of crank and rocker from X in the pose of setting, degrees."""
    b1, c = _pose(params)
    return _setting_angle(params), number(np.degrees(np.angle(c - b1)))


def _setting_angle(params: FiveBarParams) -> Any:
    """Of the crank, degrees."""
    return 0.0 if params.setting_angle is None else params.setting_angle


def pose(params: FiveBarParams) -> tuple[Any, Any]:
    """B1 and C from A0 in phase 1 in the pose of setting, mm; NaN where the links cannot be joined."""
    bar = bar_of(params)
    a, b1 = bar.pivots(np.radians(_setting_angle(params)))
    coupler, _ = directions(np.asarray(b1 - a), bar.coupler, bar.rocker, bar.branch)
    return number(b1), number(a + bar.coupler * coupler)


def _pose(params: FiveBarParams) -> tuple[Any, Any]:
    """The same; raises KinematicsError of one design whose links cannot be joined."""
    b1, c = pose(params)
    if np.ndim(c) == 0 and not np.isfinite(c):
        raise KinematicsError(
            "setting_angle: the links of phase 1 cannot be joined with the crank at "
            f"{_setting_angle(params):g} degrees; set the machine where they can"
        )
    return b1, c


def _pivots(params: FiveBarParams, row: PhaseTable, b1: Any, c: Any) -> tuple[Any, Any]:
    """A and C of a phase from A0 in the pose of setting, mm."""
    angles = _setting_angle(params) + row.crank_turn, row.rocker_turn
    crank, rocker = (number(np.exp(1j * np.radians(angle))) for angle in angles)
    return params.crank * crank, b1 + (c - b1) * rocker


def _unit(z: Any) -> Any:
    return z / abs(z)
