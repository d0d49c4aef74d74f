"""Strength and life of what a frame adds, with the torque and the size that work.

The peak torque of the input acts as if it came with either sign, and the force on a hub as if it turned with
its shaft: so the shaft is bent and twisted to and fro. Weights of the parts are left out.
"""

import math
from collections.abc import Iterator

from mechwright.contracts.finding import Change, Finding, Stage
from mechwright.contracts.mounting import Spindle
from mechwright.machine.frame.decided import Frame, Wanted
from mechwright.machine.frame.seats import Seat
from mechwright.machine.frame.shafts import AxialLocation, Levels, key_of, sections
from mechwright.mechanics.strength.allowed import REVERSING_KEY, allowed
from mechwright.mechanics.strength.beam import BALL_SLOPE, SteppedShaft
from mechwright.mechanics.strength.bearings_life import STATIC_SAFETY, life, static_load
from mechwright.mechanics.strength.fastening import LONGEST_KEY, key_pressure, press_fit_torque
from mechwright.mechanics.strength.shaft import (
    KEY_SEAT,
    SAFE,
    Load,
    Notch,
    endurance_limit,
    goodman_safety,
)
from mechwright.standards.circlips import shaft_circlips

TENSILE = 600.0
"""Tensile strength of the shafts' steel, MPa: C45 or S355, a handbook figure."""

BOND, BOND_SAFETY = 10.0, 2.0
"""Shear strength of a retaining compound between steel and aluminium, MPa, half of what makers print, and the
safety against the peak torque."""


def strength(frame: Frame, wanted: Wanted) -> Iterator[Finding]:
    """Of every spindle: bearings, shaft, and what joins the hub to it."""
    for seat in frame.seats:
        spindle = seat.spindle
        torque, force = spindle.torque * wanted.torque, spindle.force * wanted.torque
        near, far, bending, slope = bent(seat, frame.levels, force)
        load = static_load(max(near, far))
        hours = life(seat.bearing.dynamic, max(near, far), wanted.speed)
        safety = goodman(seat, bending, torque)
        yield Finding.note(
            f"frame.shaft-{spindle.name}",
            f"shaft {spindle.name}: {seat.bearing.name} above and below, up to {max(near, far):.3g} N each, "
            f"{_hours(hours)}; up to {torque:.3g} N·m, safety against fatigue {_factor(safety)}; slope in "
            f"the bearings up to {1e6 * slope:.0f} µrad",
            safety if math.isfinite(safety) else None,
        )
        if load * STATIC_SAFETY > seat.bearing.static:
            yield _weak_bearing(seat, load)
        if safety < SAFE:
            yield _weak_shaft(spindle, safety, torque)
        if slope > BALL_SLOPE:
            yield _steep(spindle, slope)
        yield from _joint(spindle, torque)


def bent(seat: Seat, levels: Levels, force: float) -> tuple[float, float, float, float]:
    """Forces in both bearings, N, the bending moment under the hub, N m, and the greatest slope in a bearing.

    The force acts in the middle of the hub.
    """
    steps, held, hub = sections(seat, levels), AxialLocation.of(seat, levels), seat.spindle.hub
    foot, half = held.foot(None), seat.bearing.width / 2
    shaft = SteppedShaft(
        tuple((step.diameter, step.length) for step in steps),
        held.lower - foot + half,
        held.upper - foot + half,
    )
    at = (hub.low + hub.high) / 2 - foot
    loads = [(at, force)]
    near, far = shaft.reactions(loads)
    slope = max(abs(shaft.slope(loads, shaft.near)), abs(shaft.slope(loads, shaft.far)))
    return abs(near), abs(far), abs(shaft.moment(loads, at)) / 1000, slope


def goodman(seat: Seat, bending: float, torque: float) -> float:
    """Safety of the hub's seat against fatigue."""
    hub = seat.spindle.hub
    notch = KEY_SEAT if hub.key else Notch()
    return goodman_safety(hub.bore, Load(bending, torque), endurance_limit(TENSILE, hub.bore), TENSILE, notch)


def _larger(spindle: Spindle, least: float) -> tuple[str, tuple[Change, ...]]:
    """The bore that works, as words and as changes."""
    able = [one.size for one in shaft_circlips() if one.size >= least]
    if not able or not spindle.bore_key:
        return "take a larger bore, or load it less", ()
    return f"make it {able[0]:g}, or load it less", ({spindle.bore_key: able[0]},)


def _weak_bearing(seat: Seat, load: float) -> Finding:
    spindle, most = seat.spindle, seat.bearing.static / STATIC_SAFETY
    remedy, proposed = _larger(spindle, spindle.hub.bore + 1)
    return Finding.error(
        "frame.bearing-load",
        spindle.bore_key,
        f"bearing {seat.bearing.name} of spindle {spindle.name} carries {load:.0f} N; with a static safety "
        f"of {STATIC_SAFETY:g} it may carry {most:.0f} N",
        load,
        most,
        "N",
        remedy,
        Stage.PARTS,
        ({"machine.bearing": "62"}, *proposed),
    )


def _weak_shaft(spindle: Spindle, safety: float, torque: float) -> Finding:
    remedy, proposed = _larger(spindle, spindle.hub.bore * math.cbrt(SAFE / safety))
    return Finding.error(
        "frame.shaft-fatigue",
        spindle.bore_key,
        f"the shaft of spindle {spindle.name}, {spindle.hub.bore:g} mm, has a safety of {safety:.2f} against "
        f"fatigue; {torque * safety / SAFE:.3g} N·m of its {torque:.3g} N·m would leave {SAFE:g}",
        safety,
        SAFE,
        "",
        remedy,
        Stage.PARTS,
        proposed,
    )


def _steep(spindle: Spindle, slope: float) -> Finding:
    return Finding.warning(
        "frame.shaft-slope",
        spindle.bore_key,
        f"the shaft of spindle {spindle.name} leans by {1e6 * slope:.0f} µrad in a bearing; ball bearings "
        f"take {1e6 * BALL_SLOPE:.0f}",
        1e6 * slope,
        1e6 * BALL_SLOPE,
        "",
        "take a larger bore, or load it less",
        Stage.PARTS,
    )


def _joint(spindle: Spindle, torque: float) -> Iterator[Finding]:
    """The key of a hub, or the compound that holds one without."""
    hub = spindle.hub
    key = key_of(hub)
    if key is None:
        yield from _bonded(spindle, torque)
        return
    length = min(key.bears, LONGEST_KEY * hub.bore)
    proud = key.size.height - key.size.shaft_depth
    pressure = key_pressure(torque, hub.bore, proud, length) if torque else 0.0
    most = REVERSING_KEY * allowed(hub.material).key
    if pressure > most:
        remedy, proposed = _larger(spindle, hub.bore + 1)
        yield Finding.error(
            "frame.key-pressure",
            spindle.bore_key,
            f"the key of spindle {spindle.name} presses on {hub.material} with {pressure:.0f} MPa; {most:.0f}"
            f" MPa are allowed of a torque that reverses: {torque * most / pressure:.3g} N·m of {torque:.3g}",
            pressure,
            most,
            "MPa",
            remedy,
            Stage.PARTS,
            proposed,
        )


def _bonded(spindle: Spindle, torque: float) -> Iterator[Finding]:
    hub = spindle.hub
    # A bond carries τ π d l (d/2), as a press fit of the same friction does.
    most = press_fit_torque(BOND, hub.bore, hub.grip, 1.0) / BOND_SAFETY
    if torque > most:
        remedy, proposed = _larger(spindle, hub.bore * math.sqrt(torque / most))
        yield Finding.error(
            "frame.bond",
            spindle.bore_key,
            f"the hub of spindle {spindle.name} has no keyway, and retaining compound holds {most:.3g} N·m "
            f"of {torque:.3g} N·m",
            torque,
            most,
            "N*m",
            remedy,
            Stage.PARTS,
            proposed,
        )
        return
    yield Finding.note(
        f"frame.bond-{spindle.name}",
        f"the hub of spindle {spindle.name} has no keyway: retaining compound holds it on its shaft, up to "
        f"{most:.3g} N·m",
        most,
        "N*m",
    )


def _hours(hours: float) -> str:
    return "no load" if math.isinf(hours) else f"L10 {hours:.2g} h" if hours < 1e6 else "L10 above 1e6 h"


def _factor(safety: float) -> str:
    return "without a load" if math.isinf(safety) else f"{safety:.3g}" if safety < 100 else "above 100"
