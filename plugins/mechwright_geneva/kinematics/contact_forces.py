"""Forces between roller and slot: pressure angle, normal force, Hertz pressure, crank torque.

With the roller's normal n, its centre C and its speed D over the wheel (equations of the facts, section 11):

    lever of the wheel   a b |sin φ|/D,  cos δ = lever/|C|
    N = T_w/lever,  T_w = J (θw'' ω² + θw' α) ± T_load,  crank torque T_w θw'
    R = r (1 ∓ κ r),  p = sqrt(N E*/(π L R)),  1/E* = (1 - ν1²)/E1 + (1 - ν2²)/E2

At mid stroke of a curved slot the normal lies on the line of centres, δ = 90 degrees: no force turns the
wheel there. Inertia does not need one at constant speed, since θw'' passes 0 as well and N stays finite; a
constant torque does, and so does an acceleration of the driver. In the blocked zone about it the wheel's own
kinetic energy has to carry the load.

The wall whose lever has the torque's sign carries: it changes where the lever changes its sign, in the middle
of the stroke, and where the torque does. If both do there, nothing changes.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, material
from mechwright.contracts.design_table import Rowwise, number
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.strength.hertz import SHARPEST, YIELD, contact_modulus, line_pressure
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT, Stroke
from mechwright_geneva.kinematics.mechanism import BLOCK, Mechanism

BLOCKED = math.radians(80)
"""Pressure angle from which friction of 0.18 (steel on steel, hardly oiled) stops the wheel."""

_MIDDLE = 1e-6
"""|sin φ| below which the limit at mid stroke is taken: the next term is smaller by its square."""

_SHORTEST = 1e-3
"""Length of a roller, mm, below which no line touches; keeps the pressure of one without a length finite."""

_SAMPLES = 501
"""Samples of a stroke that find a peak, mid stroke among them."""

PEAKS = ("force", "pressure", "crank_torque")
"""Quantities of the contact whose peaks are sought."""

_CLOSER, _ZOOMS = 17, 3
"""Samples between the neighbours of the greatest one, and how often they are drawn together: between the
last a hill is flat to a share of 1e-10."""


@dataclass(frozen=True, slots=True)
class Contact:
    """The contact at each sample of a stroke, (k,) each.

    Parameters
    ----------
    lever
        Lever of the normal force about the wheel's axis, mm.
    pressure_angle
        δ, rad.
    wall
        LEFT or RIGHT: the wall that ``force`` is on.
    carrier
        LEFT or RIGHT: the wall that carries the whole torque, in the blocked zone as well.
    force
        N. In the blocked zone that of the inertia alone.
    pressure
        Hertz pressure, MPa.
    crank_torque
        N·m, that the driver has to be given about θd: with its speed the power that goes to the wheel.
    blocked
        Samples in the blocked zone.
    """

    lever: Array
    pressure_angle: Array
    wall: NDArray[np.int_]
    carrier: NDArray[np.int_]
    force: Array
    pressure: Array
    crank_torque: Array
    blocked: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Drive:
    """What loads the contact: numbers, or columns (m, 1) for many designs.

    Parameters
    ----------
    omega, alpha
        Crank speed, rad/s, below 0 backwards, and its acceleration, rad/s²: numbers or (k,).
    inertia, torque
        Of the load, kg·m² and N·m.
    radius, length
        Of the roller, mm.
    stiffness
        E*, MPa.
    sense
        +1 forwards, -1 backwards.
    """

    omega: "float | Array"
    inertia: float
    torque: float
    radius: "float | Array"
    length: float
    stiffness: float
    alpha: "float | Array" = 0.0
    sense: "int | NDArray[np.int_]" = 1

    def accelerating(self, run: Stroke) -> Array:
        """J θw'' ω², N·m: what needs no push in the middle of a curved slot."""
        return np.asarray(self.inertia * run.second * self.omega**2)

    def pushing(self, run: Stroke) -> Array:
        """J θw' α and the load, N·m."""
        return np.asarray(self.inertia * run.first * self.alpha + self.sense * self.torque)


def contact(
    mechanism: Mechanism, run: Stroke, stroke: "int | Array" = 0, turning: Turning | None = None
) -> Contact:
    """The contact over a stroke; ``stroke`` (k,) is its number, counted as θd is: the speed depends on it.

    Something else than the design's own law may be ``turning`` the driver.
    """
    drive = drive_of(mechanism, run, stroke, turning)
    return _straight(run, drive) if mechanism.straight else curved(run, drive)


def drive_of(
    mechanism: Mechanism, run: Stroke, stroke: "int | Array" = 0, given: Turning | None = None
) -> Drive:
    """What loads the contact over a stroke; the driver is turned by its own law unless it is ``given``."""
    m, params = mechanism, mechanism.params
    turning = m.driver.at(m.crank_half - run.phi + stroke * m.pitch) if given is None else given
    sense = m.driver.sense if given is None else np.where(given.omega < 0, -1, 1)
    return Drive(
        turning.omega,
        params.load_inertia,
        params.load_torque,
        m.roller,
        np.maximum(m.params.roller_length, _SHORTEST),
        stiffness(params.material, params.roller_material),
        turning.alpha,
        sense,
    )


def _straight(run: Stroke, drive: Drive) -> Contact:
    """Along a radial wall: the whole radius is lever, the pressure angle 0, the wall flat."""
    reach = np.abs(run.centre)
    torque = drive.accelerating(run) + drive.pushing(run)
    # A push ahead is on the right of the way in and on the left of the way out.
    ahead = np.where(run.phi >= 0, RIGHT, LEFT)
    force = np.abs(torque) / reach * 1e3
    none = np.zeros(reach.shape)
    wall = np.where(torque >= 0, ahead, -ahead)
    return Contact(
        reach,
        none,
        wall,
        wall,
        force,
        line_pressure(force, drive.length, drive.radius, drive.stiffness),
        torque * run.first,
        none.astype(bool),
    )


def curved(run: Stroke, drive: Drive) -> Contact:
    """In a curved slot; design axis first if there is one."""
    signed = run.lever(run.normal)
    lever = np.abs(signed)
    delta = np.arccos(np.clip(lever / np.abs(run.centre), 0, 1))
    blocked = delta > BLOCKED
    middle = np.abs(np.sin(run.phi)) < _MIDDLE
    pushed = drive.pushing(run)
    torque = drive.accelerating(run) + np.where(blocked, 0.0, pushed)
    # At mid stroke the ratio of θw'' and sin φ tends to that of their derivatives, and the lever to
    # a b sin φ/D.
    limit = (
        drive.inertia * np.abs(run.third) * drive.omega**2 * run.speed / (run.frame.axes * run.frame.crank)
    )
    push = torque / np.where(middle, 1.0, signed)
    push = np.where(middle, np.where(run.third < 0, RIGHT, LEFT) * limit, push) * 1e3
    wall = np.where(push > 0, LEFT, RIGHT)
    whole = (drive.accelerating(run) + pushed) * signed
    carrier = np.where(whole == 0, wall, np.where(whole > 0, LEFT, RIGHT))
    # An undercut wall has no contact there; feasible designs have none.
    radius = np.maximum(drive.radius * (1 - wall * run.curvature * drive.radius), SHARPEST)
    force = np.abs(push)
    pressure = line_pressure(force, drive.length, radius, drive.stiffness)
    return Contact(lever, delta, wall, carrier, force, pressure, torque * run.first, blocked)


def stiffness(wheel: str, roller: str) -> float:
    """E* of two materials, MPa."""
    return contact_modulus(material(wheel), material(roller))


def strength(wheel: str, roller: str) -> float:
    """Hertz pressure at which the softer of two materials begins to yield, MPa."""
    return YIELD * min(material(wheel).strength, material(roller).strength)


@dataclass(frozen=True, slots=True)
class Loads(Rowwise):
    """The peaks of the strokes of a turn: numbers, or columns (n, 1) of a table.

    Parameters
    ----------
    force, force_at
        Contact force, N, and the crank angle at which it is greatest, rad.
    island
        Whether the island carries the greatest force.
    pressure, pressure_at
        Hertz pressure, MPa, and its crank angle, rad.
    crank_torque, wheel_torque
        Torque that the driver has to be given, and that of the contact on the wheel, N·m.
    steep
        Crank angle over which the pressure angle is above 45 degrees, rad.
    carried
        Angle of the wheel in the blocked zone, rad.
    """

    force: float
    force_at: float
    island: bool
    pressure: float
    pressure_at: float
    crank_torque: float
    wheel_torque: float
    steep: float
    carried: float


def loads(mechanism: Mechanism) -> Loads:
    """The peaks of the contact over the strokes of a turn, or over one where all are alike."""
    return mechanism.once("loads", lambda: _loads(mechanism))


def _loads(m: Mechanism) -> Loads:
    found = m.each(_peaks, BLOCK)
    force, at, island, *rest = (number(found[0, k] if m.single else found[:, k, None]) for k in range(9))
    return Loads(force, at, island > 0, *rest)


def _peaks(m: Mechanism) -> Array:
    """(n, 9): the numbers of :class:`Loads`, in their order."""
    run, found = sampled(m)
    first, time = found[0][1], np.reshape(2 * m.crank_half, (-1, 1))
    strokes = np.stack([_peaks_of_stroke(m, one, stroke) for stroke, one in found])
    best = np.argmax(strokes[..., 0], axis=0)
    each = np.take_along_axis(strokes, best[None, ..., None], axis=0)[0]  # (3, n, 3)
    torque = np.max([(one.force * one.lever).max(axis=-1) for _, one in found], axis=0) / 1e3
    steep = time * np.mean(np.atleast_2d(first.pressure_angle) > math.pi / 4, axis=-1, keepdims=True)
    columns = [each[0, :, 0], each[0, :, 1], each[0, :, 2], each[1, :, 0], each[1, :, 1], each[2, :, 0]]
    columns += [np.ravel(torque), np.ravel(steep), np.ravel(carried(run, first))]
    return np.stack([np.broadcast_to(one, m.size) for one in columns], axis=-1)


def sampled(mechanism: Mechanism) -> "tuple[Stroke, list[tuple[int, Contact]]]":
    """A stroke at the samples among which peaks are sought, and the contact in each of a turn that differ."""
    run = mechanism.stroke(np.linspace(0, 1, _SAMPLES))
    return run, [(stroke, contact(mechanism, run, stroke)) for stroke in mechanism.different_strokes]


def _peaks_of_stroke(m: Mechanism, found: Contact, stroke: int) -> Array:
    """(3, n, 3): greatest force, pressure and crank torque, the crank angle, whether the island carries."""
    shares, share = [np.linspace(0, 1, _SAMPLES)[None]] * len(PEAKS), np.linspace(0, 1, _CLOSER)
    values = [np.abs(np.atleast_2d(getattr(found, name))) for name in PEAKS]
    for _ in range(_ZOOMS):
        ends = [_neighbours(*one) for one in zip(shares, values, strict=True)]
        shares = [low + (high - low) * share for low, high in ends]
        found = contact(m, m.stroke(np.concatenate(shares, axis=-1)), stroke)
        values = [
            np.abs(np.atleast_2d(getattr(found, name)))[..., k * _CLOSER : (k + 1) * _CLOSER]
            for k, name in enumerate(PEAKS)
        ]
    walls = np.atleast_2d(found.wall)
    peaks = []
    for k, (u, size) in enumerate(zip(shares, values, strict=True)):
        most = np.argmax(size, axis=-1, keepdims=True)
        at = 2 * m.crank_half * np.take_along_axis(u, most, axis=-1) + stroke * m.pitch
        island = (np.take_along_axis(walls, most + k * _CLOSER, axis=-1) == m.side) & (not m.straight)
        peaks.append(np.concatenate((np.take_along_axis(size, most, axis=-1), at, island), axis=-1))
    return np.stack(peaks)


def _neighbours(u: Array, values: Array) -> tuple[Array, Array]:
    """The shares (n, 1) of a stroke about the greatest of the values (n, k)."""
    most, u = np.argmax(values, axis=-1, keepdims=True), np.broadcast_to(u, values.shape)
    low, high = (np.take_along_axis(u, np.clip(most + step, 0, u.shape[-1] - 1), axis=-1) for step in (-1, 1))
    return low, high


def carried(run: Stroke, found: Contact) -> Array:
    """Angle (...) of the wheel in the blocked zone, rad."""
    zone = found.blocked
    first = np.argmax(zone, axis=-1)
    last = zone.shape[-1] - 1 - np.argmax(zone[..., ::-1], axis=-1)
    angle: Array = np.where(zone.any(axis=-1), run.theta[last] - run.theta[first], 0.0)
    return angle
