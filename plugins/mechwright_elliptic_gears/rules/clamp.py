"""Checks of the clamp that sets the phase: its room, what it holds, and how well its scale is set."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Finding
from mechwright.contracts.finding import errors
from mechwright.mechanics.gearing.checks import LEAST_RIM
from mechwright.mechanics.strength.bolts import CLAMP_SAFETY
from mechwright.standards.screws import lengths
from mechwright.tolerances import falls_short
from mechwright_elliptic_gears.kinematics.equations import phase_offset
from mechwright_elliptic_gears.kinematics.joint_load import greatest_torque
from mechwright_elliptic_gears.parameters import EllipticGearParams, cap_screws
from mechwright_elliptic_gears.parts.clamp import (
    HEAD_GAP,
    LETTER,
    SETTING,
    clamp_of,
    least_thread,
    mark_of,
)
from mechwright_elliptic_gears.parts.clamp_parts import scale_reach
from mechwright_elliptic_gears.parts.gear import rack_of, room
from mechwright_elliptic_gears.parts.layout import SPACER, Layout
from mechwright_elliptic_gears.rules.pins import rounded_down, window_note


def clamp_findings(params: EllipticGearParams) -> Iterator[Finding]:
    """Room for the clamp, room for its scale, torque, and the setting."""
    layout = Layout.of(params)
    found = list(_room(params, layout)) or list(_length(params))
    yield from found
    if errors(found):
        return
    yield from _torque(params)
    clamp, phase = clamp_of(params), params.phase_degrees
    turn = math.degrees(phase_offset(params.phase_angle or 0.0, params.eccentricity)) % 360
    table = ", ".join(
        f"{one:g} at {math.degrees(phase_offset(math.radians(one), params.eccentricity)):.3f}"
        for one in params.set_phases
    )
    yield Finding.note(
        "train.phase",
        f"{clamp.screws} screws M{clamp.screw:g} clamp gear 4 {turn:.3f} degrees ahead of gear 3, for a "
        f"phase of {phase:g}; marks of the scale, in degrees of the joint: {table}",
        turn,
        "deg",
    )


def setting_note(params: EllipticGearParams) -> Finding:
    """What a mark that is set wrong does to the window."""
    return window_note(params, SETTING / clamp_of(params).scale, f"a mark that is set {SETTING:g} mm wrong")


def _length(params: EllipticGearParams) -> Iterator[Finding]:
    """A screw that is sold goes through the clamp and finds enough thread in gear 3."""
    clamp, t = clamp_of(params), params.thickness
    if clamp.length is not None:
        return
    others = [params.model_copy(update={"clamp_screw": size}) for size in cap_screws()]
    fitting = [
        clamp_of(one).screw
        for one in others
        if clamp_of(one).length is not None and not any(_room(one, Layout.of(one)))
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


def _room(params: EllipticGearParams, layout: Layout) -> Iterator[Finding]:
    """Rim of gear 4 round its register, the joint beside it, and a face for the scale."""
    clamp, module = clamp_of(params), rack_of(params).module
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


def _torque(params: EllipticGearParams) -> Iterator[Finding]:
    """Friction against inertia at the worst of all phases."""
    clamp = clamp_of(params)
    holds = clamp.torque(params.material)
    phases = {*params.set_phases, params.phase_degrees}
    worst = max(sorted(phases), key=lambda phase: greatest_torque(params, phase).value)
    needed = CLAMP_SAFETY * greatest_torque(params, worst).value
    words = (
        f"{clamp.screws} screws M{clamp.screw:g}, tightened with {clamp.tightening(params.material):.2g} N m "
        f"to {clamp.preload(params.material):.0f} N, hold {holds:.3g} N m; at a phase of "
        f"{worst:g} degrees inertia takes {needed / CLAMP_SAFETY:.3g} N m"
    )
    if needed <= holds:
        yield Finding.note("train.clamp-torque", words, holds, "N m")
        return
    most = rounded_down(params.speed * math.sqrt(holds / needed))
    yield Finding.error(
        "train.clamp-torque",
        "speed",
        f"{words}, and a margin of {CLAMP_SAFETY:g} is due",
        params.speed,
        most,
        "rev/min",
        f"make speed at most {most:g}, or clamp_screw or clamp_screws larger",
        proposed=({"parameters.speed": most},),
    )
