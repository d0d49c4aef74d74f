"""Whether the links can be joined, stay assembled, and lead the path point where it is prescribed."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Array, Finding, Procedure, Severity, Stage, in_turn
from mechwright.contracts.finding import Change
from mechwright.contracts.rule_list import OneByOne
from mechwright.mechanics.planar import Turning, swing
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright.tolerances import exceeds, falls_short
from mechwright_spherical.kinematics.linkage import Phase, PinError
from mechwright_spherical.kinematics.mobility import input_range, input_ways, kind
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.places import second_size
from mechwright_spherical.table import SphericalTable

DEAD_CENTRE = math.degrees(TURN_BACK)
"""Transmission angle, degrees, below which a linkage counts as standing in a dead centre."""

SAMPLES = 1441
"""Input angles at which a travel is looked at before the lowest one is looked at closely: each half degree of
two turns."""


def _pins(m: SphericalTable) -> Iterator[Finding]:
    try:
        _ = m.linkage
    except PinError as fault:
        yield fault.finding


def key_of(params: SphericalParams, phase: Phase, name: str) -> str:
    """The parameter of that name for a phase; of further phases the list that has it."""
    if params.kind == "four-bar":
        return f"four_bar.{name}" if phase.number == 1 else "four_bar.phases"
    return {1: f"five_bar.{name}", 2: f"five_bar.{name}_n"}.get(phase.number, "five_bar.phases")


def transmission_sine(phase: Phase, angles: Array) -> Array:
    """Sine of the transmission angle (n,) at input angles, continued below 0 where it cannot be assembled.

    The radicand of the closed form is the square of C's height over A and B; height times base is also
    the product of both arcs' sines and the transmission angle's.
    """
    loop = phase.loop
    state = loop.at(Turning.of(angles), 0)
    mu = state.transmission
    room = loop.room(angles)
    return np.asarray(np.where(np.isfinite(mu), np.sin(mu), np.minimum(room, 0.0)))


def weakest(phase: Phase) -> tuple[float, float]:
    """Input angle, rad, with the worst transmission angle, and its sine; below 0: it comes apart."""
    angles = phase.sweep(SAMPLES)
    for _ in range(2):
        values = transmission_sine(phase, angles)
        low = int(np.argmin(values))
        at, value = float(angles[low]), float(values[low])
        angles = np.linspace(angles[max(low - 1, 0)], angles[min(low + 1, len(angles) - 1)], SAMPLES)
    return at, value


def least_transmission(phase: Phase) -> float:
    """The worst transmission angle, rad; 0 where the linkage comes apart."""
    return math.asin(min(1.0, max(0.0, weakest(phase)[1])))


def _assembly(m: SphericalTable) -> Iterator[Finding]:
    params, linkage = m.params, m.linkage
    for phase in linkage.phases:
        at, sine = weakest(phase)
        where = f"at the input angle {math.degrees(at):.4g}°"
        if len(linkage.phases) > 1:
            where += f" of phase {phase.number}"
        if phase.rocks:
            yield _lever(params, phase)
        if falls_short(sine, math.sin(math.radians(DEAD_CENTRE))):
            yield _apart(params, phase, at, sine, where)
        elif falls_short(worst := math.degrees(math.asin(sine)), params.least_transmission):
            yield Finding.warning(
                "spherical.transmission",
                key_of(params, phase, "travel"),
                f"the transmission angle falls to {worst:.4g}° or {180 - worst:.4g}° {where}",
                worst,
                params.least_transmission,
                "deg",
                "shorten the travel, or choose another four_bar.coupler or four_bar.output"
                if phase.four_bar is not None
                else "shorten the travel, or choose other pins",
                Stage.PARTS,
                tuple(_shorter(phase, params.least_transmission)),
            )


def _shorter(phase: Phase, least: float) -> Iterator[Change]:
    """As much of what the input of a four-bar goes as keeps a transmission angle, degrees; of a turn none."""
    if phase.four_bar is None or phase.number > 1 or abs(phase.travel) >= math.tau - ON_TRAVEL:
        return
    low, high = sorted((phase.start, phase.start + phase.travel))
    middle = (low + high) / 2
    for way in input_ways(*phase.four_bar.arcs, math.radians(least)):
        first, last = swing.beside(way, middle, math.tau)
        one, two = (math.degrees(end) * 10 for end in (max(first, low), min(last, high)))
        one, two = math.ceil(one) / 10, math.floor(two) / 10
        if two - one >= swing.LEAST:
            start, end = (one, two) if phase.travel > 0 else (two, one)
            yield {"parameters.four_bar.start": start, "parameters.four_bar.travel": round(end - start, 1)}


def _lever(params: SphericalParams, phase: Phase) -> Finding:
    low, high = (math.degrees(end) for end in (phase.start, phase.start + phase.travel))
    return Finding.warning(
        "spherical.lever",
        "four_bar.travel",
        f"the input cannot turn fully: it is a lever that swings from {low:.3f}° to {high:.3f}° and back",
        high - low,
        360.0,
        "deg",
        "say how far it goes with four_bar.start and four_bar.travel inside these, or choose other arcs",
        proposed=(
            *_shorter(phase, params.least_transmission),
            *_shorter(phase, math.degrees(TURN_BACK)),
        ),
    )


_NO_FOUR_BAR = "make the longest arc shorter than the others together, and all four less than 360° together"


def _apart(params: SphericalParams, phase: Phase, at: float, sine: float, where: str) -> Finding:
    fault = "it cannot be assembled" if sine < 0 else "it stands in a dead centre"
    reach = _reach(phase)
    four = phase.four_bar
    if four is not None:
        ranges = input_range(*four.arcs)
        said = ", ".join(
            f"{round(math.degrees(a), 2):g}° to {round(math.degrees(b), 2):g}°" for a, b in ranges
        )
        remedy = f"leave travel out, or keep start + travel inside {said}" if said else _NO_FOUR_BAR
    else:
        remedy = f"end at less than {reach:.4g}°, or choose other pins"
    return Finding.error(
        "spherical.assembly",
        key_of(params, phase, "travel"),
        f"{fault} {where}",
        math.degrees(at),
        reach,
        "deg",
        remedy,
        Stage.MOTION if sine < 0 else Stage.PARTS,
        tuple(_shorter(phase, DEAD_CENTRE)),
    )


def _reach(phase: Phase) -> float:
    """How far the phase gets before its dead centre, degrees, to the fineness of the samples."""
    angles = phase.sweep(SAMPLES)
    good = transmission_sine(phase, angles) > math.sin(math.radians(DEAD_CENTRE))
    first = int(np.argmin(good)) if not good.all() else len(angles)
    return math.degrees(float(angles[max(first - 1, 0)]))


def _path(m: SphericalTable) -> Iterator[Finding]:
    params = m.params
    for phase in m.linkage.phases:
        if not phase.target_angles.size:
            continue
        key, keys = key_of(params, phase, "path"), key_of(params, phase, "path_angles")
        yield from _order(phase, keys)
        misses = params.radius * phase.path_errors
        if not np.isfinite(misses).all():
            bad = math.degrees(float(phase.target_angles[np.argmin(np.isfinite(misses))]))
            yield Finding.error(
                "spherical.assembly",
                keys,
                f"the linkage cannot be assembled at the path angle {bad:.4g}°",
                bad,
                _reach(phase),
                "deg",
                "take the point out, or choose other pins",
                Stage.PARTS,
            )
            continue
        worst, rms = float(misses.max()), float(np.sqrt(np.mean(misses**2)))
        said = f"the path misses its points by up to {worst:.4g} mm, rms {rms:.4g} mm"
        tolerance = params.path_tolerance
        if tolerance is not None and exceeds(worst, tolerance):
            yield Finding.warning(
                "spherical.path",
                key,
                said,
                worst,
                tolerance,
                "mm",
                "refine the linkage with mechwright synthesize, or choose a longer projection",
            )
        else:
            yield Finding("spherical.path", Severity.NOTE, key, said, worst, tolerance, "mm")


def _order(phase: Phase, key: str) -> Iterator[Finding]:
    angles = phase.target_angles
    sense = math.copysign(1.0, phase.travel)
    steps = sense * np.diff(angles) * (not phase.rocks)  # a lever passes its points twice, in either order
    along = sense * (angles - phase.start)
    inside = (along >= -ON_TRAVEL) & (along <= abs(phase.travel) + ON_TRAVEL)
    if (steps < 0).any() or not inside.all():
        worst = (
            float(angles[int(np.argmin(inside))])
            if not inside.all()
            else float(angles[int(np.argmin(steps)) + 1])
        )
        yield Finding.warning(
            "spherical.order",
            key,
            f"the point at {math.degrees(worst):.4g}° is not on the travel, or not in its order",
            math.degrees(worst),
            math.degrees(phase.start + phase.travel),
            "deg",
            "order the points along the travel, and make that long enough",
        )


ON_TRAVEL = 1e-9
"""rad. A point this little outside the travel is at its end: rounding of degrees."""


def _figures(m: SphericalTable) -> Iterator[Finding]:
    four, mechanism = m.linkage.four_bar, m.linkage.five_bar
    if four is not None:
        said = f"it is a {kind(*four.arcs)}"
        yield Finding("spherical.mobility", Severity.NOTE, "four_bar", said)
    if mechanism is None:
        return
    (r1, r1n), (r3, r3n) = mechanism.crank_arcs, mechanism.rocker_arcs
    degrees = [math.degrees(float(x)) for x in (r1, r1n, r3, r3n)]
    other = second_size(m.linkage, m.shells)
    apart = max(abs(degrees[0] - degrees[1]), abs(degrees[2] - degrees[3]))
    said = f"R1 = {degrees[0]:.4f}° and {degrees[1]:.4f}°, R3 = {degrees[2]:.4f}° and {degrees[3]:.4f}°"
    if other:
        said += f": {' and '.join(sorted(other))} must be exchanged for phase 2; common_arcs avoids that"
    yield Finding("spherical.arcs", Severity.NOTE, "five_bar.common_arcs", said, apart, None, "deg")


Proc = Procedure[SphericalTable]

PINS = in_turn(
    Proc(("spherical.pins",), _pins, when=lambda t: not t.single and t.has_short_arcs, certain=True),
    Proc(("spherical.pins",), _pins, common=True),
)
"""Whether links have arcs, and pins directions, which the designs of a table share."""

ASSEMBLY = in_turn(
    OneByOne(lambda t: t.courses.unsure),
    Proc(
        ("spherical.assembly",),
        _assembly,
        when=lambda t: not t.single and t.courses.apart,
        certain=True,
        stage=Stage.PARTS,
    ),
    Proc(
        ("spherical.assembly", "spherical.lever", "spherical.transmission"),
        _assembly,
        when=lambda t: t.single or t.courses.apart,
    ),
)
"""Whether the linkage stays assembled over its travel; in its dead centre it may move, and has no parts."""

PATH = Proc(
    ("spherical.order", "spherical.assembly", "spherical.path"),
    _path,
    when=lambda t: t.single,
    stage=Stage.PARTS,
)
FIGURES = Proc(("spherical.mobility", "spherical.arcs"), _figures, warns=True)
