"""Columns of many cams: figures, refined as those of one cam are, and extremes of channels over samples."""

import math
from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.by_arrays import Answer
from mechwright.contracts.evaluation import SAMPLES
from mechwright.mechanics.laws import Rates
from mechwright_cam_follower.cycle import cycle_of
from mechwright_cam_follower.extremes import convex_of, greatest
from mechwright_cam_follower.loads import force_at
from mechwright_cam_follower.many import Cams, Course, Measure, extremes
from mechwright_cam_follower.motion import inverse
from mechwright_cam_follower.params import CamParams

_FIGURES: dict[str, tuple[Measure, float]] = {
    "pressure_angle_max": (lambda seen: np.abs(seen.contacts[0].pressure_angle), math.degrees(1.0)),
    "cam_radius_min": (lambda seen: -np.abs(seen.contacts[0].point), -1.0),
    "cam_radius_max": (lambda seen: np.abs(seen.contacts[0].point), 1.0),
    "curvature_radius_min": (lambda seen: -convex_of(seen.cams, seen.contacts[0]), -1.0),
    "contact_force_max": (lambda seen: seen.loads.force[0], 1.0),
    "contact_pressure_max": (lambda seen: seen.loads.pressure[0], 1.0),
    "torque_max": (lambda seen: np.abs(seen.loads.torque), 1.0),
    "press_min": (lambda seen: -force_at(seen.cams, seen.rates), -1.0),
}
"""Column to what it is the greatest of, and its factor."""

_RATES = {"velocity": ("v", 1), "acceleration": ("a", 2), "jerk": ("j", 3)}

_CHANNELS: dict[str, tuple[Measure, float]] = {
    "pressure_angle": (lambda seen: seen.contacts[0].pressure_angle, math.degrees(1.0)),
    "curvature": (lambda seen: inverse(seen.contacts[0].radius), 1.0),
    "pitch_curvature": (lambda seen: inverse(seen.contacts[0].pitch_radius), 1.0),
    "contact_force": (lambda seen: seen.loads.force[0], 1.0),
    "contact_pressure": (lambda seen: seen.loads.pressure[0], 1.0),
    "torque": (lambda seen: seen.loads.torque, 1.0),
}
"""Channel to what it shows, and its factor."""


def give_figures(found: Answer, columns: Collection[str], course: Course, left: NDArray[np.intp]) -> None:
    """Give the figures that are asked for of the designs ``left``, those of the course."""
    cams, common = course.cams, course.cams.common
    for name in columns:
        if name in _FIGURES:
            measure, factor = _FIGURES[name]
            most, sure = course.greatest(measure)
            found.doubt(~sure, left)
            found.give(name, factor * most, left)
        elif (rate := _RATES.get(name.removesuffix("_max"))) and name.endswith("_max"):
            order, power = rate
            found.give(name, _full(_peak(common, order) * cams.omega**power, cams), left)


def _peak(params: CamParams, order: str) -> float:
    """The greatest size of a rate, per radian of the cam."""

    def size(rates: Rates) -> Array:
        values: Array = np.abs(getattr(rates, order))
        return values

    return greatest(params, size).value


def _full(values: object, cams: Cams) -> Array:
    return np.broadcast_to(np.asarray(values, dtype=float).reshape(-1), len(cams))


def give_extremes(found: Answer, columns: Collection[str], cams: Cams) -> None:
    """Give extremes of channels, of the designs that are open."""
    left, common = found.left, cams.common
    some, theta = cams.some(left), np.linspace(0.0, math.tau, SAMPLES)
    rates = cycle_of(common).at(theta)
    asked = [(name, *name.rpartition(".")[::2]) for name in columns]
    sampled = sorted({channel for _, channel, _ in asked if channel in _CHANNELS})
    if common.contact == "flat" and "pitch_curvature" in sampled:
        sampled.remove("pitch_curvature")
    told = dict(zip(sampled, extremes(some, theta, [_CHANNELS[one][0] for one in sampled]), strict=True))
    powers = {"lift": ("s", 0), **_RATES}
    for name, channel, end in asked:
        greater = end == "greatest"
        if channel in told:
            found.give(name, _CHANNELS[channel][1] * told[channel][greater], left)
        elif channel in powers:
            order, power = powers[channel]
            values = getattr(rates, order)
            value = float(values.max() if greater else values.min())
            factor = math.degrees(1.0) if channel == "lift" and not common.translating else 1.0
            found.give(name, _full(factor * value * some.omega**power, some), left)
        elif channel == "time":
            found.give(name, _full((math.tau if greater else 0.0) / some.omega, some), left)
        elif channel == "omega1":
            found.give(name, _full(common.sense * some.omega, some), left)
        elif channel in {"alpha1", "jerk1"}:
            found.give(name, np.zeros(len(some)), left)
