"""Figures of a four-bar, or of a table of them."""

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from mechwright.contracts.figure import Figure
from mechwright.mechanics.linkage.kinematics.period import period_of
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright.mechanics.planar.course import counted_from
from mechwright_four_bar.kinematics.reach import toggles
from mechwright_four_bar.table import FourBarTable


def figures_of(table: FourBarTable) -> dict[str, Figure]:
    """Those of lengths and angles; NaN of those that a crank or a lever has not."""
    bar, ways = table.bar, table.closed_ways

    def of_lever(value: Callable[[], Any]) -> Callable[[], Any]:
        return lambda: np.where(table.lever, np.degrees(value()), math.nan)

    def of_rocker(value: Callable[[Any], Any]) -> Callable[[], Any]:
        rockers = _crank_rocker(table)
        if not rockers.any():
            return lambda: math.nan
        return lambda: np.where(rockers, value(table.once("limits", bar.folding)), math.nan)

    def counted(angle: Any) -> Any:
        return counted_from(ways.start, ways.travel, angle + bar.ground_angle)

    end = ways.start + ways.travel
    return {
        "least_transmission_angle": Figure(lambda: table.transmission[0], "rad"),
        "greatest_transmission_angle": Figure(lambda: table.transmission[1], "rad"),
        "grashof_excess": Figure(lambda: bar.grashof_excess, "mm"),
        "swing_from": Figure(of_lever(lambda: np.minimum(ways.start, end)), "deg"),
        "swing_to": Figure(of_lever(lambda: np.maximum(ways.start, end)), "deg"),
        "input_range": Figure(of_lever(lambda: np.abs(ways.travel)), "deg"),
        "toggle_low": Figure(of_lever(lambda: toggles(bar, ways)[0]), "deg"),
        "toggle_high": Figure(of_lever(lambda: toggles(bar, ways)[1]), "deg"),
        "swing": Figure(partial(_swing, table, of_rocker(lambda one: one.swing)), "rad"),
        "time_ratio": Figure(of_rocker(lambda one: one.time_ratio)),
        "limit_extended": Figure(of_rocker(lambda one: counted(one.extended)), "rad"),
        "limit_folded": Figure(of_rocker(lambda one: counted(one.folded)), "rad"),
    }


def _crank_rocker(table: FourBarTable) -> Any:
    """Which have limits, as :attr:`FourBar.kind` has it: a crank that turns and alone is the shortest."""
    bar = table.bar
    a, *others = bar.lengths
    shortest = (a < np.minimum.reduce(np.broadcast_arrays(*others))) & (bar.grashof_excess > 0)
    return np.asarray(bar.closes & shortest & ~np.asarray(bar.lines_up) & ~table.lever)


def _swing(table: FourBarTable, of_rockers: Callable[[], Any]) -> Any:
    """Of the follower: between the limits of crank-rockers, or with the swing of one lever."""
    if table.single and table.lever:
        return np.ptp(period_of(table, PEAK_SAMPLES).solution.bodies["follower"].turning.theta)
    return of_rockers()
