"""What is measured over the turn of a cam: angles, radii, the face, forces."""

from collections.abc import Callable
from typing import Any

import numpy as np

from mechwright import Array
from mechwright_cam_follower.kinematics.contact import Contact, along_face
from mechwright_cam_follower.kinematics.forces import force_at
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.kinematics.turn import Extreme, Measure, Samples, greatest, least

LEAST_REGULAR = 0.02
"""Least 1 - R/ρ of a pitch curve, and least share of the base radius that a flat face leaves of ρ: less is an
edge that wears off at once."""


def pressure_peak(m: Mechanism, cam: int = 0) -> Extreme:
    """Give the greatest size of a cam's pressure angle, rad."""
    return greatest(m, ("pressure", cam), lambda one: np.abs(one.contacts[cam].pressure_angle))


def outermost(m: Mechanism, cam: int = 0) -> Extreme:
    """Give the greatest radius of a cam, mm."""
    return greatest(m, ("radius", cam), lambda one: one.contacts[cam].distance)


def innermost(m: Mechanism, cam: int = 0) -> Extreme:
    """Give the least radius of a cam, mm."""
    return least(m, ("radius", cam), lambda one: one.contacts[cam].distance)


def regularity(m: Mechanism, cam: int = 0) -> Extreme:
    """Give the least 1 - R/ρ of the pitch curve, above 0 without undercut; of a flat face the least ρ, mm."""
    return least(m, ("regular", cam), lambda one: _regularity(one.m, one.contacts[cam]))


def _regularity(m: Mechanism, contact: Contact) -> Array:
    return contact.radius if m.flat else np.asarray(1 - m.roller / contact.pitch_radius)


def sharpest(m: Mechanism, cam: int = 0) -> Extreme:
    """Give the least radius of curvature, mm, where a cam is convex; below 0 it is undercut."""
    return least(m, ("sharpest", cam), lambda one: _convex(one.m, one.contacts[cam]))


def _convex(m: Mechanism, contact: Contact) -> Array:
    """Give the radius of curvature; no number where the cam is hollow."""
    return contact.radius if m.flat else np.where(contact.pitch_radius > 0, contact.radius, np.nan)


def regular_limit(m: Mechanism) -> Any:
    """Give the least regularity that is no edge."""
    return LEAST_REGULAR * m.given.base_radius if m.flat else LEAST_REGULAR


def of_cams(m: Mechanism, extreme: Callable[[Mechanism, int], Extreme]) -> Array:
    """Give the values (n, c) of an extreme of each cam."""
    values = [np.reshape(extreme(m, cam).value, (-1, 1)) for cam in m.cams]
    return np.concatenate(values, axis=1)


def face_ends(m: Mechanism) -> tuple[Any, Any]:
    """Give from where to where a flat face is touched, mm: see :func:`along_face`."""

    def along(one: Samples) -> Array:
        return along_face(one.m, one.contacts[0], one.rates)

    return least(m, "face", along).value, greatest(m, "face", along).value


def weakest(m: Mechanism) -> Extreme:
    """Give the least force, N, or torque, N·m, that presses the follower to its cam."""
    return least(m, "press", lambda one: force_at(one.m, one.rates))


LOADS: dict[str, Measure] = {
    "contact_force_max": lambda one: np.maximum.reduce(one.loads.force),
    "contact_pressure_max": lambda one: np.maximum.reduce(one.loads.pressure),
    "torque_max": lambda one: np.abs(one.loads.torque),
}
"""Figure to what it is the greatest of: N, MPa, N·m."""


def load_peak(m: Mechanism, name: str) -> Extreme:
    """Give the greatest contact force, contact pressure or torque, by the name of the figure."""
    return greatest(m, name, LOADS[name])
