"""Finding a law, angles and a roller for a requirement: a sweep of array operations, then a finer one.

The wheel, or the distance of the axes, or else the overall length fixes the scale: with â = a/l and b̂ = b/l
of the angles, l (1 + â + b̂) and the boss about the pin are as long as is allowed. A larger wheel has the
smaller forces, so nothing is lost by filling the space. Rollers and pins are those that can be bought. Of the
sound designs the one with the least Hertz pressure comes first.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, Candidate, Finding, Progress, Rejected, Scalar, Synthesis
from mechwright.mechanics.laws import LAWS
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.defaults.preferred_sizes import PINS, ROLLERS, largest
from mechwright_geneva.defaults.proportions import PIN, WHEEL, dowel_of
from mechwright_geneva.kinematics.contact_forces import Drive, curved, loads, stiffness, strength
from mechwright_geneva.kinematics.figures import peaks_of
from mechwright_geneva.kinematics.geometry import Frame, stroke
from mechwright_geneva.kinematics.slot_limits import SWEEP_SAMPLES
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.requirements import IndexingRequirement
from mechwright_geneva.rules.rule_table import RULES
from mechwright_geneva.rules.slot_search import allowed, trial

HALVES, OFFSETS = 22, 44
"""Values of crank half angle and offset angle tried with each law and roller."""

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
"""Degrees by which angles of two designs of one law with one roller differ at least."""


@dataclass(frozen=True)
class _Tried:
    """Designs of one law, (m,) each: half and offset in degrees, wheel and roller in mm, and the rest."""

    half: Array
    offset: Array
    rim: Array
    radius: Array
    pressure: Array
    acceleration: Array
    valid: NDArray[np.bool_]

    def take(self, rows: NDArray[np.intp]) -> "_Tried":
        return _Tried(*(getattr(self, name)[rows] for name in self.__dataclass_fields__))


def from_indexing(requirement: IndexingRequirement, progress: Progress) -> Synthesis[GenevaParams]:
    """Designs that meet a requirement, that with the least Hertz pressure first."""
    limit = requirement.pressure_limit or strength(requirement.material, requirement.roller_material)
    longest = min(GREATEST_HALF, 180 * requirement.index_time * requirement.speed / 60)
    if longest < LEAST_HALF:
        return Synthesis((), (_too_fast(requirement, longest),))
    rejected = Rejected()
    near: list[_Tried] = []
    # A driver whose plates are held by dowels is the better one.
    for dowel in (dowel_of(WHEEL), 0.0):
        near, found = [], []
        for number, law in enumerate(requirement.laws):
            progress(number / len(requirement.laws), f"sweep of the {law} law")
            tried = _sweep(requirement, law, dowel, *_grid(requirement, longest))
            near.append(tried)
            good = _good(requirement, tried, limit)
            if not good.half.size:
                continue
            best = good.take(np.argsort(good.pressure, kind="stable")[:KEPT])
            finer = _good(requirement, _sweep(requirement, law, dowel, *_about(best, longest)), limit)
            order = np.argsort(finer.pressure, kind="stable")
            found += _checked(requirement, law, finer.take(order), limit, rejected)
        if found:
            break
    progress(1.0, "done")
    if not found:
        return Synthesis((), (_none(requirement, near, limit),), rejected.reasons)
    ranked = sorted(found, key=lambda one: one.figures["contact_pressure"].value)
    rejected.beyond(requirement.designs, len(ranked) - requirement.designs)
    return Synthesis(tuple(ranked[: requirement.designs]), (), rejected.reasons)


def _grid(requirement: IndexingRequirement, longest: float) -> tuple[Array, Array, Array]:
    """Angles, and the rollers that may suit a wheel of the size that is asked for."""
    half = np.linspace(LEAST_HALF, longest, HALVES)
    offset = np.linspace(-GREATEST_OFFSET, GREATEST_OFFSET, OFFSETS)
    most = min(
        requirement.longest / 2,
        requirement.centre_distance or math.inf,
        (requirement.wheel_diameter or math.inf) / 2,
    )
    # Twice the wheel and more is the overall length; the wheel of the smallest angles is a quarter of it.
    radii = [one / 2 for one in ROLLERS if LEAST_SHARE * most / 4 <= one / 2 <= GREATEST_SHARE * most]
    sizes = np.clip(radii or [LEAST_SHARE * most], 0.5, 100)
    a, b, c = (grid.ravel() for grid in np.meshgrid(half, offset, sizes, indexing="ij"))
    return a, b, c


def _about(best: _Tried, longest: float) -> tuple[Array, Array, Array]:
    """Angles within a step of the first grid about each of some designs, with its roller."""
    steps = np.linspace(-1, 1, FINER)
    a, b = (grid.ravel() for grid in np.meshgrid(steps, steps, indexing="ij"))
    half = best.half[:, None] + a * (longest - LEAST_HALF) / (HALVES - 1)
    offset = best.offset[:, None] + b * 2 * GREATEST_OFFSET / (OFFSETS - 1)
    radius = np.broadcast_to(best.radius[:, None], half.shape)
    return np.clip(half, 5, longest).ravel(), offset.ravel(), radius.ravel()


def _wheels(requirement: IndexingRequirement, unit: Frame, radius: Array) -> Array:
    """Radius of the wheel of each design, mm, in hundredths; 0 where it cannot be as long as is allowed."""
    length, axes = (1 + unit.axes + unit.crank)[:, 0], unit.axes[:, 0]
    pins = np.array([largest(PINS, PIN * one) for one in radius])
    # The boss about a pin is as large as the roller, or the pin and a wall.
    allowed = (requirement.longest - np.maximum(radius, pins / 2 + requirement.least_wall)) / length
    if requirement.wheel_diameter is not None:
        rim = np.full(radius.shape, requirement.wheel_diameter / 2)
    elif requirement.centre_distance is not None:
        rim = requirement.centre_distance / axes
    else:
        rim = allowed = np.floor(allowed * 10**_ROUND) / 10**_ROUND
    wheels: Array = np.where(rim <= allowed, rim, 0.0)
    return wheels


def _sweep(
    requirement: IndexingRequirement, law: str, dowel: float, half: Array, offset: Array, radius: Array
) -> _Tried:
    """Rank designs of one law: scale, soundness, pressure, acceleration."""
    half, offset = half.round(_ROUND), offset.round(_ROUND)
    wheel = math.pi / requirement.slots
    able = (180 / requirement.slots + offset + half / 2 < 89) & (180 / requirement.slots + offset > 1)
    half, offset, radius = half[able], offset[able], radius[able]
    rim = _wheels(requirement, Frame.of(wheel, np.radians(half), np.radians(offset), 1.0), radius)
    defaults = GenevaParams(law=law, slots=requirement.slots)
    of = LAWS[law]()
    valid = (rim >= 5) & (radius <= GREATEST_SHARE * rim) & (radius >= LEAST_SHARE * rim)
    rows = np.flatnonzero(valid)
    if rows.size:
        given = {name: getattr(requirement, name) for name in ("least_wall", "bore", "driver_bore")}
        columns = {
            "crank_half_angle": half,
            "offset_angle": offset,
            "entry_radius": rim,
            "roller_radius": radius,
        }
        columns = {name: values[rows] for name, values in columns.items()}
        valid[rows] = allowed(trial(defaults, rows.size, SWEEP_SAMPLES, **columns, **given, fixing=dowel))
    pressure, acceleration = np.full(half.shape, np.inf), np.full(half.shape, np.inf)
    rows = np.flatnonzero(valid)
    if rows.size:
        frame = Frame.of(wheel, np.radians(half[rows]), np.radians(offset[rows]), rim[rows])
        run = stroke(frame, of, np.linspace(0, 1, _STROKE))
        omega = requirement.speed * math.tau / 60
        drive = Drive(
            omega,
            requirement.load_inertia,
            requirement.load_torque,
            radius[rows, None],
            max(requirement.thickness - requirement.floor - defaults.axial_gap, 0.1),
            stiffness(requirement.material, requirement.roller_material),
        )
        pressure[rows] = curved(run, drive).pressure.max(axis=-1)
        crank = np.radians(half[rows])
        acceleration[rows] = of.peaks.a * wheel / (2 * crank**2) * omega**2
    return _Tried(half, offset, rim, radius, pressure, acceleration, valid)


def _good(requirement: IndexingRequirement, tried: _Tried, limit: float) -> _Tried:
    able = tried.valid & (tried.pressure <= limit)
    if requirement.acceleration_limit is not None:
        able &= tried.acceleration <= requirement.acceleration_limit
    return tried.take(np.flatnonzero(able))


def _checked(
    requirement: IndexingRequirement, law: str, tried: _Tried, limit: float, rejected: Rejected
) -> list[Candidate[GenevaParams]]:
    """The first designs that every check lets pass, computed in full."""
    passed: list[Candidate[GenevaParams]] = []
    for row in range(min(tried.half.size, _LOOKED_AT)):
        params = _params(requirement, law, tried, row)
        if any(_alike(params, other.params) for other in passed) or rejected.by(
            RULES.findings(mechanism_of(params), quick=True)
        ):
            continue
        m = mechanism_of(params)
        load, omega = loads(m), params.speed * math.tau / 60
        fastest = peaks_of(m).a * omega**2
        if load.pressure > limit or fastest > (requirement.acceleration_limit or math.inf):
            continue
        figures = {
            "contact_pressure": Scalar(load.pressure, "MPa"),
            "acceleration": Scalar(fastest, "rad/s^2"),
            "contact_force": Scalar(load.force, "N"),
            "index_time": Scalar(2 * m.crank_half / omega, "s"),
            "centre_distance": Scalar(m.axes, "mm"),
        }
        passed.append(Candidate(params, Scalar(0.0, "mm"), figures))
        if len(passed) == requirement.designs:
            break
    return passed


def _alike(one: GenevaParams, two: GenevaParams) -> bool:
    """Whether two designs of one law are the same to an engineer."""
    angles = ((p.crank_half_angle or 0.0, p.offset_angle or 0.0) for p in (one, two))
    apart = (abs(a - b) for a, b in zip(*angles, strict=True))
    return one.roller_radius == two.roller_radius and all(angle < APART for angle in apart)


def _params(requirement: IndexingRequirement, law: str, tried: _Tried, row: int) -> GenevaParams:
    """A design with all that the requirement says of it."""
    radius = float(tried.radius[row])
    asked = {*GenevaParams.model_fields} - {"centre_distance"}
    return GenevaParams.model_validate(
        {
            **requirement.model_dump(include=asked),
            "law": law,
            "crank_half_angle": float(tried.half[row]),
            "offset_angle": float(tried.offset[row]),
            # The angles are in hundredths: they tell the wheel between axes that are given.
            **(
                {"centre_distance": requirement.centre_distance}
                if requirement.centre_distance
                else {"entry_radius": float(tried.rim[row])}
            ),
            "roller_radius": radius,
            "pin_diameter": largest(PINS, PIN * radius),
        }
    )


def _too_fast(requirement: IndexingRequirement, longest: float) -> Finding:
    least = LEAST_HALF / 180 * 60 / requirement.speed
    return Finding.error(
        "geneva.requirement",
        "index_time",
        f"a movement within {requirement.index_time:g} s is over after {2 * longest:.3g} degrees of the "
        "crank",
        requirement.index_time,
        least,
        "s",
        f"allow at least {math.ceil(least * 1e4) / 1e4:g} s, or a lower speed",
    )


def _none(requirement: IndexingRequirement, near: list[_Tried], limit: float) -> Finding:
    """Which limit stands in the way, and the nearest value that could be met."""
    total = sum(tried.half.size for tried in near)
    able = [tried.take(np.flatnonzero(tried.valid)) for tried in near]
    count = sum(tried.half.size for tried in able)
    if count == 0:
        size, value = _size(requirement)
        return Finding.error(
            "geneva.requirement",
            size,
            f"none of {total} designs with {size} = {value:g} mm has sound slots",
            value,
            unit="mm",
            remedy=f"allow more {size} or index_time, or smaller bore and least_wall",
        )
    most = requirement.acceleration_limit
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
            f"allow more {_size(requirement)[0]}, a thicker wheel or a longer index_time, or take a stronger "
            "material",
        )
    return Finding.error(
        "geneva.requirement",
        "driver_bore",
        f"{count} designs have sound slots, but none a driver that can be made",
        requirement.driver_bore,
        unit="mm",
        remedy=f"make driver_bore or bore smaller, or allow more {_size(requirement)[0]}",
    )


def _size(requirement: IndexingRequirement) -> tuple[str, float]:
    """The key that says how large the mechanism may be, and its value, mm."""
    for name in ("wheel_diameter", "centre_distance"):
        given = getattr(requirement, name)
        if given is not None:
            return name, given
    return "overall_length", requirement.longest
