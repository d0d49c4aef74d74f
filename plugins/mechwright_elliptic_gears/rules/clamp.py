"""Rules of the clamp that sets the phase: its room, what it holds, and how well its scale is set."""

import math
from collections.abc import Callable, Iterator

import numpy as np

from mechwright import Finding, Stage, at_stage
from mechwright.contracts.design_rule import DesignRule
from mechwright.contracts.design_table import by_row
from mechwright.contracts.procedure import Note, Procedure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.gearing.checks import LEAST_RIM
from mechwright.mechanics.strength.bolts import CLAMP_SAFETY
from mechwright.standards.screws import lengths
from mechwright.tolerances import falls_short
from mechwright_elliptic_gears.kinematics.equations import phase_offset
from mechwright_elliptic_gears.kinematics.joint_load import greatest_torque
from mechwright_elliptic_gears.parameters import EllipticGearParams, cap_screws
from mechwright_elliptic_gears.parts.clamp import HEAD_GAP, LETTER, SETTING, clamp_of, least_thread, mark_of
from mechwright_elliptic_gears.parts.clamp_parts import scale_reach
from mechwright_elliptic_gears.parts.gear import rack_of, room
from mechwright_elliptic_gears.parts.layout import SPACER, layout_of
from mechwright_elliptic_gears.rules.pins import ahead, slower, window_note
from mechwright_elliptic_gears.table import GearTable


def _no_length(params: EllipticGearParams) -> Iterator[Finding]:
    """A screw that is sold goes through the clamp and finds enough thread in gear 3."""
    clamp, t = clamp_of(params), params.thickness
    if clamp.length is not None:
        return
    others = [params.model_copy(update={"clamp_screw": size}) for size in cap_screws()]
    fitting = [
        clamp_of(one).screw for one in others if clamp_of(one).length is not None and not any(_room(one))
    ]
    better = min(fitting, key=lambda size: abs(size - clamp.screw), default=None)
    bites, grip = least_thread(params, clamp.screw), clamp.ring + t + params.spacing
    if bites > t:
        words, value, limit, key = (
            f"gear 3 is {t:g} mm thick: M{clamp.screw:g} needs {bites:g} mm of thread",
            t,
            bites,
            "thickness",
        )
    else:
        longest = lengths(clamp.screw)[-1]
        words = f"the longest screw M{clamp.screw:g} is {longest} mm; {grip + bites:g} mm are needed"
        value, limit, key = grip + bites, float(longest), "clamp_screw"
    yield Finding.error(
        "train.clamp-length",
        key,
        words,
        value,
        limit,
        "mm",
        ("" if better is None else f"set clamp_screw = {better:g}, or ")
        + ("make thickness larger" if key == "thickness" else "make thickness or gap smaller"),
        proposed=() if better is None else ({"parameters.clamp_screw": better},),
    )


def _room(params: EllipticGearParams) -> Iterator[Finding]:
    """Rim of gear 4 round its register, the joint beside it, and a face for the scale."""
    clamp, module, layout = clamp_of(params), rack_of(params).module, layout_of(params)
    rim = room(params, np.zeros((1, 2))) - clamp.register
    beside = layout.focus - SPACER * layout.pin / 2 - clamp.outside
    for left, due, what in (
        (rim, LEAST_RIM * module, f"a register of {2 * clamp.register:g} mm and the nearest root of gear 4"),
        (beside, HEAD_GAP, f"a ring of {2 * clamp.outside:g} mm and the spacer of joint J"),
    ):
        if falls_short(left, due):
            yield Finding.error(
                "train.clamp",
                "clamp_screw",
                f"{left:.2f} mm stay between {what}, below {due:.2f} mm",
                left,
                due,
                "mm",
                "make clamp_screw, clamp_screws or bore smaller, or the gears larger",
            )
            return
    reach = scale_reach(params)
    free = layout.focus - SPACER * layout.pin / 2 - HEAD_GAP
    for phase in params.set_phases:
        angle = mark_of(phase, params.eccentricity)
        end = reach * np.array([[math.cos(angle), math.sin(angle)]])
        blocked = reach > free and abs(math.sin(angle)) * free < LETTER * 1.5 and math.cos(angle) > 0
        if room(params, end) < HEAD_GAP or blocked:
            yield Finding.error(
                "train.clamp",
                "phases",
                f"the scale has no room for a mark of {phase:g} degrees, {reach:.1f} mm from the axis",
                phase,
                unit="deg",
                remedy="leave that phase out, or make clamp_screw or bore smaller, or the gears larger",
                proposed=({"parameters.phases": [one for one in params.set_phases if one != phase]},),
            )
            return


def _needed(params: EllipticGearParams) -> tuple[float, float]:
    """The worst of all phases, degrees, and the torque that inertia takes there with a margin, N m."""
    phases = sorted({*params.set_phases, params.phase_degrees})
    worst = max(phases, key=lambda phase: greatest_torque(params, phase).value)
    return worst, CLAMP_SAFETY * greatest_torque(params, worst).value


def _holds(m: GearTable) -> float:
    """By friction, N m."""
    return clamp_of(m.given).torque(m.given.material)


def _torques(m: GearTable) -> str:
    clamp, own = clamp_of(m.given), m.given.material
    worst, needed = _needed(m.given)
    return (
        f"{clamp.screws} screws M{clamp.screw:g}, tightened with {clamp.tightening(own):.2g} N m to "
        f"{clamp.preload(own):.0f} N, hold {_holds(m):.3g} N m; at a phase of {worst:g} degrees inertia "
        f"takes {needed / CLAMP_SAFETY:.3g} N m"
    )


def _used(m: GearTable) -> float:
    """Share of what the clamp holds."""
    return _needed(m.given)[1] / _holds(m)


TORQUE = DesignRule[GearTable](
    "train.clamp-torque",
    "speed",
    lambda f: f"{_torques(f.m)}, and a margin of {CLAMP_SAFETY:g} is due",
    value=by_row(_used),
    limit=1.0,
    unit="rev/min",
    remedy=lambda f: f"make speed at most {slower(f):g}, or clamp_screw or clamp_screws larger",
    must_be="at most",
    reported=lambda f: (f.m.given.speed, slower(f)),
    proposed=lambda f: ({"parameters.speed": slower(f)},),
)


def _marks(m: GearTable) -> str:
    params, clamp = m.given, clamp_of(m.given)
    table = ", ".join(
        f"{one:g} at {math.degrees(phase_offset(math.radians(one), params.eccentricity)):.3f}"
        for one in params.set_phases
    )
    return (
        f"{clamp.screws} screws M{clamp.screw:g} clamp gear 4 {ahead(m):.3f} degrees ahead of gear 3, for a "
        f"phase of {params.phase_degrees:g}; marks of the scale, in degrees of the joint: {table}"
    )


def _procedure(code: str, find: Callable[[EllipticGearParams], Iterator[Finding]]) -> Procedure[GearTable]:
    return Procedure((code,), lambda m: at_stage(Stage.PARTS, find(m.given)), stage=Stage.PARTS)


CLAMP = in_turn(
    _procedure("train.clamp", _room),
    _procedure("train.clamp-length", _no_length),
    all_of(
        TORQUE,
        Note[GearTable]("train.clamp-torque", _torques, _holds, "N m", when=lambda m: _used(m) <= 1),
        Note[GearTable]("train.phase", _marks, ahead, "deg"),
    ),
    window_note(
        lambda m: SETTING / clamp_of(m.given).scale, lambda _: f"a mark that is set {SETTING:g} mm wrong"
    ),
)
"""Room for the clamp and for its scale, torque, and the setting."""
