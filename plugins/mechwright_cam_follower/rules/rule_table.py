"""The rules of a cam with its follower, in the order in which they are asked, and figures worth knowing."""

import math
from functools import partial
from typing import Any

import numpy as np

from mechwright import Severity, material
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.finding import Change
from mechwright.contracts.procedure import Note
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.strength.allowed import allowed
from mechwright_cam_follower.defaults.proportions import FITTED_FIELDS
from mechwright_cam_follower.kinematics.extremes import (
    face_ends,
    innermost,
    load_peak,
    of_cams,
    outermost,
    pressure_peak,
    regular_limit,
    regularity,
    sharpest,
    weakest,
)
from mechwright_cam_follower.kinematics.forces import preload_needed, rate_needed, spring_of
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.kinematics.turn import Extreme, greatest
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.rules.closure import CLOSURE
from mechwright_cam_follower.rules.gentler_motion import gentler
from mechwright_cam_follower.rules.remedies import sizes_for
from mechwright_cam_follower.rules.spring_rules import BOUGHT_SPRING, GUIDE, MOVED, SPRING_NOTES
from mechwright_cam_follower.rules.walls import WALLS
from mechwright_cam_follower.spring.choice import RESERVE

Rule = DesignRule[Mechanism]
Fails = Failure[Mechanism]

CAM_NAMES = ("cam", "cam 2")


def _size_words(f: Fails, *, steep: bool, otherwise: str) -> str:
    said = [f"{key} = {value:g}" for key, value in sizes_for(f.m.given, steep=steep)]
    return f"set {' or '.join(said)}" if said else otherwise


def _size_changes(f: Fails, *, steep: bool) -> tuple[Change, ...]:
    changes = tuple({f"parameters.{key}": value} for key, value in sizes_for(f.m.given, steep=steep))
    return changes or gentler(f.m.given, steep=steep)


def _undercut(f: Fails) -> str:
    name, at = CAM_NAMES[f.item], math.degrees(regularity(f.m, f.item).angle)
    if f.m.flat:
        what = f"{name} has a radius of curvature of {f.value:.4g} mm"
        need = ", which no flat face makes"
    else:
        what = f"the pitch curve of {name} has a radius of {f.m.roller / (1 - f.value):.4g} mm"
        need = f", and the roller {f.m.roller:g}"
    return f"{what} at {at:.1f} degrees{need}: the cam is undercut"


def _undercut_rule(unit: str, *, flat: bool) -> Rule:
    return Rule(
        "follower.undercut",
        "base_radius",
        _undercut,
        value=lambda m: of_cams(m, regularity),
        limit=regular_limit,
        unit=unit,
        remedy=partial(_size_words, steep=False, otherwise="use longer angles, or smaller lifts"),
        proposed=partial(_size_changes, steep=False),
        when=lambda m: m.flat == flat,
        each=False,
        slow="remedy",
    )


UNDERCUT = all_of(_undercut_rule("", flat=False), _undercut_rule("mm", flat=True))

PRESSURE_ANGLE = Rule(
    "follower.pressure-angle",
    "base_radius",
    lambda f: (
        f"the pressure angle of {CAM_NAMES[f.item]} reaches {f.value:.1f} degrees at "
        f"{math.degrees(pressure_peak(f.m, f.item).angle):.1f} degrees of the cam, above {f.limit:g}"
    ),
    value=lambda m: np.degrees(of_cams(m, pressure_peak)),
    limit=lambda m: m.given.steepest,
    unit="deg",
    remedy=partial(
        _size_words,
        steep=True,
        otherwise="use longer angles, smaller lifts, or another place of the follower",
    ),
    must_be="at most",
    severity=Severity.WARNING,
    proposed=partial(_size_changes, steep=True),
    each=False,
    slow="remedy",
)


def _is_stated(m: Mechanism) -> bool:
    """Whether a design states preload and rate of a spring of one's own."""
    return not m.given.conjugate and m.given.spring is None


def _springs(m: Mechanism) -> tuple[str, str]:
    return ("spring_preload", "spring_rate") if m.slides else ("spring_torque", "spring_stiffness")


def _preload_peak(m: Mechanism) -> Extreme:
    """Give the preload at which the follower just stays on its cam, with the rate as it is."""
    return greatest(m, "preload", lambda one: preload_needed(one.m, one.rates))


def _stiffer_springs(f: Fails) -> list[tuple[str, float]]:
    """Give the preload and the rate of springs that hold the follower; the rate does nothing at no lift."""
    rate = greatest(f.m, "rate", lambda one: rate_needed(one.m, one.rates))
    needs = (_preload_peak(f.m).value, rate.value)
    found = [
        (name, _rounded_up(need))
        for name, need in zip(_springs(f.m), needs, strict=True)
        if math.isfinite(need)
    ]
    return [one for one in found if weakest(Mechanism(f.m.given.model_copy(update=dict([one])))).value > 0]


def _rounded_up(value: float) -> float:
    """A tenth more, to three digits upwards.

    >>> _rounded_up(100.0), _rounded_up(0.0123)
    (111.0, 0.0136)
    """
    step = 10.0 ** (math.floor(math.log10(RESERVE * value)) - 2) if value > 0 else 1.0
    return float(f"{(math.floor(RESERVE * value / step) + 1) * step:.6g}")


def _spring_remedy(f: Fails) -> str:
    return f"set {' or '.join(f'{name} = {value:g}' for name, value in _stiffer_springs(f))}, or turn slower"


def _spring_rule(unit: str, *, slides: bool) -> Rule:
    return Rule(
        "follower.contact",
        lambda f: _springs(f.m)[0],
        lambda f: (
            f"the follower leaves its cam at {math.degrees(weakest(f.m).angle):.1f} degrees: {-f.value:.4g} "
            f"{unit} are missing that hold it"
        ),
        value=lambda m: weakest(m).value,
        limit=0.0,
        unit=unit,
        remedy=_spring_remedy,
        must_be="above",
        severity=Severity.WARNING,
        proposed=lambda f: tuple({f"parameters.{name}": value} for name, value in _stiffer_springs(f)),
        when=lambda m: _is_stated(m) and m.slides == slides,
        slow="remedy",
    )


def _materials(m: Mechanism) -> tuple[str, str]:
    return m.given.material, m.given.material if m.flat else m.given.roller_material


def _thicker(f: Fails) -> float:
    return math.ceil(f.m.given.thickness * (f.value / f.limit) ** 2 * 10) / 10


CONTACT_PRESSURE = Rule(
    "follower.contact-pressure",
    "thickness",
    lambda f: (
        f"the contact pressure reaches {f.value:.0f} MPa at "
        f"{math.degrees(load_peak(f.m, 'contact_pressure_max').angle):.1f} "
        f"degrees, above {f.limit:g} of {' on '.join(dict.fromkeys(_materials(f.m)))}"
    ),
    value=lambda m: load_peak(m, "contact_pressure_max").value,
    limit=lambda m: min(allowed(material(name).name).contact for name in _materials(m)),
    unit="MPa",
    remedy=lambda f: f"set thickness = {_thicker(f):g}, a larger roller, or a softer spring",
    must_be="at most",
    severity=Severity.WARNING,
    proposed=lambda f: ({"parameters.thickness": _thicker(f)},),
)


def _smaller(m: Mechanism) -> str:
    """Give the dimensions that a design leaves open and that are smaller than their defaults."""
    given, fields = m.given, CamParams.model_fields
    return ", ".join(
        f"{name} = {getattr(given, name):g}"
        for name in fields
        if name in FITTED_FIELDS
        and name not in given.model_fields_set
        and getattr(given, name) < fields[name].default
    )


def _size(m: Mechanism, cam: int) -> str:
    pressure, edge = pressure_peak(m, cam), sharpest(m, cam)
    sharp = f", sharpest radius {edge.value:.3f} mm at {math.degrees(edge.angle):.1f}"
    return (
        f"{CAM_NAMES[cam]}: radius {innermost(m, cam).value:.3f} to {outermost(m, cam).value:.3f} mm, "
        f"pressure angle up to {math.degrees(pressure.value):.2f} degrees "
        f"at {math.degrees(pressure.angle):.1f}" + sharp * math.isfinite(edge.value)
    )


def _size_note(cam: int) -> Note[Mechanism]:
    return Note(
        "follower.size",
        partial(_size, cam=cam),
        lambda m: outermost(m, cam).value,
        "mm",
        when=lambda m: cam in m.cams,
    )


def _face(m: Mechanism) -> str:
    low, high = face_ends(m)
    return f"the face is touched from {low:.3f} to {high:.3f} mm: {high - low:.3f} mm of it"


def _face_length(m: Mechanism) -> Any:
    low, high = face_ends(m)
    return high - low


def _preload(m: Mechanism) -> str:
    least, (preload, _), unit = weakest(m), spring_of(m), "N" if m.slides else "N·m"
    need = max(0.0, _preload_peak(m).value)
    return (
        f"the follower is held with at least {least.value:.4g} {unit}, at "
        f"{math.degrees(least.angle):.1f} degrees; of the preload of {preload:g} {unit} it needs {need:.4g}"
    )


def _preload_note(unit: str, *, slides: bool) -> Note[Mechanism]:
    return Note(
        "follower.preload",
        _preload,
        lambda m: weakest(m).value,
        unit,
        when=lambda m: _is_stated(m) and m.slides == slides,
    )


def _load_words(m: Mechanism) -> str:
    torque = load_peak(m, "torque_max")
    return (
        f"contact force up to {load_peak(m, 'contact_force_max').value:.4g} N and contact pressure up to "
        f"{load_peak(m, 'contact_pressure_max').value:.4g} MPa; camshaft torque up to "
        f"{torque.value:.4g} N·m at {math.degrees(torque.angle):.1f} degrees"
    )


LOADS = all_of(
    PRESSURE_ANGLE,
    _spring_rule("N", slides=True),
    _spring_rule("N*m", slides=False),
    BOUGHT_SPRING,
    MOVED,
    GUIDE,
    CONTACT_PRESSURE,
)

NOTES = all_of(
    Note(
        "follower.fitted",
        lambda m: f"defaults reduced so that walls stay: {_smaller(m)}",
        when=_smaller,
    ),
    *map(_size_note, range(2)),
    Note("follower.face", _face, _face_length, "mm", when=lambda m: m.flat),
    _preload_note("N", slides=True),
    _preload_note("N*m", slides=False),
    *SPRING_NOTES,
    Note("follower.loads", _load_words, lambda m: load_peak(m, "torque_max").value, "N*m"),
)

RULES = in_turn(CLOSURE, UNDERCUT, WALLS, all_of(LOADS, NOTES))
