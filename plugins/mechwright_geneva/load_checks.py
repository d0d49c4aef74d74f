"""Checks of motion and load: peaks against the straight slot, pressure, the middle position."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mechwright import Finding, Severity
from mechwright.tolerances import exceeds
from mechwright_geneva.contact import loads, strength
from mechwright_geneva.cures import walls_of
from mechwright_geneva.figures import peaks_of, straight_peaks
from mechwright_geneva.horns import clear
from mechwright_geneva.mechanism import Mechanism
from mechwright_geneva.params import GenevaParams
from mechwright_geneva.sound import LEAST_BITE, sound
from mechwright_geneva.stud_checks import stud_findings
from mechwright_geneva.walls import switches


def load_findings(m: Mechanism) -> Iterator[Finding]:
    """Warnings about motion and load, then the figures."""
    yield from _loaded(m)
    yield from stud_findings(m)
    yield _walls(m)


def load_judged(m: Mechanism) -> Iterator[Finding]:
    """The same without the sizes that would bear a load, and without the changes of walls."""
    yield from _loaded(m)
    yield from stud_findings(m, advise=False)


def _loaded(m: Mechanism) -> Iterator[Finding]:
    if not m.straight:
        yield from _against_straight(m)
        yield from _middle(m)
        yield from _ramp(m)
    yield from _pressure(m)


def _against_straight(m: Mechanism) -> Iterator[Finding]:
    own, straight = peaks_of(m), straight_peaks(m.slots)
    if exceeds(own.a, straight.a):
        half = math.ceil(10 * math.degrees(m.crank_half * math.sqrt(own.a / straight.a))) / 10
        longer = f"make crank_half_angle at least {half:g}, " if _turns_by(m, math.radians(half)) else ""
        yield Finding(
            "geneva.acceleration",
            Severity.NOTE if _chosen(m) else Severity.WARNING,
            "law",
            f"the wheel accelerates more than with {m.slots} straight slots: {own.a:.4g} against "
            f"{straight.a:.4g} per crank speed squared (the straight slot jerks at its ends instead)",
            own.a,
            straight.a,
            remedy=f"{longer}choose a law with a lower peak, or accept it for the sake of the jerk",
        )
    if abs(m.law.jumps[0]) > _JUMP or abs(m.law.jumps[1]) > _JUMP:
        yield Finding.warning(
            "geneva.jump",
            "law",
            f"{m.law.name} starts or ends with a jump of the acceleration: an impact in every stroke",
            max(abs(jump) for jump in m.law.jumps),
            0.0,
            remedy="choose a law whose acceleration is 0 at both ends",
        )


def _chosen(m: Mechanism) -> bool:
    """Whether law and angles are those of a design that says nothing of them: nobody is warned of these."""
    usual = m.params.law == GenevaParams.model_fields["law"].default
    return usual and "crank_half_angle" in m.params.left_out


def _turns_by(m: Mechanism, half: float) -> bool:
    """Whether the slots are sound, and a disc locks the wheel, with another half angle of the crank."""
    wanted = (m.law, m.wheel_half, [half], float(m.frame.offset), m.rim, m.groove, walls_of(m))
    if math.degrees(float(m.frame.entry_angle) + half / 2) > 89 or not sound(*wanted).all():
        return False
    frame = replace(m.frame, crank_half=np.asarray(half))
    least = float(frame.axes) - m.rim + LEAST_BITE - m.params.lock_clearance
    return bool(clear(frame, m.law, np.array([least]), m.params.lock_clearance).all())


_JUMP = 1e-3
"""End acceleration d²s/du² that is not the rounding of a table: below a thousandth of a usual peak."""


def _middle(m: Mechanism) -> Iterator[Finding]:
    params = m.params
    if params.load_torque == 0:
        return
    strokes = m.strokes if m.driver.varies else m.strokes[:1]
    middles = m.driver.at(m.crank_half + m.pitch * np.array(strokes, dtype=float))
    omega = float(np.abs(middles.omega).min())
    work = params.load_torque * loads(m).carried
    energy = params.load_inertia * (m.wheel_half / m.crank_half * float(m.law.at(0.5).v) * omega) ** 2 / 2
    stalls = work >= energy
    lost = 1.0 if stalls else 1 - math.sqrt(1 - work / energy)
    least = omega * math.sqrt(work / energy) * 60 / math.tau if energy > 0 else None
    yield Finding(
        "geneva.singular",
        Severity.ERROR if stalls else Severity.WARNING,
        "load_torque",
        f"at mid stroke, {math.degrees(m.crank_half):g} degrees of the crank, the roller cannot turn "
        f"the wheel: its own inertia carries {params.load_torque:g} N·m over "
        f"{math.degrees(loads(m).carried):.2f} degrees and "
        + ("stops there" if stalls else f"loses {100 * lost:.3g} % of its speed"),
        work * 1e3,
        energy * 1e3,
        "mJ",
        f"run {'above' if not m.driver.varies else 'there above'} {math.ceil(least):g} rev/min, raise "
        "load_inertia, or use straight slots"
        if stalls and least is not None
        else "raise load_inertia, or use straight slots where a torque has to be held at every instant",
    )


def _ramp(m: Mechanism) -> Iterator[Finding]:
    """An acceleration of the driver in the middle of a stroke, which the roller cannot give to the wheel."""
    strokes = m.strokes if m.driver.varies else m.strokes[:1]
    middles = m.driver.at(m.crank_half + m.pitch * np.array(strokes, dtype=float))
    ratio = m.wheel_half / m.crank_half * float(m.law.at(0.5).v)
    worst = int(np.argmax(np.abs(middles.alpha)))
    alpha = float(middles.alpha[worst])
    if abs(alpha) * ratio <= _STEADY * float(middles.omega[worst]) ** 2 or m.params.load_inertia == 0:
        return
    moment = m.params.load_inertia * ratio * abs(alpha)
    yield Finding.warning(
        "geneva.ramp",
        "driver_law",
        f"the driver accelerates by {alpha:.4g} rad/s^2 in the middle of a stroke, where the roller cannot "
        f"turn "
        f"the wheel: {moment:.4g} N·m are missing, and the wheel coasts through the clearance",
        moment,
        0.0,
        "N*m",
        "have the driver reach its speed while the wheel rests; at constant speed the wheel needs no torque "
        "there",
    )


_STEADY = 1e-6
"""Acceleration of the driver over the square of its speed that is rounding."""

_NAMED = 6
"""Changes of walls that a finding names; summary.json has all."""


def _walls(m: Mechanism) -> Finding:
    found = switches(m)
    if not found:
        wall = "one wall, the same on the way back," if not m.straight else "one wall"
        return Finding.note("geneva.walls", f"{wall} carries all of the stroke", 0.0)
    said = []
    for one in found[:_NAMED]:
        met = "which it does not come to" if one.impact is None else f"met with {one.impact:.3g} mm/s"
        said.append(
            f"{math.degrees(one.theta):.4f} degrees at {abs(one.omega) * 60 / math.tau:.4g} rev/min to the "
            f"{one.wall} wall, {met}"
        )
    more = f", and {len(found) - _NAMED} more" if len(found) > _NAMED else ""
    return Finding.note(
        "geneva.walls",
        f"the roller changes walls across {m.params.groove_clearance:g} mm at {'; '.join(said)}{more}",
        float(len(found)),
    )


def _pressure(m: Mechanism) -> Iterator[Finding]:
    load, limit = loads(m), strength(m.params.material, m.params.roller_material)
    if exceeds(load.pressure, limit):
        yield Finding.warning(
            "geneva.pressure",
            "load_inertia",
            f"the Hertz pressure reaches {load.pressure:.0f} MPa at "
            f"{math.degrees(load.pressure_at):.1f} degrees of the crank; {m.params.material} on "
            f"{m.params.roller_material} yields from {limit:.0f} MPa",
            load.pressure,
            limit,
            "MPa",
            "use a stronger material, a longer roller or a lower speed",
        )
    carrier = "the straight wall" if m.straight else ("the islands" if load.island else "the hub's side")
    steep = (
        "" if m.straight else f"; over {math.degrees(load.steep):.1f} degrees the pressure angle is above 45"
    )
    yield Finding.note(
        "geneva.contact",
        f"greatest contact force {load.force:.4g} N at {math.degrees(load.force_at):.2f} degrees of "
        f"the crank, on {carrier}; Hertz pressure {load.pressure:.4g} MPa, crank torque "
        f"{load.crank_torque:.4g} N·m{steep}",
        load.force,
        "N",
    )
