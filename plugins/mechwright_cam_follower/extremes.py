"""Least and greatest of what changes over the turn, refined between the places where rates jump."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from mechwright import Array, kept
from mechwright.mechanics.laws import Rates
from mechwright_cam_follower.cycle import Segment, cycle_of
from mechwright_cam_follower.geometry import Contact, geometry_of
from mechwright_cam_follower.loads import force_at
from mechwright_cam_follower.params import CamParams
from mechwright_cam_follower.sized import Sized, V

GRID, _ROUNDS = 65, 4
"""Samples of a smooth piece, and how often those about the best are drawn together: each time 32 times."""

HAIR = 1e-12
"""Share of a segment by which its samples stay before a break."""

LEAST_REGULAR = 0.02
"""Least 1 - R/ρ of a pitch curve, and least share of the base radius that a flat face leaves of ρ: less is an
edge that wears off at once."""

Measure = Callable[[Rates], Array]
"""What is looked at, (n,), of the rates at n angles; ``nan`` where there is nothing."""


@dataclass(frozen=True)
class Extreme:
    """A value and the angle of the cam, rad, where it is, counted about +z as the channel ``theta1`` is."""

    value: float
    angle: float


def greatest(params: CamParams, measure: Measure) -> Extreme:
    """The greatest value over the turn; of equal ones the first."""
    best = Extreme(-np.inf, 0.0)
    for segment in cycle_of(params).segments:
        for low, high in pairwise(segment.cuts):
            found = _climb(segment, measure, low, high)
            if found.value > best.value + 1e-12 * abs(found.value):
                best = found
    return Extreme(best.value, params.sense * best.angle + 0.0)  # never -0


def least(params: CamParams, measure: Measure) -> Extreme:
    """The least value over the turn."""
    found = greatest(params, lambda rates: -measure(rates))
    return Extreme(-found.value, found.angle)


def _climb(segment: Segment, measure: Measure, low: float, high: float) -> Extreme:
    a, b = low, high
    best = Extreme(-np.inf, segment.start)
    for _ in range(_ROUNDS):
        # The ends belong to this piece: a hair inside, a law gives its own side of a jump.
        u = np.clip(np.linspace(a, b, GRID), low + HAIR * (low > 0), high - HAIR)
        theta = segment.start + segment.width * u
        values = measure(segment.at(u))
        values = np.where(np.isnan(values), -np.inf, values)
        top = int(np.argmax(values))
        if values[top] > best.value:
            best = Extreme(float(values[top]), float(theta[top]))
        if segment.law is None:
            break
        a, b = float(u[max(top - 1, 0)]), float(u[min(top + 1, GRID - 1)])
    return best


@dataclass(frozen=True)
class Extremes:
    """Of a cam with its contact, in a design that closes; each is sought when it is asked for."""

    params: CamParams
    second: bool

    @cached_property
    def pressure(self) -> Extreme:
        """Greatest size of the pressure angle, rad."""
        return greatest(self.params, self._seen(lambda one: np.abs(one.pressure_angle)))

    @cached_property
    def regular(self) -> Extreme:
        """Least 1 - R/ρ of the pitch curve, above 0 where nothing is undercut; of a flat face least ρ, mm."""
        return least(self.params, self._seen(self._regularity))

    @cached_property
    def sharpest(self) -> Extreme:
        """Least radius of curvature of the cam where it is convex, mm; below 0 undercut."""
        return least(self.params, self._seen(self._convex))

    @cached_property
    def outermost(self) -> Extreme:
        """Greatest radius of the cam, mm."""
        return greatest(self.params, self._seen(lambda one: np.abs(one.point)))

    @cached_property
    def innermost(self) -> Extreme:
        """Least radius of the cam, mm."""
        return least(self.params, self._seen(lambda one: np.abs(one.point)))

    def _seen(self, what: Callable[[Contact], Array]) -> Measure:
        geometry = geometry_of(self.params)
        return lambda rates: what(geometry.contact(rates, self.second))

    def _regularity(self, contact: Contact) -> Array:
        return regularity_of(self.params, contact)

    def _convex(self, contact: Contact) -> Array:
        return convex_of(self.params, contact)


def regularity_of(params: Sized[V], contact: Contact) -> Array:
    """What :attr:`Extremes.regular` is the least of."""
    if params.contact == "flat":
        return contact.radius
    return np.asarray(1 - params.value("roller_radius") / contact.pitch_radius)


def convex_of(params: Sized[V], contact: Contact) -> Array:
    """What :attr:`Extremes.sharpest` is the least of: no number where the cam is hollow."""
    if params.contact == "flat":
        return contact.radius
    return np.where(contact.pitch_radius > 0, contact.radius, np.nan)


def cams_of(params: CamParams) -> tuple[bool, ...]:
    """Whether each cam of a design is the second of a pair."""
    return (False, True) if params.conjugate else (False,)


@kept
def extremes_of(params: CamParams, second: bool = False) -> Extremes:
    """Of the cam, or of the second one of a conjugate pair."""
    return Extremes(params, second)


@kept
def face_of(params: CamParams) -> tuple[float, float]:
    """From where to where a flat face is touched, mm; see :meth:`Geometry.along_face`."""
    geometry = geometry_of(params)

    def along(rates: Rates) -> Array:
        return geometry.along_face(geometry.contact(rates), rates)

    return least(params, along).value, greatest(params, along).value


@kept
def weakest_of(params: CamParams) -> Extreme:
    """Least force, N, or torque, N·m, that presses the follower to its cam."""
    return least(params, lambda rates: force_at(params, rates))


def regular_limit(params: Sized[V]) -> V | float:
    """Least regularity, see :class:`Extremes`."""
    return LEAST_REGULAR if params.contact == "roller" else LEAST_REGULAR * params.base_radius
