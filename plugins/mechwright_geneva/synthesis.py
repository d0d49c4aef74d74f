"""Finding a law, angles and a roller for a requirement: a sweep of array operations, then a finer one.

The overall length fixes the scale: with â = a/l and b̂ = b/l of the angles, l (1 + â + b̂) and the boss about
the pin are as long as is allowed. A larger wheel has the smaller forces, so nothing is lost by filling the
space. Of the sound designs the one with the least Hertz pressure comes first.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, Candidate, Finding, Progress, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.mechanics.laws import LAWS
from mechwright_geneva.checks import findings
from mechwright_geneva.contact import Drive, curved, loads, stiffness, strength
from mechwright_geneva.kinematics import Frame, stroke
from mechwright_geneva.mechanism import mechanism_of
from mechwright_geneva.motion import peaks_of
from mechwright_geneva.openings import driver_radius
from mechwright_geneva.params import GenevaParams
from mechwright_geneva.requirement import IndexingRequirement
from mechwright_geneva.sound import Walls, sound

HALVES, OFFSETS, ROLLERS = 22, 44, 14
"""Values of crank half angle, offset angle and roller share tried with each law."""

LEAST_HALF, GREATEST_HALF = 20.0, 100.0
"""Crank half angles tried, degrees: beyond them the sweep has never found a sound design."""

GREATEST_OFFSET = 25.0
"""Offset angles tried, degrees."""

LEAST_SHARE, GREATEST_SHARE = 0.015, 0.14
"""Roller radius over l: smaller ones yield, larger ones leave no webs."""

FINER = 5
"""Values of each unknown about a good design in the second sweep."""

KEPT = 4
"""Designs of each law that are refined."""

_STROKE = 33
"""Samples of a stroke that rank designs; the winners are computed in full."""

_LOOKED_AT = 200
"""Designs of one law that are checked at most."""

_ROUND = 2
"""Decimals of the angles and lengths of a design: what a drawing states."""

APART = 1.0
"""Degrees by which angles of two designs of one law differ at least, or rollers by a tenth."""

BORE_ROOM = 2.0
"""Pin diameter over roller radius is held at this over two: a pin half as thick as its roller."""


@dataclass(frozen=True)
class _Tried:
    """Designs of one law, (m,) each: half and offset in degrees, the roller's share of l, and the rest."""

    half: Array
    offset: Array
    share: Array
    rim: Array
    radius: Array
    pressure: Array
    acceleration: Array
    sound: NDArray[np.bool_]

    def take(self, rows: NDArray[np.intp]) -> "_Tried":
        return _Tried(*(getattr(self, name)[rows] for name in self.__dataclass_fields__))


def from_indexing(wanted: IndexingRequirement, progress: Progress) -> Synthesis[GenevaParams]:
    """Designs that meet a requirement, that with the least Hertz pressure first."""
    limit = wanted.pressure_limit or strength(wanted.material, wanted.roller_material)
    longest = min(GREATEST_HALF, 180 * wanted.index_time * wanted.speed / 60)
    if longest < LEAST_HALF:
        return Synthesis((), (_too_fast(wanted, longest),))
    found: list[Candidate[GenevaParams]] = []
    near: list[_Tried] = []
    for number, law in enumerate(wanted.laws):
        progress(number / len(wanted.laws), f"sweep of the {law} law")
        tried = _sweep(wanted, law, *_grid(longest))
        near.append(tried)
        good = _good(wanted, tried, limit)
        if not good.half.size:
            continue
        best = good.take(np.argsort(good.pressure, kind="stable")[:KEPT])
        finer = _good(wanted, _sweep(wanted, law, *_about(best, longest)), limit)
        order = np.argsort(finer.pressure, kind="stable")
        found += _checked(wanted, law, finer.take(order), limit)
    progress(1.0, "done")
    if not found:
        return Synthesis((), (_none(wanted, near, limit),))
    ranked = sorted(found, key=lambda one: one.figures["contact_pressure"].value)
    return Synthesis(tuple(ranked[: wanted.designs]))


def _grid(longest: float) -> tuple[Array, Array, Array]:
    half = np.linspace(LEAST_HALF, longest, HALVES)
    offset = np.linspace(-GREATEST_OFFSET, GREATEST_OFFSET, OFFSETS)
    share = np.geomspace(LEAST_SHARE, GREATEST_SHARE, ROLLERS)
    a, b, c = (grid.ravel() for grid in np.meshgrid(half, offset, share, indexing="ij"))
    return a, b, c


def _about(best: _Tried, longest: float) -> tuple[Array, Array, Array]:
    """Values within a step of the first grid about each of some designs."""
    steps = np.linspace(-1, 1, FINER)
    a, b, c = (grid.ravel() for grid in np.meshgrid(steps, steps, steps, indexing="ij"))
    half = best.half[:, None] + a * (longest - LEAST_HALF) / (HALVES - 1)
    offset = best.offset[:, None] + b * 2 * GREATEST_OFFSET / (OFFSETS - 1)
    share = best.share[:, None] * (GREATEST_SHARE / LEAST_SHARE) ** (c / (ROLLERS - 1))
    return np.clip(half, 5, longest).ravel(), offset.ravel(), share.ravel()


def _sweep(wanted: IndexingRequirement, law: str, half: Array, offset: Array, share: Array) -> _Tried:
    """Rank designs of one law: scale, soundness, pressure, acceleration."""
    half, offset = half.round(_ROUND), offset.round(_ROUND)
    wheel = math.pi / wanted.slots
    able = (180 / wanted.slots + offset + half / 2 < 89) & (180 / wanted.slots + offset > 1)
    half, offset, share = half[able], offset[able], share[able]
    unit = Frame.of(wheel, np.radians(half), np.radians(offset), 1.0)
    length = 1 + unit.axes[:, 0] + unit.crank[:, 0]
    # The boss about a pin is as large as the roller, or the pin and a wall.
    rim = wanted.overall_length / (length + share)
    radius = (rim * share).round(_ROUND)
    boss = np.maximum(radius, radius * BORE_ROOM / 4 + wanted.least_wall)
    rim = np.floor((wanted.overall_length - boss) / length * 10**_ROUND) / 10**_ROUND
    usual = GenevaParams()
    driver = driver_radius(wanted.driver_bore / 2, wanted.least_wall, usual.fixing)
    walls = Walls(wanted.least_wall, wanted.bore / 2, driver, usual.lock_clearance, 1)
    groove = radius + usual.groove_clearance / 2
    of = LAWS[law]()
    sound_ones = sound(of, wheel, np.radians(half), np.radians(offset), rim, groove, walls)
    sound_ones &= rim > 0
    pressure, acceleration = np.full(half.shape, np.inf), np.full(half.shape, np.inf)
    if sound_ones.any():
        rows = np.flatnonzero(sound_ones)
        frame = Frame.of(wheel, np.radians(half[rows]), np.radians(offset[rows]), rim[rows])
        run = stroke(frame, of, np.linspace(0, 1, _STROKE))
        omega = wanted.speed * math.tau / 60
        drive = Drive(
            omega,
            wanted.load_inertia,
            wanted.load_torque,
            radius[rows, None],
            max(wanted.thickness - wanted.floor - usual.axial_gap, 0.1),
            stiffness(wanted.material, wanted.roller_material),
        )
        pressure[rows] = curved(run, drive).pressure.max(axis=-1)
        crank = np.radians(half[rows])
        acceleration[rows] = of.peaks.a * wheel / (2 * crank**2) * omega**2
    return _Tried(half, offset, share, rim, radius, pressure, acceleration, sound_ones)


def _good(wanted: IndexingRequirement, tried: _Tried, limit: float) -> _Tried:
    able = tried.sound & (tried.pressure <= limit)
    if wanted.acceleration_limit is not None:
        able &= tried.acceleration <= wanted.acceleration_limit
    return tried.take(np.flatnonzero(able))


def _checked(
    wanted: IndexingRequirement, law: str, tried: _Tried, limit: float
) -> list[Candidate[GenevaParams]]:
    """The first designs that every check lets pass, computed in full."""
    passed: list[Candidate[GenevaParams]] = []
    for row in range(min(tried.half.size, _LOOKED_AT)):
        params = _params(wanted, law, tried, row)
        if any(_alike(params, other.params) for other in passed) or errors(findings(params)):
            continue
        m = mechanism_of(params)
        load, omega = loads(m), params.speed * math.tau / 60
        fastest = peaks_of(m).a * omega**2
        if load.pressure > limit or fastest > (wanted.acceleration_limit or math.inf):
            continue
        figures = {
            "contact_pressure": Scalar(load.pressure, "MPa"),
            "acceleration": Scalar(fastest, "rad/s^2"),
            "contact_force": Scalar(load.force, "N"),
            "index_time": Scalar(2 * m.crank_half / omega, "s"),
            "centre_distance": Scalar(m.axes, "mm"),
        }
        passed.append(Candidate(params, Scalar(0.0, "mm"), figures))
        if len(passed) == wanted.designs:
            break
    return passed


def _alike(one: GenevaParams, two: GenevaParams) -> bool:
    """Whether two designs of one law are the same to an engineer."""
    if one.crank_half_angle is None or two.crank_half_angle is None:
        return False
    return (
        abs(one.crank_half_angle - two.crank_half_angle) < APART
        and abs((one.offset_angle or 0) - (two.offset_angle or 0)) < APART
        and abs(one.roller_radius / two.roller_radius - 1) < APART / 10
    )


def _params(wanted: IndexingRequirement, law: str, tried: _Tried, row: int) -> GenevaParams:
    """A design with all that the requirement says of it."""
    radius = float(tried.radius[row])
    return GenevaParams.model_validate(
        {
            **wanted.model_dump(include=set(GenevaParams.model_fields)),
            "law": law,
            "crank_half_angle": float(tried.half[row]),
            "offset_angle": float(tried.offset[row]),
            "entry_radius": float(tried.rim[row]),
            "roller_radius": radius,
            "pin_diameter": max(0.5, round(radius * BORE_ROOM / 2, 1)),
        }
    )


def _too_fast(wanted: IndexingRequirement, longest: float) -> Finding:
    least = LEAST_HALF / 180 * 60 / wanted.speed
    return Finding.error(
        "geneva.requirement",
        "index_time",
        f"a movement within {wanted.index_time:g} s is over after {2 * longest:.3g} degrees of the crank",
        wanted.index_time,
        least,
        "s",
        f"allow at least {math.ceil(least * 1e4) / 1e4:g} s, or a lower speed",
    )


def _none(wanted: IndexingRequirement, near: list[_Tried], limit: float) -> Finding:
    """Which limit stands in the way, and the nearest value that could be met."""
    total = sum(tried.half.size for tried in near)
    able = [tried.take(np.flatnonzero(tried.sound)) for tried in near]
    count = sum(tried.half.size for tried in able)
    if count == 0:
        return Finding.error(
            "geneva.requirement",
            "overall_length",
            f"none of {total} designs within {wanted.overall_length:g} mm has sound slots",
            wanted.overall_length,
            unit="mm",
            remedy="allow more overall_length or index_time, or smaller bore and least_wall",
        )
    most = wanted.acceleration_limit
    slowest = min(float(tried.acceleration.min()) for tried in able if tried.half.size)
    if most is not None and slowest > most:
        return Finding.error(
            "geneva.requirement",
            "acceleration_limit",
            f"of {count} sound designs the slowest accelerates the wheel by {slowest:.4g} rad/s²",
            most,
            slowest,
            "rad/s^2",
            f"allow {math.ceil(slowest * 10) / 10:g}, or a longer index_time",
        )
    within = [tried.acceleration <= (most or math.inf) for tried in able]
    least = min(
        float(tried.pressure[rows].min()) for tried, rows in zip(able, within, strict=True) if rows.any()
    )
    if least > limit:
        return Finding.error(
            "geneva.requirement",
            "pressure_limit",
            f"of {count} sound designs the best has a Hertz pressure of {least:.4g} MPa",
            limit,
            least,
            "MPa",
            "allow more overall_length, a thicker wheel or a longer index_time, or take a stronger material",
        )
    return Finding.error(
        "geneva.requirement",
        "driver_bore",
        f"{count} designs have sound slots, but none a driver that can be made",
        wanted.driver_bore,
        unit="mm",
        remedy="make driver_bore or bore smaller, or allow more overall_length",
    )
