"""Remedies for a cam whose moves are too quick for its follower: longer moves, softer ones, smaller ones.

Each is tried on the design. A lever keeps its proportions whatever the base circle is, so that a larger cam
is undercut as a smaller one is.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from mechwright import kept
from mechwright.contracts.finding import Change
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.rules.validity import bisected, is_valid

_RESTS = (0.5, 0.25, 0.1)
"""Shares of the dwells that stay where moves get longer."""

_SOFTER = ("modified-sine",)
"""The law with the lowest peaks that still starts and ends without a jump of its acceleration."""

_FARTHER = 2.0
"""Distance of the axis of a lever with a flat face, in radii of the base circle, with longer moves."""

_HALVINGS = 10
_LEAST = 0.2
"""Share of its moves below which a cam is no smaller one of the kind any more."""


@kept
def gentler(params: CamParams, *, steep: bool = False) -> tuple[Change, ...]:
    """Changes with which a cam closes and is not undercut, and with ``steep`` keeps to its pressure angle.

    Those that leave the moves as large as they are come first.
    """
    found = [change for change in _slower(params) if _helps(params, change, steep=steep)]
    return tuple(_named(change) for change in (*found[:2], *_smaller(params, steep=steep)))


def _named(change: Mapping[str, Any]) -> Change:
    return {
        f"parameters.{key}": list(value) if isinstance(value, tuple) else value
        for key, value in change.items()
    }


def _helps(params: CamParams, change: Mapping[str, Any], *, steep: bool) -> bool:
    return bool(is_valid(Mechanism(params.model_copy(update=dict(change))), steep=steep)[0])


def _slower(params: CamParams) -> Iterator[Mapping[str, Any]]:
    """The same moves over longer angles, with a softer law, and with the axis of a lever farther away."""
    ends = params.ends
    rests = [ends[place - 1] == end for place, end in enumerate(ends)]
    dwells = sum(angle for angle, rest in zip(params.angles, rests, strict=True) if rest)
    for share in _RESTS if dwells else ():
        longer = (360 - share * dwells) / (360 - dwells)
        angles = [
            angle * (share if rest else longer) for angle, rest in zip(params.angles, rests, strict=True)
        ]
        rounded = [round(angle, 1) for angle in angles]
        rounded[rests.index(False)] += round(360 - sum(rounded), 1)
        turn = {"angles": tuple(round(angle, 1) for angle in rounded)}
        yield turn
        if params.laws != _SOFTER and not {"table", "polynomial"} & set(params.laws):
            yield {**turn, "laws": _SOFTER}
            if not params.translating and params.contact == "flat" and params.centre_distance is None:
                yield {**turn, "laws": _SOFTER, "centre_distance": _FARTHER * params.base_radius}


def _smaller(params: CamParams, *, steep: bool) -> Iterator[Mapping[str, Any]]:
    """The largest moves that are in proportion to those of the design."""
    name = "lifts" if params.translating else "swings"

    def scaled(share: float) -> Mapping[str, Any]:
        return {name: tuple(math.floor(10 * share * end) / 10 for end in params.ends)}

    def good(share: float) -> bool:
        change = scaled(share)
        return max(change[name]) > 0 and _helps(params, change, steep=steep)

    if good(_LEAST):
        # Each share has a cycle of its own, so that no table has them together.
        yield scaled(bisected(lambda shares: np.array([good(*shares)]), 1.0, _LEAST, _HALVINGS, at_once=1))
