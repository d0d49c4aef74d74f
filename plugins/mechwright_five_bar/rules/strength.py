"""Rules of loads: pressure on the bearings, and bending of the teeth by what arm and rocker put on them."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import Array, Finding, GeometryError, Stage
from mechwright.contracts.design_table import column, number
from mechwright.contracts.finding import Change, at_stage
from mechwright.contracts.mass import KILOGRAMS
from mechwright.contracts.materials import material
from mechwright.contracts.procedure import Procedure
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL
from mechwright.mechanics.linkage.kinematics.forces import MILLI
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT
from mechwright.mechanics.strength.allowed import REVERSING_ROOT, ROOT_SAFETY, allowed
from mechwright.mechanics.strength.bearings_life import SINTERED_PRESSURE
from mechwright.mechanics.strength.judging import SLOWEST, Stress, StressRule, Way
from mechwright.mechanics.strength.pressure import most_pressed, too_pressed
from mechwright.mechanics.strength.tooth_bending import root_stress
from mechwright.standards.stock import plate_or_block
from mechwright_five_bar.kinematics.loads import JOINTS, loads_of
from mechwright_five_bar.rules.gears import require_gears
from mechwright_five_bar.table import FiveBarTable

LINKS_HIGH, GAPS = 4, 6
"""Plates of links above each other, with one to spare, and gaps between layers."""


def _bearings(m: FiveBarTable) -> Iterator[Finding]:
    params, peaks = m.params, loads_of(m).peaks
    widths = dict.fromkeys(JOINTS, params.thickness) | dict.fromkeys(("A0", "B0"), params.ground_thickness)
    joint, force, pressure = most_pressed(peaks, widths, params.pin_diameter)
    more = _stronger(m, pressure / SINTERED_PRESSURE)
    yield from too_pressed("five-bar.bearing-pressure", joint, force, pressure, more)
    yield Finding.note(
        "five-bar.forces",
        f"the drive needs up to {peaks['drive_torque'].value:.4g} N m; the gears put up to "
        f"{peaks['arm_torque'].value:.4g} N m on the arm, {peaks['tooth_force'].value:.4g} N between "
        "teeth; joint "
        f"{joint} carries up to {force:.4g} N, and the moving masses shake the ground with up to "
        f"{peaks['shaking_force'].value:.4g} N",
        peaks["drive_torque"].value,
        "N*m",
    )


def _stronger(m: FiveBarTable, over: float) -> tuple[Change, ...]:
    """Larger bearings, or less of what they carry, which is so many times ``over`` its limit."""
    params, found = m.params, list[Change]()
    for share in (1.05, 1.2, 1.5):
        root = math.sqrt(over * share)
        found.append({
            "parameters.pin_diameter": math.ceil(2 * root * params.pin_diameter) / 2,
            "parameters.thickness": plate_or_block(root * params.thickness, params.material),
        })  # fmt: skip
        speed = params.speed / math.sqrt(over * share)
        if speed >= SLOWEST:
            found.append({"parameters.speed": float(f"{speed:.2g}")})
    return tuple(found)


def root_limit(m: FiveBarTable) -> float:
    """Bending that the roots of teeth bear for long where it does not change its sign, MPa."""
    return allowed(m.params.material).root


def tooth_loads(m: FiveBarTable) -> tuple[Any, Any, Any]:
    """Of the gears: their width, mm, the greatest tooth force, N, and whether it reverses.

    Of a table columns (n, 1); NaN of the forces of designs of which :func:`roots_bear`.
    """
    if m.single:
        loads = loads_of(m)
        return m.params.gear_thickness, loads.peaks["tooth_force"].value, loads.reverses
    found = m.once("tooth loads", lambda: _of_rows(m))
    return found[:, :1], found[:, 1:2], found[:, 2:]


def _of_rows(m: FiveBarTable) -> Array:
    found = np.full((m.size, 3), math.nan)
    found[:, :1] = m.params.gear_thickness
    for place in np.flatnonzero(~column(roots_bear(m), m.size)[:, 0].astype(bool)).tolist():
        found[place] = tooth_loads(m.row(place))
    return found


def root_stresses(m: FiveBarTable) -> tuple[Stress, ...]:
    """Of each gear at the wheel's greatest tooth force; one tooth carries alone, at its tip.

    What the idler's own inertia adds between it and the pinion is left out. Teeth of an idler are bent both
    ways in every turn, those of the others where the arm's torque changes its sign.
    """
    if m.single:
        try:
            require_gears(m)
        except GeometryError:  # a tried module, with which the gears do not stand
            return ()
    width, force, reverses = tooth_loads(m)
    bears, train = root_limit(m), m.train
    found = []
    for name, teeth in train.teeth.items():
        value = root_stress(force, width, train.module, float(teeth))
        both_ways = np.asarray(reverses, dtype=bool) | (name == "idler")
        limit = bears * np.where(both_ways, REVERSING_ROOT, 1.0)
        what = f"teeth of the {name} are bent at their roots by "
        said = f"{what}{force:.4g} N with" if m.single else what
        found.append(Stress(said, number(value), number(limit), ROOT_SAFETY * bears))
    return tuple(found)


def _ways(m: FiveBarTable) -> list[Way]:
    params = m.params
    ways = [Way("gear_thickness", params.gear_thickness), Way("speed", params.speed, up=False)]
    if params.module is not None:
        ways.insert(1, Way("module", params.module))
    return ways


def roots_bear(m: FiveBarTable) -> Any:
    """Whether no tooth breaks at its root; where the width is left out, whether the default one lasts."""
    given = "gear_thickness" in m.given.model_fields_set
    return m.once("roots are sure", lambda: bears_at_most(m, ROOT_SAFETY if given else REVERSING_ROOT))


def bears_at_most(m: FiveBarTable, share: float) -> Any:
    """Whether no tooth bears more than a share of the limit of its root, by bounds of masses and rates.

    They are those of one phase and of cranks that turn fully.
    """
    if m.params.phases:
        return False
    params, bar, ratio = m.params, m.bar, abs(m.bar.ratio)
    omega, sine = params.speed * math.tau / 60, np.sin(m.transmission[0])
    (m3, e3, j3), (m4, e4, j4) = _greatest_masses(m)
    a, b, c, l = bar.crank, bar.arm, bar.coupler, bar.rocker
    most = (a + ratio * b) / sine
    w, v = most / c, most / l
    bend = (a + ratio**2 * b + c * w * w + l * v * v) / sine
    at_a, at_b = a * omega**2, ratio**2 * b * omega**2
    alpha_c, alpha_r = bend / c * omega**2, bend / l * omega**2
    load = np.hypot(params.load_x, params.load_y) / MILLI * np.abs(params.coupler_point)
    across = (j3 * alpha_c + m3 * e3 * at_a + load) / c + (j4 * alpha_r + m4 * e4 * at_b) / l
    in_b1 = across / sine + m4 * (at_b + e4 * (alpha_r + (v * omega) ** 2))
    force = b * in_b1 * MILLI / m.train.radius("wheel")
    limit = share * root_limit(m)
    sure = ~np.asarray(m.is_lever)
    for teeth in m.train.teeth.values():
        sure = sure & (root_stress(force, params.gear_thickness, m.train.module, float(teeth)) <= limit)
    return sure


def _greatest_masses(m: FiveBarTable) -> list[tuple[Any, Any, Any]]:
    """Of coupler and rocker, or more: mass, kg, farthest place, mm, and moment about A or B1, kg mm²."""
    params, bar = m.params, m.bar
    pin, thickness, half = params.pin_diameter, params.thickness, m.bore / 2 + params.rim
    high = params.gear_thickness + params.ground_thickness
    high = high + LINKS_HIGH * thickness + GAPS * params.washer
    heavy = material(PIN_MATERIAL).density * KILOGRAMS * math.pi / 4
    pinned = heavy * (pin**2 * high + (HEAD * pin) ** 2 * HEAD_HEIGHT * pin)
    bush = material(BUSHING_MATERIAL).density * KILOGRAMS * math.pi / 4 * m.bore**2 * thickness
    sheet = material(params.material).density * KILOGRAMS * thickness
    point, c = params.coupler_point, bar.coupler
    away = np.abs(point)
    area = c * np.abs(params.coupler_point_y) / 2 + (c + away + np.abs(point - c)) * half + math.pi * half**2
    found = []
    for far, plate, more in (
        (np.maximum(c, away) + half, area, 2 * bush),
        (bar.rocker + half, 2 * bar.rocker * half + math.pi * half**2, pinned + 2 * bush),
    ):
        mass = sheet * plate + more
        found.append((mass, far, mass * far**2))
    return found


BEARINGS = Procedure[FiveBarTable](
    ("five-bar.bearing-pressure", "five-bar.forces"),
    lambda m: at_stage(Stage.PARTS, _bearings(m)),
    warns=True,
)
ROOT = StressRule("five-bar.root", root_stresses, _ways, FiveBarTable.of, bears=roots_bear)
