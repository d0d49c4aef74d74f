"""Rules of the parts: room beside bores, shapes, layers, and the pressure on the rod's bores."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from mechwright import GeometryError, Severity
from mechwright.contracts.design_rule import DesignRule, Failure, no_figures
from mechwright.contracts.design_table import by_row
from mechwright.contracts.finding import Change, Finding, Stage
from mechwright.contracts.procedure import Procedure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.strength.judging import SLOWEST
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.parts.dimensions import LEAST_WEB, MAX_PRESSURE
from mechwright_slider_crank.parts.layers import LEAST_BASE, has_bounds, rooms_of
from mechwright_slider_crank.parts.outlines import rod_outline
from mechwright_slider_crank.rules.loads import rod_force

MOST_BEND = 0.5
"""Bend of a rod over its length: at more its legs are steeper than 45° and carry bending before all."""

Rule = DesignRule[Mechanism]
Fails = Failure[Mechanism]


def _web(
    code: str,
    parameter: str,
    where: str,
    value: Callable[[Mechanism], Any],
    remedy: str | Callable[[Fails], str],
    when: Callable[[Mechanism], Any] | None = None,
) -> Rule:
    """Material between two bores, or beside one."""
    return Rule(
        code,
        parameter,
        f"{{value:.3g}} mm are left {where}, the limit is {{limit:g}} mm",
        value=value,
        limit=LEAST_WEB,
        unit="mm",
        remedy=remedy,
        when=when,
    )


def _longer(key: str, others: str) -> Callable[[Fails], str]:
    return lambda f: (
        f"make {key} at least {getattr(f.m.given, key) + LEAST_WEB - f.value:.4g} mm, or {others}"
    )


def _wider(key: str, bore: str, others: str) -> Callable[[Fails], str]:
    return lambda f: (
        f"make {key} at least {getattr(f.m.dimensions, bore) + 2 * LEAST_WEB:.4g} mm, or {others}"
    )


def _beside_point(m: Mechanism) -> Any:
    point = m.given.coupler_point
    nearest = np.minimum(np.abs(point), np.abs(point - m.given.rod))
    return nearest - (m.dimensions.rod_bore + m.given.coupler_bore) / 2


def _beside_pin(key: str) -> Callable[[Mechanism], Any]:
    return lambda m: (getattr(m.dimensions, key) - m.dimensions.pin) / 2


WEBS = all_of(
    _web(
        "slider-crank.crank-web",
        "crank",
        "between the bores of shaft and crank pin",
        lambda m: m.given.crank - (m.dimensions.shaft + m.dimensions.pin) / 2,
        _longer("crank", "pin or shaft thinner"),
    ),
    _web(
        "slider-crank.rod-web",
        "rod",
        "between the bores of the rod",
        lambda m: m.given.rod - m.dimensions.rod_bore,
        _longer("rod", "pin or bushing smaller"),
    ),
    _web(
        "slider-crank.coupler-web",
        "coupler_bore",
        "between the coupler point's bore and a joint's",
        _beside_point,
        "move the coupler point away from the joints, or make coupler_bore smaller",
        lambda m: np.asarray(m.given.coupler_bore) > 0,
    ),
    *(
        _web(
            "slider-crank.slider-web",
            key,
            "beside the slider's pin",
            _beside_pin(key),
            _wider(key, "pin", "pin thinner"),
        )
        for key in ("slider_width", "slider_length")
    ),
    _web(
        "slider-crank.rail-web",
        "rail",
        "beside the rail's dowels",
        lambda m: (m.dimensions.rail - m.dimensions.dowel) / 2,
        _wider("rail", "dowel", "pin thinner"),
    ),
)

BEND = Rule(
    "slider-crank.rod-bend",
    "rod_bend",
    "the rod leaves the straight line by {value:g} mm, half its length is {limit:g}",
    value=lambda m: abs(m.given.rod_bend),
    limit=lambda m: MOST_BEND * m.given.rod,
    unit="mm",
    remedy=lambda f: f"make rod_bend at most {f.limit:g} mm either way",
    must_be="at most",
)


def _rod_shape(m: Mechanism) -> list[Finding]:
    try:
        rod_outline(m).polygon()
    except GeometryError as error:
        parameter = "rod_bend" if m.given.rod_bend else "rod_width"
        return [
            Finding.error(
                "slider-crank.rod-shape",
                parameter,
                f"the rod cannot be drawn: {error}",
                remedy=f"change {parameter}, or make wall smaller",
                stage=Stage.PARTS,
            )
        ]
    return []


def _has_layers(m: Mechanism) -> float:
    return 0.0 if m.layout_or_none is None else 1.0


def _may_stand(m: Mechanism) -> Any:
    """1 where bounds do not tell that there are no layers."""
    return np.where(rooms_of(m).stuck, 0.0, 1.0) if has_bounds(m) else np.ones((m.size, 1))


def _stands(m: Mechanism) -> Any:
    """1 where bounds tell that there are layers."""
    if not has_bounds(m):
        return np.array(_has_layers(m)) if m.single else np.zeros((m.size, 1))
    # A narrower base may have no room for its corners.
    broad = m.dimensions.base_bore + 2 * m.dimensions.wall >= LEAST_BASE
    return np.where(rooms_of(m).stands & broad, 1.0, 0.0)


def _layers_message(f: Fails) -> str:
    try:
        f.m.layout  # noqa: B018 - it raises
    except GeometryError as error:
        return str(error)
    raise AssertionError("a design without layers")


LAYERS = Rule(
    "slider-crank.layers",
    "crank_shape",
    _layers_message,
    value=by_row(_has_layers),
    limit=1.0,
    remedy=lambda f: (
        ("use crank_shape = 'arm', or" if f.m.given.crank_shape == "disc" else "use")
        + " a longer rod, a narrower rail, or thinner pins and walls"
    ),
    reported=no_figures,
    proposed=lambda f: () if f.m.given.rail_overhang is None else ({"parameters.rail_overhang": None},),
    best=_may_stand,
    worst=_stands,
)


def _pressure(m: Mechanism) -> Any:
    return rod_force(m) / (m.dimensions.pin * m.given.thickness)


def _stronger(f: Fails) -> tuple[Change, ...]:
    """Thicker pins, or less of what they carry.

    Thicker pins make heavier plates, so that more than the first may be needed.
    """
    params, over = f.m.given, f.value / f.limit
    pin = rod_force(f.m) / (f.limit * params.thickness)
    found: list[Change] = [{"parameters.pin": math.ceil(2 * share * pin) / 2} for share in (1.0, 1.15, 1.4)]
    for share in (1.05, 1.2):
        if params.load != 0:
            found.append({"parameters.load": float(f"{params.load / over / share:.2g}")})
        if (speed := params.speed / math.sqrt(over) / share) >= SLOWEST:
            found.append({"parameters.speed": float(f"{speed:.2g}")})
    return tuple(found)


PRESSURE = Rule(
    "slider-crank.pin-pressure",
    "pin",
    lambda f: (
        f"{rod_force(f.m):.4g} N press on the rod's bores with {f.value:.4g} MPa, the limit is "
        f"{f.limit:g} MPa"
    ),
    value=_pressure,
    limit=MAX_PRESSURE,
    unit="MPa",
    remedy="thicker pins, a thicker plate, or less load or speed",
    must_be="at most",
    severity=Severity.WARNING,
    proposed=_stronger,
)

PARTS = in_turn(
    WEBS,
    BEND,
    Procedure[Mechanism](
        ("slider-crank.rod-shape",),
        _rod_shape,
        when=lambda m: (
            m.given.rod_width is not None
            or (np.asarray(m.given.coupler_bore) > 0) | (np.asarray(m.given.rod_bend) != 0)
        ),
        stage=Stage.PARTS,
    ),
    LAYERS,
    PRESSURE,
)
"""Of the parts, in order."""
