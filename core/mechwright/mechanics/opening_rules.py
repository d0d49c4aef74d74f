"""Rules of shaft openings: sizes that no mill cuts, and keyways that do not fit their bores or their keys.

Formulas take a table of designs (:mod:`mechwright.contracts.design_table`), to which a keyway's width is
common.
"""

import math
from collections.abc import Callable
from operator import attrgetter
from typing import Any

import numpy as np

from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.design_table import DesignTable
from mechwright.contracts.finding import Change, Severity
from mechwright.contracts.rule_list import Rules, all_of, in_turn
from mechwright.geometry.keyway import KEYS, LEAST_WIDTH, SMALLEST_EDGE, KeySize, key_for_bore, key_of_width

Rule = DesignRule[DesignTable[Any]]


def size_rules(*names: str) -> tuple[Rule, ...]:
    """Rules for the parameters, mm, that may be 0 or left out but not too small to be milled."""
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
        when=lambda t: size(t) is not None and np.asarray(size(t)) > 0,
    )


def keyway_rules(bore: str, width: str, relief: str) -> Rules[Any]:
    """Rules of an opening with a keyway of DIN 6885-1; the names are those of its parameters."""
    unknown = Rule(
        "bore.keyway-width",
        width,
        "no standard key is {value:g} mm wide",
        value=lambda t: getattr(t.params, width),
        limit=0.0,
        unit="mm",
        must_be="at most",
        remedy=f"use one of {', '.join(f'{one.width:g}' for one in KEYS)}",
        when=lambda t: _key(t, width) is None,
        reported=lambda f: (f.value, _fitting_width(f, bore)),
        proposed=lambda f: _fitting(f, bore, width),
    )
    fit = _fit_rules(bore, width, relief, "")
    return in_turn(
        all_of(*size_rules(bore, width)), in_turn(unknown, *fit, when=lambda t: _has_keyway(t, width))
    )


def keyed_rules() -> Rules[Any]:
    """Rules of the keyway of a table that may state its depth (:mod:`mechwright.contracts.keyed`)."""
    bore, width, relief, depth = "bore", "keyway_width", "keyway_relief", "keyway_depth"
    unknown = Rule(
        "bore.keyway-depth",
        depth,
        "no standard key is {value:g} mm wide, so its depth is not known",
        value=lambda t: getattr(t.params, width),
        limit=0.0,
        unit="mm",
        remedy=f"give keyway_depth, or a width of {', '.join(f'{one.width:g}' for one in KEYS)}",
        must_be="at most",
        reported=lambda f: (f.value, None),
        proposed=lambda f: _fitting(f, bore, width),
        when=lambda t: getattr(t.params, depth) is None and _key(t, width) is None,
    )
    shallow = Rule(
        "bore.keyway-depth",
        depth,
        "the standard key stands {limit:g} mm out of the shaft and does not go in",
        value=lambda t: _hub_depth(t, width, depth),
        limit=lambda t: 0.0 if (key := _key(t, width)) is None else key.height - key.shaft_depth,
        unit="mm",
        remedy=lambda f: f"use keyway_depth = {_hub_depth(f.m, width, ''):g}, or leave it out",
        proposed=lambda f: ({f"parameters.{depth}": None},),  # noqa: ARG005
    )
    other = shallow.but(
        message="the depth is not that of DIN 6885-1",
        value=lambda t: _hub_depth(t, width, depth) != _hub_depth(t, width, ""),
        limit=0,
        must_be="at most",
        severity=Severity.WARNING,
        reported=lambda f: (_hub_depth(f.m, width, depth), _hub_depth(f.m, width, "")),
        when=lambda t: _key(t, width) is not None,
    )
    return in_turn(
        unknown,
        *_fit_rules(bore, width, relief, depth),
        shallow,
        other,
        when=lambda t: _has_keyway(t, width),
    )


def _fit_rules(bore: str, width: str, relief: str, depth: str) -> tuple[Rule | Rules[Any], ...]:
    """Rules of a keyway in its bore; without the name of a depth it is that of the standard."""
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
            f"DIN 6885-1 has no key for a bore of {getattr(f.m.params, bore):g} mm"
            if (one := _fitting_width(f, bore)) is None
            else f"DIN 6885-1 has another key for a bore of {getattr(f.m.params, bore):g} mm: {one:g} mm"
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
        limit=lambda t: np.maximum(0.0, _greatest_relief(t, bore, width, depth)),
        unit="mm",
        remedy=lambda f: f"make {relief} at most {math.floor(f.limit * 100) / 100:g}",
        must_be="at most",
        reported=lambda f: (f.value, float(_greatest_relief(f.m, bore, width, depth))),
    )
    return swallowed, all_of(series, relieved)


def _has_keyway(t: DesignTable[Any], width: str) -> bool:
    return bool(np.all(np.asarray(getattr(t.params, width)) > 0))


def _key(t: DesignTable[Any], width: str) -> KeySize | None:
    """Give the standard key of a keyway's width, which designs of a table have in common."""
    return key_of_width(float(np.ravel(getattr(t.params, width))[0]))


def _hub_depth(t: DesignTable[Any], width: str, depth: str) -> Any:
    """Give the depth of a keyway, mm, that the designs state; else that of the standard, 0 without one."""
    given, key = getattr(t.params, depth) if depth else None, _key(t, width)
    if given is None:
        return 0.0 if key is None else key.hub_depth
    return given


def _width_for(bore: float) -> float:
    key = key_for_bore(bore)
    return math.nan if key is None else key.width


def _fitting_width(failure: Failure[Any], bore: str) -> float | None:
    key = key_for_bore(getattr(failure.m.params, bore))
    return None if key is None else key.width


def _fitting(failure: Failure[Any], bore: str, width: str) -> tuple[Change, ...]:
    one = _fitting_width(failure, bore)
    return () if one is None else ({f"parameters.{width}": one},)


def _greatest_relief(t: DesignTable[Any], bore: str, width: str, depth: str) -> Any:
    """Diameter of corner reliefs that leave a straight edge beside the bore and between them."""
    across, wide = np.asarray(getattr(t.params, bore)), float(np.ravel(getattr(t.params, width))[0])
    mouth = np.sqrt(np.maximum(across**2 - wide**2, 0.0)) / 2
    floor = across / 2 + _hub_depth(t, width, depth)
    return math.sqrt(2) * (np.minimum(wide / 2, floor - mouth) - SMALLEST_EDGE)
