"""Figures and extremes of channels of many designs, as far as formulas tell them."""

import math
from collections.abc import Callable, Collection, Mapping

import numpy as np

from mechwright import Array
from mechwright.contracts.evaluation import told
from mechwright.contracts.sampling import SAMPLES
from mechwright.contracts.stretch import travelled
from mechwright_geneva.contact import peak_of, sampled
from mechwright_geneva.figures import sizes_and_times
from mechwright_geneva.many import Mechanisms
from mechwright_geneva.motion import channels_of

PEAKS = {"contact_force_max": "force", "contact_pressure_max": "pressure", "crank_torque_max": "crank_torque"}
"""Columns that are peaks of the contact, to the name of its quantity."""

ENDS: Mapping[str, Callable[[Array], Array]] = {
    "least": lambda values: values.min(axis=-1),
    "greatest": lambda values: values.max(axis=-1),
}


TURN = travelled(math.tau, SAMPLES)
"""Angles of a driver that turns forwards, rad."""


def columns_of(m: Mechanisms, columns: Collection[str]) -> dict[str, Array] | None:
    """The columns (m,) of allowed designs; None where one of them has to be sought design by design."""
    size = len(m)
    sizes = sizes_and_times(m)
    found = {
        name: np.array(np.broadcast_to(np.ravel(told(*sizes[name])), size))
        for name in columns
        if name in sizes
    }
    peaks = [name for name in columns if name in PEAKS]
    extremes = [name for name in columns if name not in found and name not in peaks]
    if peaks:
        values = m.each(lambda block: _peaks(block, peaks))
        found |= {name: values[:, number] for number, name in enumerate(peaks)}
    if extremes:
        first = channels_of(m.rows(np.arange(1)), TURN)
        if m.driver.sense < 0 or not all(_is_extreme(name, first) for name in extremes):
            return None
        values = m.each(lambda block: _extremes(block, extremes))
        found |= {name: values[:, number] for number, name in enumerate(extremes)}
    rollers = np.broadcast_to(m.params.roller_length, (size, 1))[:, 0] > 0
    for name in found:
        if name.startswith("contact_pressure"):
            found[name] = np.where(rollers, found[name], np.nan)
    return found


def _is_extreme(name: str, channels: Mapping[str, object]) -> bool:
    channel, _, end = name.rpartition(".")
    return channel in channels and channel != "theta_d" and end in ENDS


def _peaks(m: Mechanisms, names: Collection[str]) -> Array:
    _, ((stroke, found),) = sampled(m)
    return np.concatenate([peak_of(m, found, stroke, PEAKS[name])[0] for name in names], axis=-1)


def _extremes(m: Mechanisms, names: Collection[str]) -> Array:
    channels = channels_of(m, TURN)
    found = []
    for name in names:
        channel, _, end = name.rpartition(".")
        one = channels[channel]
        values = np.broadcast_to(ENDS[end](one.values), len(m))
        found.append(told(values, one.unit))
    return np.stack(found, axis=-1)
