"""Rules of shaft openings: sizes that no mill cuts, and keyways that do not fit their bores or their keys.

Formulas take a table of designs (:mod:`mechwright.contracts.design_table`), to which a keyway's width is
common.
"""

import math
from collections.abc import Callable
from operator import attrgetter
from typing import Any

import numpy as np

from mechwright.contracts.design_rule import DesignRule, Failure, Procedure
from mechwright.contracts.design_table import DesignTable
from mechwright.contracts.finding import Change, Severity, Stage, at_stage
from mechwright.contracts.rule_list import Rules, all_of, in_turn
from mechwright.geometry.keyway import KEYS, LEAST_WIDTH, SMALLEST_EDGE, key_for_bore, key_of_width
from mechwright.mechanics.openings import keyed_findings

Rule = DesignRule[DesignTable[Any]]


def size_rules(*names: str) -> tuple[Rule, ...]:
    """Rules for the parameters, mm, that may be 0 but not so small that no end mill cuts them."""
    return tuple(_size_rule(name, attrgetter(f"params.{name}")) for name in names)


def _size_rule(name: str, size: Callable[[Any], Any]) -> Rule:
    return Rule(
        "bore.size",
        name,
        "{value:.3g} mm is too small to be milled",
        value=size,
        limit=LEAST_WIDTH,
        unit="mm",
        remedy=f"set {name} to 0 for none, or to {LEAST_WIDTH:g} or more",
        when=lambda t: np.asarray(size(t)) > 0,
    )


def keyed_rules(*sizes: str) -> Rules[Any]:
    """Rules of designs whose keyway has a depth of its own (:mod:`mechwright.contracts.keyed`).

    ``sizes`` names the parameters that may be 0 but not too small to be milled.
    """
    codes = [f"bore.keyway-{name}" for name in ("depth", "width", "series", "relief")]
    return in_turn(
        all_of(*size_rules(*sizes)),
        Procedure[Any](
            codes,
            lambda t: at_stage(Stage.PARTS, keyed_findings(t.params)),
            when=lambda t: np.asarray(t.params.keyway_width) > 0,
            stage=Stage.PARTS,
        ),
    )


def keyway_rules(bore: str, width: str, relief: str) -> Rules[Any]:
    """Rules of an opening with a keyway of DIN 6885-1; the names are those of its parameters."""

    def has_keyway(t: DesignTable[Any]) -> bool:
        return bool(np.all(np.asarray(getattr(t.params, width)) > 0))

    unknown = Rule(
        "bore.keyway-width",
        width,
        "no standard key is {value:g} mm wide",
        value=lambda t: getattr(t.params, width),
        limit=0.0,
        unit="mm",
        must_be="at most",
        remedy=f"use one of {', '.join(f'{one.width:g}' for one in KEYS)}",
        when=lambda t: key_of_width(float(np.ravel(getattr(t.params, width))[0])) is None,
        reported=lambda f: (f.value, _fitting_width(f, bore)),
        proposed=lambda f: _fitting(f, bore, width),
    )
    swallowed = Rule(
        "bore.keyway-width",
        width,
        lambda f: f"a keyway {f.value:g} mm wide swallows the bore of {f.limit:g} mm",
        value=lambda t: getattr(t.params, width),
        limit=lambda t: getattr(t.params, bore),
        unit="mm",
        remedy=lambda f: (
            f"make {width} smaller than {bore}; "
            + ("0 for none" if (one := _fitting_width(f, bore)) is None else f"the standard is {one:g}")
        ),
        must_be="below",
        proposed=lambda f: ({f"parameters.{width}": _fitting_width(f, bore) or 0},),
    )
    series = Rule(
        "bore.keyway-series",
        width,
        lambda f: (
            f"DIN 6885-1 has another key for a bore of {getattr(f.m.params, bore):g} mm: "
            + ("none" if (one := _fitting_width(f, bore)) is None else f"{one:g} mm")
        ),
        value=lambda t: getattr(t.params, width) != _width_for(getattr(t.params, bore)),
        limit=0,
        unit="mm",
        remedy=lambda f: (
            "make sure that such a key is at hand"
            if (one := _fitting_width(f, bore)) is None
            else f"use {width} = {one:g}"
        ),
        must_be="at most",
        severity=Severity.WARNING,
        reported=lambda f: (getattr(f.m.params, width), _fitting_width(f, bore)),
        proposed=lambda f: _fitting(f, bore, width),
    )
    relieved = Rule(
        "bore.keyway-relief",
        relief,
        "reliefs of {value:g} mm leave nothing of the keyway's floor or sides",
        value=lambda t: getattr(t.params, relief),
        limit=lambda t: np.maximum(0.0, _greatest_relief(t, bore, width)),
        unit="mm",
        remedy=lambda f: f"make {relief} at most {math.floor(f.limit * 100) / 100:g}",
        must_be="at most",
        reported=lambda f: (f.value, float(_greatest_relief(f.m, bore, width))),
    )
    return in_turn(
        all_of(*size_rules(bore, width)),
        in_turn(unknown, swallowed, all_of(series, relieved), when=has_keyway),
    )


def _width_for(bore: float) -> float:
    key = key_for_bore(bore)
    return math.nan if key is None else key.width


def _fitting_width(failure: Failure[Any], bore: str) -> float | None:
    key = key_for_bore(getattr(failure.m.params, bore))
    return None if key is None else key.width


def _fitting(failure: Failure[Any], bore: str, width: str) -> tuple[Change, ...]:
    one = _fitting_width(failure, bore)
    return () if one is None else ({f"parameters.{width}": one},)


def _greatest_relief(t: DesignTable[Any], bore: str, width: str) -> Any:
    """Diameter of corner reliefs that leave a straight edge beside the bore and between them."""
    across, wide = np.asarray(getattr(t.params, bore)), float(np.ravel(getattr(t.params, width))[0])
    key = key_of_width(wide)
    depth = 0.0 if key is None else key.hub_depth
    mouth = np.sqrt(np.maximum(across**2 - wide**2, 0.0)) / 2
    return math.sqrt(2) * (np.minimum(wide / 2, across / 2 + depth - mouth) - SMALLEST_EDGE)
