"""A four-bar that is set to several phases: its coupler has a hole for each pivot of each phase.

In the pose of setting the coupler is held, the crank turns about A0 and the follower about B0 to the holes of
the next phase. Crank, follower and ground are the same in all phases, and so is the coupler as a plate: only
which of its holes are A and B changes.
"""

import cmath
import math
from collections.abc import Iterator

from mechwright import Finding, KinematicsError, Severity, Stage, kept
from mechwright.mechanics.linkage import Boss
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.loop import close
from mechwright_four_bar.params import FourBarParams, PhaseTable

SAME_HOLE = 0.01
"""mm. Pivots nearer to each other are one hole: no drill places them apart."""


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
def spare_holes(params: FourBarParams) -> tuple[tuple[str, complex], ...]:
    """The other phases' holes in the coupler, A or B and its place in the coupler's frame, mm.

    ``params`` shows its first phase. None where the links cannot be joined in the pose of setting.
    """
    if not params.phases:
        return ()
    try:
        start = _pose(params)
    except KinematicsError:
        return ()
    origin, end = _pivots(params, PhaseTable(), start)
    turn = (end - origin).conjugate() / abs(end - origin)
    found: list[tuple[str, complex]] = [("A", 0j), ("B", complex(params.coupler))]
    for row in params.phases:
        for name, pivot in zip("AB", _pivots(params, row, start), strict=True):
            at = (pivot - origin) * turn
            if all(name != other or abs(at - place) > SAME_HOLE for other, place in found):
                found.append((name, at))
    return tuple(found[2:])


def setting_findings(params: FourBarParams) -> Iterator[Finding]:
    """Whether the machine can be set, and how; ``params`` as the design has them."""
    if not params.phases:
        return
    try:
        _pose(params)
    except KinematicsError as error:
        said, _, remedy = str(error).partition("; ")
        yield Finding.error(
            "four-bar.setting", "setting_angle", said.partition(": ")[2], params.setting_angle, unit="deg",
            remedy=remedy,
        )  # fmt: skip
        return
    a, b = params.crank, params.follower
    for number, row in enumerate(params.phases, start=2):
        yield Finding(
            "four-bar.setting",
            Severity.NOTE,
            "phases",
            f"phase {number}: turn the crank to {params.setting_angle:.6g} degrees in phase 1 and pin the "
            f"coupler to the ground; free A, turn the crank by {row.crank_turn:+.6g} degrees and fasten A; "
            f"free B, turn the follower by {row.follower_turn:+.6g} degrees and fasten B; draw the pins. The "
            f"holes are {_chord(a, row.crank_turn):.4g} mm (A) and {_chord(b, row.follower_turn):.4g} mm (B) "
            "from those of phase 1",
            stage=Stage.PARTS,
        )


def in_one_place(params: FourBarParams, one: Boss, two: Boss, distance: float, needed: float) -> Finding:
    """Holes of two phases that run into each other."""
    pins = params.pin_diameter - (needed - distance) - 1e-3
    remedy = f"take pins of at most {math.floor(pins * 10) / 10:g} mm, or smaller bushings or rims"
    if pins < 1:
        remedy = "turn crank and follower farther between the phases, or set the machine in another pose"
    return Finding.error(
        "four-bar.phases",
        "phases",
        f"the phases need pivots in one place: {one.tag[0]} and {two.tag[0]} of two of them are "
        f"{distance:.4g} mm apart in the coupler, and bores and rim need {needed:.4g} mm"
        if "coupler-point" not in (one.tag, two.tag)
        else f"a pivot of one of the phases is {distance:.4g} mm from the coupler point, and bores and rim "
        f"need {needed:.4g} mm",
        distance,
        needed,
        "mm",
        remedy,
    )


def _chord(radius: float, degrees: float) -> float:
    return 2 * radius * abs(math.sin(math.radians(degrees) / 2))


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
