"""Columns of many cams: figures, refined as those of one cam are, and extremes of channels over samples."""

import math
from collections.abc import Callable, Collection

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.by_arrays import Answer
from mechwright.contracts.sampling import SAMPLES
from mechwright.mechanics.laws import Rates
from mechwright_cam_follower.cycle import cycle_of
from mechwright_cam_follower.extremes import convex_of, greatest
from mechwright_cam_follower.geometry import Contact
from mechwright_cam_follower.loads import force_at
from mechwright_cam_follower.many import Cams, Course, Measure, Seen, extremes
from mechwright_cam_follower.motion import inverse
from mechwright_cam_follower.params import CamParams

_FIGURES: dict[str, tuple[Measure, float]] = {
    "contact_force_max": (lambda seen: np.maximum.reduce(seen.loads.force), 1.0),
    "contact_pressure_max": (lambda seen: np.maximum.reduce(seen.loads.pressure), 1.0),
    "torque_max": (lambda seen: np.abs(seen.loads.torque), 1.0),
    "press_min": (lambda seen: -force_at(seen.cams, seen.rates), -1.0),
}
"""Column to what it is the greatest of, and its factor."""

_OF_CAM: dict[str, tuple[Callable[[Seen, Contact], Array], float]] = {
    "pressure_angle_max": (lambda _, one: np.abs(one.pressure_angle), math.degrees(1.0)),
    "cam_radius_min": (lambda _, one: -np.abs(one.point), -1.0),
    "cam_radius_max": (lambda _, one: np.abs(one.point), 1.0),
    "curvature_radius_min": (lambda seen, one: -convex_of(seen.cams, one), -1.0),
}
"""The same of each cam; those of the second of a pair have a 2 behind."""

_RATES = {"velocity": ("v", 1), "acceleration": ("a", 2), "jerk": ("j", 3)}

_CHANNELS: dict[str, tuple[Callable[[Seen, int], Array], float]] = {
    "pressure_angle": (lambda seen, cam: seen.contacts[cam].pressure_angle, math.degrees(1.0)),
    "curvature": (lambda seen, cam: inverse(seen.contacts[cam].radius), 1.0),
    "pitch_curvature": (lambda seen, cam: inverse(seen.contacts[cam].pitch_radius), 1.0),
    "contact_force": (lambda seen, cam: seen.loads.force[cam], 1.0),
    "contact_pressure": (lambda seen, cam: seen.loads.pressure[cam], 1.0),
}
"""Channel to what it shows of a cam, and its factor; those of the second of a pair have a 2 behind."""


def _figure(name: str, params: CamParams) -> tuple[Measure, float] | None:
    """What a column is the greatest of, and its factor; None of one that is no such figure."""
    if name in _FIGURES:
        return None if name == "press_min" and params.conjugate else _FIGURES[name]
    own, cam = _cam_of(name, params)
    if own not in _OF_CAM:
        return None
    measure, factor = _OF_CAM[own]
    return lambda seen: measure(seen, seen.contacts[cam]), factor


def _channel(name: str, params: CamParams) -> tuple[Measure, float] | None:
    """What a channel shows, and its factor; None of one that has no contact in it."""
    if name == "torque":
        return lambda seen: seen.loads.torque, 1.0
    own, cam = _cam_of(name, params)
    if own not in _CHANNELS or (own == "pitch_curvature" and params.contact == "flat"):
        return None
    measure, factor = _CHANNELS[own]
    return lambda seen: measure(seen, cam), factor


def _cam_of(name: str, params: CamParams) -> tuple[str, int]:
    """The name without the number of its cam, and that counted from 0."""
    return (name[:-1], 1) if params.conjugate and name.endswith("2") else (name, 0)


def give_figures(found: Answer, columns: Collection[str], course: Course, left: NDArray[np.intp]) -> None:
    """Give the figures that are asked for of the designs ``left``, those of the course."""
    cams, common = course.cams, course.cams.common
    for name in columns:
        if figure := _figure(name, common):
            measure, factor = figure
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
    shown = {channel: one for _, channel, _ in asked if (one := _channel(channel, common))}
    told = dict(zip(shown, extremes(some, theta, [one for one, _ in shown.values()]), strict=True))
    powers = {"lift": ("s", 0), **_RATES}
    for name, channel, end in asked:
        greater = end == "greatest"
        if channel in told:
            found.give(name, shown[channel][1] * told[channel][greater], left)
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
