"""Extremes of channels and peaks of the slider's rates over a period, compiled."""

import math
from collections.abc import Collection
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import column
from mechwright.contracts.sampling import SAMPLES
from mechwright.mechanics.planar.compiled_chain import CompiledChain
from mechwright_slider_crank.kinematics import peak_kernel
from mechwright_slider_crank.kinematics.course import drive_at, drives, is_lever
from mechwright_slider_crank.kinematics.mechanism import Mechanism

Extreme = tuple[Array, Array, str]
"""Least and greatest values (n,), and their unit."""


def drives_of(table: Mechanism) -> Array:
    """The drives of a table (n, 5) as a :class:`CompiledChain` takes them."""
    parts = (*drives(table), is_lever(table), table.given.acceleration_ratio, table.omega)
    return np.concatenate([column(part, table.size) for part in parts], axis=1)


def bars_of(table: Mechanism) -> Array:
    """The linkages of a table (n, 5): crank, rod and offset, mm, direction, rad, and the branch."""
    one = table.closed
    sizes = (one.crank, one.rod, one.offset, one.direction, one.branch)
    return np.concatenate([column(size, table.size) for size in sizes], axis=1)


def chain_of(table: Mechanism) -> CompiledChain:
    """The compiled machine of a table, or of one design."""
    return table.chain or CompiledChain(table.machine, table.order)


def extremes(table: Mechanism, names: Collection[str]) -> dict[str, Extreme]:
    """Those of channels of a table whose linkages keep to one assembly."""
    if np.any(table.closed.at_limit):
        return {}
    chain, given = chain_of(table), drives_of(table)
    found: dict[str, Extreme] = {}
    rows = _rows(table, chain)
    if chosen := [name for name in names if name in rows]:
        values = chain.extremes(given, [(rows[name][0], 1) for name in chosen], SAMPLES)
        found = {name: (*values[:, place].T, rows[name][1]) for place, name in enumerate(chosen)}
    varies = np.asarray(is_lever(table)) | (np.asarray(table.given.acceleration_ratio) != 0)
    for name in found.keys() & {"alpha_a", "jerk_a"}:
        *ends, unit = found[name]
        low, high = (np.where(column(varies, table.size)[:, 0] > 0, one, math.nan) for one in ends)
        found[name] = low, high, unit
    if "sigma" in found:
        *ends, unit = found["sigma"]
        low, high = (table.closed.counted(one[:, None])[:, 0] for one in ends)
        found["sigma"] = low, high, unit
    if "transmission_angle" in names:
        cosine = np.abs(chain.sampled(given, [chain.sine("wrist-pin") + 1], SAMPLES)[:, 0])
        angles = (np.arccos(np.minimum(1.0, one)) for one in (cosine.max(axis=1), cosine.min(axis=1)))
        found["transmission_angle"] = (*angles, "rad")
    if "time" in names:
        time, _ = drive_at(table, np.array([0.0, 1.0]))
        found["time"] = (*np.broadcast_to(time, (table.size, 2)).T, "s")
    return found


def _rows(table: Mechanism, chain: CompiledChain) -> dict[str, tuple[int, str]]:
    """The rows of channels in a chain, and their units."""
    turns, lengths = ("rad", "rad/s", "rad/s^2", "rad/s^3"), ("mm", "mm/s", "mm/s^2", "mm/s^3")
    way, rod = chain.way(table.closed.joints[-1]), chain.turning("rod")
    point = chain.point("rod", table.given.coupler_point)
    found = {name: (way + k, lengths[k]) for k, name in enumerate(("s", "v", "a", "jerk"))}
    for k, name in enumerate(("omega", "alpha", "jerk"), start=1):
        found[f"{name}_c"], found[f"{name}_a"] = (rod + 1 + k, turns[k]), (chain.drive + k, turns[k])
    for k, rate in enumerate(("", "v", "a", "j")):
        for axis, letter in enumerate("xy"):
            found[f"{rate}{letter}P"] = point + 2 * k + axis, lengths[k]
    return found | {"sigma": (chain.angle("rod"), "rad")}


def rate_peak(table: Mechanism, rate: int) -> Any:
    """The greatest size of the slider's velocity, ``rate`` 1, or acceleration, 2, over a period.

    Of a lever it is that among samples; of linkages at their limits it is not to be used.
    """
    found = peak_kernel.peaks(bars_of(table), drives_of(table), peak_kernel.CIRCLE, rate)[:, None]
    return found.item() if table.single else found
