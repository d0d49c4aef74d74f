"""Where the follower is, where it touches, how it pushes, and how the cam is curved there.

Glossary
--------
base circle, prime circle
    Radius R_b of the cam, and R_b + R_r of the roller's centre, where the follower is lowest.
pitch curve
    Way of the roller's centre over the cam.
outward
    Unit normal of the cam at the contact, off the cam.
pressure angle α
    From the way of the contact's point of the follower, as it rises, to the outward normal.
ρ
    Radius of curvature, above 0 where the cam is convex.

The cam turns about 0 by σ θ, σ = ±1; all points and vectors are complex, mm, in fixed axes; primes are
derivatives over θ. Roller, with the centre P (Norton, Design of Machinery, equations 8.31 and 8.33; here in
complex numbers, which hold for slides and levers alike):

    slide   P = e + i (√((R_b + R_r)² - e²) + s)
    lever   P = c - L exp(-i (γ0 + ψ)),  cos γ0 = (c² + L² - (R_b + R_r)²)/(2 c L)
    V = P' - i σ P,  A = P'' - 2 i σ P' - P

Flat face at the distance h from the cam's axis, with the normal exp(i ν), seen from the cam under β = ν - σ θ
(support function of a convex curve):

    slide   h = R_b + s,             ν = π/2
    lever   h = c cos ν - f,         ν = ν0 - ψ,  cos ν0 = (R_b + f)/c
    contact (h + i h1) exp(i ν),  h1 = h'/β',  ρ = h + (h'' - h1 β'')/β'²
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Generic

import numpy as np

from mechwright import Array
from mechwright.mechanics.envelope import Points, left_normal, touched, way_curvature
from mechwright.mechanics.laws import Rates
from mechwright_cam_follower.sized import Sized, V


@dataclass(frozen=True)
class Contact:
    """One contact at each angle θ (n,) of the cam.

    Parameters
    ----------
    centre
        Of the roller; of a flat face the contact itself.
    point
        The contact.
    outward
        Normal off the cam.
    direction
        Unit vector in which the contact's point of the follower rises.
    lever
        How far that point goes for each unit of lift: 1 of a slide, of a lever its distance from the axis.
    pitch_radius, radius
        ρ of pitch curve and cam, mm; those of a flat face are one.
    """

    centre: Points
    point: Points
    outward: Points
    direction: Points
    lever: Array
    pitch_radius: Array
    radius: Array

    @cached_property
    def pressure_angle(self) -> Array:
        """α, rad, above 0 where the cam pushes ahead of where it turns to."""
        found: Array = np.angle(self.outward * np.conj(self.direction))
        return found

    @property
    def share(self) -> Array:
        """Work of one newton of the contact for each unit of lift: lever × cos α, mm or 1."""
        found: Array = self.lever * (self.outward * np.conj(self.direction)).real
        return found


@dataclass(frozen=True)
class Geometry(Generic[V]):
    """The fixed sizes of a design, mm and rad, or of many: all that is asked of rates (1, k) is (n, k) then.

    Parameters
    ----------
    start
        Height of the follower over the cam's axis where it is lowest; of a lever γ0 or ν0.
    apart
        From the first roller to the second of a conjugate pair, downwards; of a lever the angle between its
        arms. Both cams then have one base circle.
    """

    params: Sized[V]
    start: V
    apart: V

    def contact(self, rates: Rates, second: bool = False) -> Contact:
        """The contact of the cam, or that of the second cam of a conjugate pair."""
        if self.params.contact == "flat":
            return self._flat(rates)
        sigma, radius = self.params.sense, self.params.value("roller_radius")
        if rates.s.ndim > 1:
            return self._many(rates, radius, second)
        centre, first, after, direction, lever = self.roller(rates, second)
        velocity = first - 1j * sigma * centre
        acceleration = after - 2j * sigma * first - centre
        speed = np.abs(velocity)
        # Over the cam, rollers go against its turn: the cam is on their right where σ is 1.
        left = left_normal(velocity, speed)
        with np.errstate(divide="ignore"):
            pitch = -sigma / way_curvature(velocity, acceleration, speed)
        point = touched(centre, left, radius, -sigma)
        return Contact(centre, point, sigma * left, direction, lever, pitch, pitch - radius)

    def _many(self, rates: Rates, radius: V, second: bool) -> Contact:
        """The same of many cams."""
        from mechwright_cam_follower.contact_kernels import contacts

        params, slides = self.params, self.params.translating
        place = params.value("offset" if slides else "centre_distance")
        arm = 1.0 if slides else params.value("arm_length")
        start = self.start - self.apart if second else self.start
        sign = -1.0 if second else 1.0
        found = contacts(slides, params.sense, sign, place, arm, start, radius, rates)
        centre, point, outward, direction, pitch = found
        lever = np.broadcast_to(np.asarray(arm, dtype=float), pitch.shape)
        return Contact(centre, point, outward, direction, lever, pitch, pitch - radius)

    def roller(self, rates: Rates, second: bool = False) -> tuple[Points, Points, Points, Points, Array]:
        """Centre of a roller, its first two derivatives, its direction as it nears or leaves, its lever.

        The second roller of a pair goes towards the cam where the first one goes away.
        """
        sign = -1.0 if second else 1.0
        if self.params.translating:
            height = self.start + rates.s - (self.apart if second else 0.0)
            centre: Points = np.asarray(self.params.value("offset") + 1j * height, dtype=np.complex128)
            up: Points = np.broadcast_to(np.complex128(1j * sign), centre.shape)
            first: Points = np.asarray(1j * rates.v)
            after: Points = np.asarray(1j * rates.a)
            return centre, first, after, up, np.ones_like(rates.s)
        arm = self.params.value("arm_length")
        turn: Points = np.exp(-1j * (self.start + rates.s - (self.apart if second else 0.0)))
        centre = self.params.value("centre_distance") - arm * turn
        first = 1j * arm * rates.v * turn
        after = arm * (1j * rates.a + rates.v**2) * turn
        way: Points = sign * 1j * turn
        return centre, first, after, way, arm + np.zeros_like(rates.s)

    def _flat(self, rates: Rates) -> Contact:
        params, sigma = self.params, self.params.sense
        normal: Points
        if params.translating:
            zero = np.zeros_like(rates.s)
            normal, h, h_1, h_2 = np.full(zero.shape, 1j), params.base_radius + rates.s, rates.v, rates.a
            beta_1, beta_2 = zero - sigma, zero
        else:
            axis, nu = params.value("centre_distance"), self.start - rates.s
            normal, h = np.exp(1j * nu), axis * np.cos(nu) - params.face
            h_1 = axis * np.sin(nu) * rates.v
            h_2 = axis * (np.sin(nu) * rates.a - np.cos(nu) * rates.v**2)
            beta_1, beta_2 = -rates.v - sigma, -rates.a
        with np.errstate(divide="ignore", invalid="ignore"):
            along = h_1 / beta_1
            radius = h + (h_2 - along * beta_2) / beta_1**2
        point: Points = (h + 1j * along) * normal
        if params.translating:
            return Contact(point, point, normal, normal, np.ones_like(h), radius, radius)
        # The lever rises clockwise about its axis.
        way: Points = -1j * (point - axis)
        lever = np.abs(way)
        return Contact(point, point, normal, way / lever, lever, radius, radius)

    def along_face(self, contact: Contact, rates: Rates) -> Array:
        """Where a flat face is touched, mm: from the follower's middle to +x, of a lever from its axis."""
        if self.params.translating:
            return np.asarray(contact.point.real)
        normal = np.exp(1j * (self.start - rates.s))
        way = (contact.point - self.params.value("centre_distance")) * np.conj(normal)
        return np.asarray(way.imag)


def _root(square: V) -> V:
    return math.sqrt(square) if isinstance(square, float) else np.sqrt(square)


def _arccos(cosine: V) -> V:
    return math.acos(cosine) if isinstance(cosine, float) else np.arccos(cosine)


def prime_radius(params: Sized[V]) -> V:
    """Radius of the prime circle, mm; of a flat face that of the base circle."""
    return (
        params.base_radius + params.value("roller_radius")
        if params.contact == "roller"
        else params.base_radius
    )


def geometry_of(params: Sized[V]) -> Geometry[V]:
    """Sizes of designs that close, as ``closure_findings`` says; no numbers where one of many does not."""
    start = start_of(params)
    if params.translating:
        return Geometry(params, start, 2 * start + params.stroke)
    apart = 2 * start + math.radians(params.stroke)
    return Geometry(params, start, apart if params.contact == "roller" else 0 * start)


def start_of(params: Sized[V]) -> V:
    """See :class:`Geometry`."""
    prime = prime_radius(params)
    if params.translating:
        return prime if params.contact == "flat" else _root(prime**2 - params.value("offset") ** 2)
    axis = params.value("centre_distance")
    if params.contact == "flat":
        return _arccos((prime + params.face) / axis)
    arm = params.value("arm_length")
    return _arccos((axis**2 + arm**2 - prime**2) / (2 * axis * arm))
