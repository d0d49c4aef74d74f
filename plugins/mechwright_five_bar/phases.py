"""A five-bar that is set to several phases: its coupler has a place for A and for C in each of them.

In the pose of setting the coupler is held and the arm rests. The gears are open, and the crank turns about A0
to the next phase's A; the rocker turns about B1 to its C. Crank, rocker, arm and ground are the same in all
phases; so is the coupler as a plate, of which other places are A and C, and by the offset of the gears the
crank has another angle to the arm.
"""

import cmath
import math

from mechwright import KinematicsError, kept
from mechwright.mechanics.linkage.slots import Setting, setting
from mechwright_five_bar.hardware import clamp_of_design, turning_bore
from mechwright_five_bar.loop import close
from mechwright_five_bar.params import FiveBarParams, PhaseTable
from mechwright_five_bar.reach import bar_of


@kept
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
        "coupler": abs(frame),
        "branch": "open" if (frame * (b1 - now[0]).conjugate()).imag > 0 else "crossed",
        "phase": 1,
        "setting_angle": (params.setting_angle or 0.0) + shown.crank_turn,
        "arm_angle": params.arm_angle - params.ratio * shown.crank_turn,
        "coupler_point_x": own.real,
        "coupler_point_y": own.imag,
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


@kept
def phases_of(params: FiveBarParams) -> tuple[FiveBarParams, ...]:
    """All phases as designs, that of ``params`` first; ``params`` shows its first phase."""
    return (params, *(shown_as(params, number) for number in range(2, 2 + len(params.phases))))


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
    for number, (name, centre) in enumerate((("A", 0j), ("C", b1))):
        places = tuple((row[number] - origin) * turn for row in rows)
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
    return params.setting_angle or 0.0, math.degrees(cmath.phase(c - b1))


def _pose(params: FiveBarParams) -> tuple[complex, complex]:
    """B1 and C from A0 in phase 1 in the pose of setting, mm."""
    loop = close(bar_of(params), math.radians(params.setting_angle or 0.0))
    b1, c = complex(loop.joint_b), complex(loop.joint_c)
    if not cmath.isfinite(c):
        raise KinematicsError(
            "setting_angle: the links of phase 1 cannot be joined with the crank at "
            f"{params.setting_angle:g} degrees; set the machine where they can"
        )
    return b1, c


def _pivots(params: FiveBarParams, row: PhaseTable, b1: complex, c: complex) -> tuple[complex, complex]:
    """A and C of a phase from A0 in the pose of setting, mm."""
    a = cmath.rect(params.crank, math.radians((params.setting_angle or 0.0) + row.crank_turn))
    return a, b1 + (c - b1) * cmath.rect(1.0, math.radians(row.rocker_turn))


def _unit(z: complex) -> complex:
    return z / abs(z)
