"""What the fields of a law, a ring and sectors have to say together, and the nodes of a law by table."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

from mechwright.mechanics.formula import Formula, FormulaError
from mechwright_noncircular_gears.fields import LAW_FIELDS, MOST_HALF_TURN, RING_FIELDS, SECTOR_LAWS


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


LEAST_STEP = 1.0
"""Degrees between the angles of a table: closer ones ask for a ratio that the teeth cannot follow."""


LEAST_OPEN = 6
"""Nodes over less than a turn: a spline of degree five goes through no fewer."""


def check_nodes(nodes: Sequence[tuple[float, float]] | None, lobes: int, mate_lobes: int) -> None:
    """Raise ValueError unless pairs [φ, ψ], degrees, make a lobe of gears with so many lobes."""
    if nodes is None:
        raise ValueError('law = "table" needs nodes, pairs of angles from [0, 0]')
    if nodes[0] != (0.0, 0.0):
        raise ValueError(f"nodes begin at {list(nodes[0])}; a lobe begins at [0, 0]")
    ends = (360.0 / lobes, 360.0 / mate_lobes)
    if nodes[-1][0] >= ends[0]:
        turns = ""
        if nodes[-1][0] > 360:
            turns = ": of several turns it is no plane gear, for its own body stands in the way of its mate"
        raise ValueError(
            f"nodes reach {nodes[-1][0]:g} degrees of the driver, and a lobe ends at "
            f"[{ends[0]:g}, {ends[1]:g}], which is no node{turns}; leave out what lies there and beyond"
        )
    if len(nodes) > 2 and nodes[-1][0] <= math.tau:
        raise ValueError(
            f"nodes end at {nodes[-1][0]:g} degrees of the driver's {ends[0]:g}, as angles in rad would; "
            "write them in degrees, 57.29578 times as large, or give nodes over all of the lobe"
        )
    _rising((*nodes, ends))


def check_open_nodes(nodes: Sequence[tuple[float, float]] | None, travel: float) -> None:
    """Raise ValueError unless pairs [φ, ψ], degrees, are a table over a travel, degrees, of the driver."""
    if nodes is None:
        raise ValueError('law = "table" needs nodes, pairs of angles from [0, 0]')
    if nodes[0] != (0.0, 0.0):
        raise ValueError(f"nodes begin at {list(nodes[0])}; the travel begins at [0, 0]")
    if nodes[-1][0] != travel:
        raise ValueError(
            f"nodes end at {nodes[-1][0]:g} degrees of the driver, and the travel at {travel:g}; "
            f"set sector = {nodes[-1][0]:g}"
        )
    if len(nodes) < LEAST_OPEN:
        raise ValueError(
            f"{len(nodes)} nodes are too few for a table over less than a turn; give {LEAST_OPEN}"
        )
    _rising(nodes)


def _rising(nodes: Sequence[tuple[float, float]]) -> None:
    for one, other in pairwise(nodes):
        if other[0] - one[0] < LEAST_STEP:
            raise ValueError(
                f"nodes {list(one)} and {list(other)} stand less than {LEAST_STEP:g} degree apart, or go "
                "back; give the driver's angles in rising order"
            )
        if other[1] <= one[1]:
            raise ValueError(
                f"nodes {list(one)} and {list(other)} hold the driven gear or turn it back, which teeth "
                "cannot; make the second angles rise"
            )
