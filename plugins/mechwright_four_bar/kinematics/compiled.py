"""Channels of a table of four-bars by its compiled chain."""

from collections.abc import Sequence

import numpy as np

from mechwright import Array
from mechwright.mechanics.linkage.kinematics.channel_extremes import drives_of
from mechwright.mechanics.planar.compiled_chain import CompiledChain
from mechwright_four_bar.table import FourBarTable

NEAR_TOGGLE = 1e-2
"""Transmission angle, rad, below which rounding tells in the rates of compiled chains."""

RATES = {"omega": "rad/s", "alpha": "rad/s^2", "jerk": "rad/s^3"}
PLACES = {"": "mm", "v": "mm/s", "a": "mm/s^2", "j": "mm/s^3"}


def rows_of(table: FourBarTable) -> dict[str, tuple[int, str]]:
    """Channel to its row in the compiled chain, and its unit."""
    chain, found = _chain(table), {}
    firsts = {"a": chain.drive + 1, "c": chain.turning("coupler") + 2, "b": chain.turning("follower") + 2}
    for link, first in firsts.items():
        for place, (rate, unit) in enumerate(RATES.items()):
            found[f"{rate}_{link}"] = first + place, unit
    found["sigma"], found["psi"] = (chain.angle("coupler"), "rad"), (chain.angle("follower"), "rad")
    found["transmission_angle"] = chain.sine("B") + 1, "rad"
    if table.params.coupler_point is not None:
        first = chain.point("coupler", table.linkage.points["coupler"]["coupler-point"])
        for place, (rate, unit) in enumerate(PLACES.items()):
            found[f"{rate}xP"], found[f"{rate}yP"] = (first + 2 * place, unit), (first + 2 * place + 1, unit)
    return found


def _chain(table: FourBarTable) -> CompiledChain:
    chain = table.chain
    assert chain is not None  # noqa: S101 - a table of dyads
    return chain


def compiled(table: FourBarTable, names: Sequence[str], samples: int) -> Array:
    """Least and greatest values (n, k, 2) of channels, of so many samples of a period."""
    rows, drives, chain = rows_of(table), drives_of(table), _chain(table)
    found = chain.extremes(drives, [(rows[name][0], 1) for name in names], samples)
    if "transmission_angle" in names:
        cosines = np.abs(chain.sampled(drives, [rows["transmission_angle"][0]], samples)[:, 0])
        ends = [np.minimum(1.0, cosines.max(axis=1)), cosines.min(axis=1)]
        found[:, names.index("transmission_angle")] = np.arccos(np.stack(ends, axis=1))
    return found
