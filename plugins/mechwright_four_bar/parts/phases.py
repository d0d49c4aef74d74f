"""A four-bar that is set to several phases: its coupler has a place for each pivot of each phase.

In the pose of setting the coupler is held, the crank turns about A0 and the follower about B0 to the places
of the next phase. Crank, follower and ground are the same in all phases, and so is the coupler as a plate:
only which of its places are A and B changes. Places that are far enough apart have a hole each, others one
slot.
"""

import cmath
import math

from mechwright import KinematicsError, kept
from mechwright.mechanics.linkage.clamp import Clamp, clamps
from mechwright.mechanics.linkage.slots import Setting, setting
from mechwright.mechanics.linkage.turned import HEAD_HEIGHT
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.parameters import FourBarParams, PhaseTable
from mechwright_four_bar.parts.usual import turning_bore


@kept
def in_phase(params: FourBarParams) -> FourBarParams:
    """The same machine as a design whose first phase is the one that is shown.

    Raises
    ------
    KinematicsError
        The links cannot be joined in the pose of setting.
    """
    if params.phase == 1:
        return params
    shown, start = params.phases[params.phase - 2], _pose(params)
    a, b = _pivots(params, shown, start)
    one, frame = _pivots(params, PhaseTable(), start), b - a
    coupler = abs(frame)
    changes: dict[str, object] = {
        "coupler": coupler,
        "branch": "open" if (frame * (pivot_b0(params) - a).conjugate()).imag > 0 else "crossed",
        "phase": 1,
        "setting_angle": (params.setting_angle or 0.0) + shown.crank_turn,
    }
    if (point := params.coupler_point) is not None:
        at = one[0] + point * (one[1] - one[0]) / abs(one[1] - one[0])
        own = (at - a) * frame.conjugate() / coupler
        changes |= {"coupler_point_x": own.real, "coupler_point_y": own.imag}
    others = [PhaseTable(), *(row for row in params.phases if row is not shown)]
    changes["phases"] = tuple(
        PhaseTable.model_construct(
            crank_turn=row.crank_turn - shown.crank_turn,
            follower_turn=row.follower_turn - shown.follower_turn,
        )
        for row in others
    )
    return params.model_copy(update=changes)


@kept
def phases_of(params: FourBarParams) -> tuple[FourBarParams, ...]:
    """All phases as designs, that of ``params`` first; ``params`` shows its first phase."""
    numbers = range(1, 2 + len(params.phases))
    return tuple(in_phase(params.model_copy(update={"phase": number})) for number in numbers)


def settings_of(params: FourBarParams) -> tuple[tuple[Setting, tuple[complex, ...]], ...]:
    """How A and B are set in the coupler, in its frame of phase 1, and their places in all phases, mm.

    ``params`` shows its first phase. Raises KinematicsError where the links cannot be joined in the pose of
    setting.
    """
    if not params.phases:
        return tuple(
            (Setting(name, (at,)), (at,)) for name, at in (("A", 0j), ("B", complex(params.coupler)))
        )
    start, clamp = _pose(params), clamp_of_design(params)
    rows = [_pivots(params, row, start) for row in (PhaseTable(), *params.phases)]
    origin, end = rows[0]
    turn = (end - origin).conjugate() / abs(end - origin)
    bore = turning_bore(params)
    width = clamp.width if clamp is not None else bore
    found = []
    for number, (name, centre) in enumerate((("A", 0j), ("B", pivot_b0(params)))):
        places = tuple((row[number] - origin) * turn for row in rows)
        one = setting(name, places, (centre - origin) * turn, bore, params.rim, width)
        found.append((one, places))
    return tuple(found)


@kept
def set_joints(params: FourBarParams) -> dict[str, Setting]:
    """The settings by name; with single holes where the pose of setting cannot be joined."""
    try:
        return {one.name: one for one, _ in settings_of(params)}
    except KinematicsError:
        return {one.name: one for one, _ in settings_of(params.model_copy(update={"phases": ()}))}


def slotted(params: FourBarParams, name: str) -> bool:
    """Whether joint A or B is clamped in a slot."""
    return set_joints(params)[name].slot is not None


def clamp_of_design(params: FourBarParams) -> Clamp | None:
    """The largest clamp for studs that reach from their heads through a link to the coupler, or None."""
    length = params.thickness + params.washer + HEAD_HEIGHT * params.pin_diameter
    return next(iter(clamps(params.pin_diameter, params.thickness, length)), None)


def spare_holes(params: FourBarParams) -> tuple[tuple[str, complex], ...]:
    """The other phases' holes in the coupler, A or B and its place in the coupler's frame, mm.

    ``params`` shows its first phase. None where the links cannot be joined in the pose of setting.
    """
    return tuple(
        (name, at) for name, one in set_joints(params).items() if one.slot is None for at in one.places[1:]
    )


def pose_angles(params: FourBarParams) -> tuple[float, float]:
    """Of crank and follower from X in the pose of setting, degrees."""
    b = _pose(params) - pivot_b0(params)
    return params.setting_angle or 0.0, math.degrees(cmath.phase(b))


def pivot_b0(params: FourBarParams) -> complex:
    """B0 from A0, x + i y, mm."""
    return cmath.rect(params.ground, math.radians(params.ground_angle))


def _pose(params: FourBarParams) -> complex:
    """B from A0 in phase 1 in the pose of setting, mm."""
    bar = FourBar(
        params.crank, params.coupler, params.follower, params.ground,
        math.radians(params.ground_angle), 1 if params.branch == "open" else -1,
    )  # fmt: skip
    b = complex(close(bar, math.radians(params.setting_angle or 0.0)).joint_b)
    if not cmath.isfinite(b):
        raise KinematicsError(
            "setting_angle: the links of phase 1 cannot be joined with the crank at "
            f"{params.setting_angle:g} degrees; set the machine where they can"
        )
    return b


def _pivots(params: FourBarParams, row: PhaseTable, b: complex) -> tuple[complex, complex]:
    """A and B of a phase from A0 in the pose of setting, mm."""
    a = cmath.rect(params.crank, math.radians((params.setting_angle or 0.0) + row.crank_turn))
    b0 = pivot_b0(params)
    return a, b0 + (b - b0) * cmath.rect(1.0, math.radians(row.follower_turn))
