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

The cam turns about 0 by σ θ, σ = ±1; points and vectors are in fixed axes, mm; primes are derivatives over θ.
Roller, with the centre P (Norton, Design of Machinery, equations 8.31 and 8.33; here in complex numbers,
which hold for slides and levers alike):

    slide   P = e + i (√((R_b + R_r)² - e²) + s)
    lever   P = c - L exp(-i (γ0 + ψ)),  cos γ0 = (c² + L² - (R_b + R_r)²)/(2 c L)
    V = P' - i σ P,  A = P'' - 2 i σ P' - P,  ρ = -σ |V|³/Im(conj(V) A)

Flat face at the distance h from the cam's axis, with the normal exp(i ν), seen from the cam under β = ν - σ θ
(support function of a convex curve):

    slide   h = R_b + s,             ν = π/2
    lever   h = c cos ν - f,         ν = ν0 - ψ,  cos ν0 = (R_b + f)/c
    contact (h + i h1) exp(i ν),  h1 = h'/β',  ρ = h + (h'' - h1 β'')/β'²

Formulas are in real numbers: a table of designs has thousands of contacts.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.mechanics.envelope import Points
from mechwright.mechanics.laws import Rates
from mechwright_cam_follower.kinematics.mechanism import Mechanism

TINY = 1e-300
"""Keeps the normal of a roller that stands still over its cam a number, which is 0."""

Vector = tuple[Any, Any]
"""Its parts along x and y, which broadcast to (k,), of a table to (n, k)."""


@dataclass(frozen=True)
class Contact:
    """One contact at each angle θ (k,) of the cam; of a table of designs (n, k).

    Parameters
    ----------
    middle
        Centre of the roller; of a flat face the contact itself.
    normal
        Unit vector off the cam.
    way
        Unit vector in which the contact's point of the follower rises.
    roller
        Radius of the roller; 0 of a flat face.
    lever
        How far that point goes for each unit of lift: 1 of a slide, of a lever its distance from the axis.
    pitch_radius
        ρ of the pitch curve; of a flat face that of the cam.
    """

    middle: Vector
    normal: Vector
    way: Vector
    roller: Any
    lever: Any
    pitch_radius: Array

    @property
    def centre(self) -> Points:
        """Centre of the roller as complex numbers; of a flat face the contact itself."""
        return _complex(self.middle)

    @property
    def point(self) -> Points:
        """The contact as complex numbers."""
        (x, y), (u, v) = self.middle, self.normal
        return _complex((x - self.roller * u, y - self.roller * v))

    @property
    def outward(self) -> Points:
        """Normal off the cam as complex numbers."""
        return _complex(self.normal)

    @cached_property
    def distance(self) -> Array:
        """Of the contact from the cam's axis, mm."""
        return np.asarray(np.abs(self.point))

    @property
    def radius(self) -> Array:
        """ρ of the cam, mm."""
        return np.asarray(self.pitch_radius - self.roller)

    @cached_property
    def cosine(self) -> Array:
        """Of the pressure angle."""
        (u, v), (x, y) = self.normal, self.way
        return np.asarray(u * x + v * y)

    @cached_property
    def pressure_angle(self) -> Array:
        """α, rad, above 0 where the cam pushes ahead of where it turns to."""
        (u, v), (x, y) = self.normal, self.way
        return np.asarray(np.arctan2(v * x - u * y, self.cosine))

    @property
    def share(self) -> Array:
        """Work of one newton of the contact for each unit of lift: lever × cos α, mm or 1."""
        return np.asarray(self.lever * self.cosine)


def _complex(vector: Vector) -> Points:
    found = np.empty(np.broadcast(*vector).shape, np.complex128)
    found.real, found.imag = vector
    return found


def contact_of(m: Mechanism, rates: Rates, cam: int = 0) -> Contact:
    """Give the contact of a cam: 0, or 1 for the second of a conjugate pair."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return _flat(m, rates) if m.flat else _roller(m, rates, cam)


def roller_motion(m: Mechanism, rates: Rates, cam: int) -> tuple[Vector, Vector, Vector, Vector]:
    """Give a roller's centre, its first two derivatives, and the way in which it rises.

    The second roller of a pair goes towards the cam where the first one goes away.
    """
    sign = -1.0 if cam else 1.0
    lift = m.start + rates.s
    if cam:
        lift = lift - m.apart
    if m.slides:
        return (m.offset, lift), (0.0, rates.v), (0.0, rates.a), (0.0, sign)
    # exp(-i angle); the centre is at c - L times it
    arm, x, y = m.arm, np.cos(lift), -np.sin(lift)
    first = -arm * rates.v * y, arm * rates.v * x
    square = rates.v * rates.v
    second = arm * (square * x - rates.a * y), arm * (square * y + rates.a * x)
    return (m.axis - arm * x, -arm * y), first, second, (-sign * y, sign * x)


def velocity_of(m: Mechanism, middle: Vector, first: Vector) -> Vector:
    """Give V, the velocity of a roller's centre over the cam."""
    return first[0] + m.sense * middle[1], first[1] - m.sense * middle[0]


def _roller(m: Mechanism, rates: Rates, cam: int) -> Contact:
    sigma = m.sense
    middle, first, second, way = roller_motion(m, rates, cam)
    vx, vy = velocity_of(m, middle, first)
    ax, ay = second[0] + 2 * sigma * first[1] - middle[0], second[1] - 2 * sigma * first[0] - middle[1]
    square = vx * vx + vy * vy
    speed = np.abs(_complex((vx, vy)))
    pitch = square * speed / (-sigma * (vx * ay - vy * ax))
    # Over the cam, rollers go against its turn: the cam is on their right where σ is 1.
    scale = sigma / np.maximum(speed, TINY)
    lever = 1.0 if m.slides else m.arm
    return Contact(middle, (-vy * scale, vx * scale), way, m.roller, lever, pitch)


def _flat(m: Mechanism, rates: Rates) -> Contact:
    if m.slides:
        h = m.given.base_radius + rates.s
        return Contact((m.sense * rates.v, h), (0.0, 1.0), (0.0, 1.0), 0.0, 1.0, h + rates.a)
    axis, nu = m.axis, m.start - rates.s
    x, y = np.cos(nu), np.sin(nu)
    h = axis * x - m.face
    turned = -rates.v - m.sense
    along = axis * y * rates.v / turned
    bend = axis * (y * rates.a - x * rates.v * rates.v)
    radius = h + (bend + along * rates.a) / (turned * turned)
    px, py = h * x - along * y, h * y + along * x
    # The lever rises clockwise about its axis.
    lever = np.sqrt((px - axis) ** 2 + py * py)
    return Contact((px, py), (x, y), (py / lever, (axis - px) / lever), 0.0, lever, radius)


def along_face(m: Mechanism, contact: Contact, rates: Rates) -> Array:
    """Give where a flat face is touched, mm: from a slide's middle to +x, of a lever from its axis."""
    px, py = contact.middle
    if m.slides:
        return np.asarray(px)
    nu = m.start - rates.s
    return np.asarray(py * np.cos(nu) - (px - m.axis) * np.sin(nu))
