"""The nearest law of the same kind that works: how much of a law's change of ratio can stay."""

import math
from collections.abc import Callable
from typing import Any

from pydantic import ValidationError

from mechwright import MechwrightError
from mechwright.contracts.finding import Change
from mechwright_noncircular_gears.fields import MOST_HALF_TURN
from mechwright_noncircular_gears.kinematics.law import law_of
from mechwright_noncircular_gears.kinematics.laws.formula import RatioFormula
from mechwright_noncircular_gears.kinematics.laws.sector import SectorLaw
from mechwright_noncircular_gears.kinematics.laws.slider import SliderLaw
from mechwright_noncircular_gears.parameters import NoncircularParams

_STEPS = 12
"""Halvings: to a four-thousandth of the change."""

_STARTS = (0.0, 0.06, 0.25, 0.5)
"""Shares of which one works: a stroke that is too short for its return has none at 0."""

_DIGITS = 3
"""Of a value that is named."""

LEAST_STROKE = 0.1
"""Share of a stroke to which it is shortened at most: there the crank goes on as good as evenly."""

EASY_INDEX, EASY_RAMP = 200.0, 0.45
"""Degrees of the driver for a move of a Geneva wheel, and the ramp, with which the ratio changes little."""


def softened(params: NoncircularParams, share: float) -> dict[str, Any] | None:
    """Fields with which the ratio changes by a share of what it does; None where a law has no such fields."""
    if params.sector is not None:
        return _steadier(params, share)
    if params.law == "fourier":
        names = ("sines", "cosines")
        found = {name: tuple(_down(share * one) for one in params.value(name)) for name in names}
        return {name: values for name, values in found.items() if values}
    if params.law == "window":
        mean = params.lobes / params.mate_lobes
        return {"window_ratio": round(mean + share * (params.value("window_ratio") - mean), 4)}
    if params.law == "table" and params.nodes:
        mean = params.lobes / params.mate_lobes
        return {
            "nodes": tuple(
                (one, round(mean * one + share * (two - mean * one), 4)) for one, two in params.nodes
            )
        }
    if params.law == "ratio":
        law = law_of(params)
        assert isinstance(law, RatioFormula)  # noqa: S101 - of this law
        mean = params.lobes / params.mate_lobes
        return {"ratio": f"{(1 - share) * mean:.4g} + {share * law.factor:.4g}*({params.ratio})"}
    if params.law == "angle":
        mean = params.lobes / params.mate_lobes
        turning = "phi" if mean == 1 else f"{params.lobes}/{params.mate_lobes}*phi"
        return {"angle": f"{turning} + {share:.4g}*({params.angle} - {turning})"}
    if params.law == "slider":
        return _shorter(params, share)
    if params.law == "geneva":
        return _longer(params, share)
    return {"eccentricity": _down(share * params.value("eccentricity"))}


def _longer(params: NoncircularParams, share: float) -> dict[str, Any]:
    """A longer index with a longer ramp, and the blends that it leaves room for."""
    window = round(EASY_INDEX + share * (params.value("window") - EASY_INDEX), 1)
    fields = {"ramp": round(EASY_RAMP + share * (params.value("ramp") - EASY_RAMP), 3), "window": window}
    room = math.floor(MOST_HALF_TURN - window / 2)
    return fields if params.value("blend") <= room else {**fields, "blend": room}


def _steadier(params: NoncircularParams, share: float) -> dict[str, Any]:
    """Of sectors: nearer to the mean ratio over the travel, or a spiral to its middle ratio."""
    law = law_of(params)
    assert isinstance(law, SectorLaw)  # noqa: S101 - of a sector
    if params.law == "spiral":
        first, last = params.value("first_ratio"), params.value("last_ratio")
        middle = math.sqrt(first * last)
        ends = zip(("first_ratio", "last_ratio"), (first, last), strict=True)
        return {name: round(middle * (one / middle) ** share, 4) for name, one in ends}
    mean = law.turned / law.end
    if params.law == "table":
        pairs = params.nodes or ()
        return {"nodes": tuple((a, round(mean * a + share * (b - mean * a), 4)) for a, b in pairs)}
    steady = f"{(1 - share) * mean:.4g}"
    if params.law == "ratio":
        return {"ratio": f"{steady} + {share:.4g}*({params.ratio})"}
    return {"angle": f"{steady}*phi + {share:.4g}*({params.angle})"}


def _shorter(params: NoncircularParams, share: float) -> dict[str, Any]:
    """A shorter stroke about the crank angle of the greatest speed, in a window nearer to its own length."""
    law = law_of(params)
    assert isinstance(law, SliderLaw)  # noqa: S101 - of this law
    middle, kept_share = math.degrees(law.fastest), max(share, LEAST_STROKE)
    names = ("stroke_start", "stroke_end")
    ends = {name: round(middle + kept_share * (params.value(name) - middle), 1) for name in names}
    stroke = ends["stroke_end"] - ends["stroke_start"]
    return {**ends, "window": round(stroke + share * (params.value("window") - stroke), 1)}


def nearest(
    params: NoncircularParams, works: Callable[[NoncircularParams], bool], steps: int = _STEPS
) -> dict[str, Any] | None:
    """The fields of the nearest softer law that works, tried, in so many halvings; None without one."""

    def tried(share: float) -> dict[str, Any] | None:
        fields = softened(params, share)
        if fields is None:
            return None
        try:
            softer = type(params).model_validate({**params.model_dump(), **fields})
            return fields if works(softer) else None
        except (ValidationError, MechwrightError):
            return None

    for good in _STARTS:
        best = tried(good)
        if best is not None:
            break
    else:
        return None
    bad = 1.0
    for _ in range(steps):
        middle = (good + bad) / 2
        fields = tried(middle)
        if fields is None:
            bad = middle
        else:
            good, best = middle, fields
    return best


def said(fields: dict[str, Any] | None, otherwise: str) -> tuple[str, tuple[Change, ...]]:
    """Words and change of a remedy; without fields, what else helps."""
    if not fields:
        return otherwise, ()
    changes: Change = {f"parameters.{name}": _plain(value) for name, value in fields.items()}
    if "nodes" in fields:
        return "draw the nodes nearer to a constant ratio, as proposed", (changes,)
    words = " and ".join(f"{name} = {_text(value)}" for name, value in fields.items() if value is not None)
    return f"set {words}", (changes,)


def _plain(value: Any) -> Any:
    return [_plain(one) for one in value] if isinstance(value, tuple) else value


def _text(value: Any) -> str:
    if isinstance(value, str):
        return f'"{value}"'
    return f"[{', '.join(map(_text, value))}]" if isinstance(value, tuple) else f"{value:g}"


def _down(value: float) -> float:
    """To three digits, towards 0.

    >>> _down(0.12349), _down(-17.89)
    (0.123, -17.8)
    """
    if value == 0:
        return 0.0
    step = 10.0 ** (math.floor(math.log10(abs(value))) - _DIGITS + 1)
    return math.copysign(float(f"{math.floor(abs(value) / step) * step:.{_DIGITS}g}"), value)
