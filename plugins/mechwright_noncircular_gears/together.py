"""What the fields of a law, a ring and sectors say together."""

import math
from typing import Any

from mechwright.mechanics.formula import Formula, FormulaError
from mechwright_noncircular_gears.fields import LAW_FIELDS, MOST_HALF_TURN, RING_FIELDS, SECTOR_LAWS
from mechwright_noncircular_gears.nodes import check_nodes, check_open_nodes


def pair_together(params: Any) -> None:
    """Raise ValueError where a law, a ring or sectors lack something, or fields are not theirs."""
    _law_together(params)
    _ring_together(params)
    _sector_together(params)


def _ring_together(params: Any) -> None:
    if not params.internal:
        for name in RING_FIELDS:
            if getattr(params, name) is not None:
                raise ValueError(f"{name} is for a ring; leave it out, or set internal = true")
        return
    if params.mate_lobes <= params.lobes:
        raise ValueError(
            f"a ring goes round slower than the gear in it, and has more lobes; set mate_lobes to "
            f"{params.lobes + 1} or more"
        )
    if params.cutter == "rack":
        raise ValueError('no rack goes into a ring; leave cutter out, or set cutter = "shaper"')
    if params.ring_holes == 0 and params.ring_hole is not None:
        raise ValueError("ring_hole is the size of no hole; leave it out, or set ring_holes")


def _sector_together(params: Any) -> None:
    if params.sector is None:
        if params.law == "spiral":
            raise ValueError('law = "spiral" does not close; set sector, the travel of the driver')
        if params.sector_hub is not None:
            raise ValueError("sector_hub is for sectors; leave it out, or set sector")
        return
    if params.law not in SECTOR_LAWS:
        raise ValueError(
            f'law = "{params.law}" goes all the way round; leave sector out, or take one of '
            + ", ".join(SECTOR_LAWS)
        )
    if params.internal or params.lobes != 1 or params.mate_lobes != 1:
        raise ValueError("sectors are gears beside each other and have no lobes; leave sector out")


def _law_together(params: Any) -> None:
    own = LAW_FIELDS[params.law]
    for law, names in LAW_FIELDS.items():
        for name in names:
            if name not in own and getattr(params, name) is not None:
                raise ValueError(f'{name} is for law = "{law}"; leave it out, or set that law')
    if params.law in {"slider", "geneva", "eccentric-circle"} and params.lobes != 1:
        raise ValueError(f'law = "{params.law}" has one lobe on the driver; set lobes = 1')
    if params.law in {"slider", "geneva"} and params.internal:
        raise ValueError(
            f'law = "{params.law}" turns its crank once a turn, and a ring goes round slower; '
            "set internal = false and mate_lobes = 1"
        )
    if params.law in {"slider", "geneva"} and params.mate_lobes != 1:
        raise ValueError(f'law = "{params.law}" turns its crank once a turn; set mate_lobes = 1')
    if params.law == "geneva" and params.value("window") / 2 + params.value("blend") > MOST_HALF_TURN:
        most = math.floor(MOST_HALF_TURN - params.value("window") / 2)
        raise ValueError(
            f"window / 2 and blend take {params.value('window') / 2 + params.value('blend'):g} degrees, "
            f"at most {MOST_HALF_TURN:g}; make "
            + (f"blend {most}, or window smaller" if most > 0 else "window smaller")
        )
    if params.law == "slider" and params.value("stroke_start") >= params.value("stroke_end"):
        start, end = params.value("stroke_start"), params.value("stroke_end")
        raise ValueError(f"stroke_end of {end:g} must be above stroke_start of {start:g}; exchange them")
    if params.law == "table":
        if params.sector is None:
            check_nodes(params.nodes, params.lobes, params.mate_lobes)
        else:
            check_open_nodes(params.nodes, params.sector)
    if params.law in {"ratio", "angle"}:
        _formula(params, getattr(params, params.law))


def _formula(params: Any, text: str | None) -> None:
    if text is None:
        raise ValueError(f'law = "{params.law}" needs {params.law}, a formula of phi')
    try:
        Formula(text, "phi")
    except FormulaError as error:
        raise ValueError(f"{params.law}: {error}") from None
