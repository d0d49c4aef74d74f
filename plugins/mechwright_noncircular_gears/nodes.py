"""What the nodes of a law by table have to be."""

import math
from collections.abc import Sequence
from itertools import pairwise

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
