"""The motion of a design over one turn of the crank: strokes and dwells."""

import math

import numpy as np

from mechwright import GROUND, Array, Channel, Curve, Joint, Motion, Poses, Scalar, Stage, refuse
from mechwright.contracts.joint import fixed
from mechwright.contracts.motion import travelled
from mechwright.mechanics.laws import Peaks
from mechwright_geneva.contact import contact, loads
from mechwright_geneva.feasible import feasibility
from mechwright_geneva.kinematics import LEFT, RIGHT
from mechwright_geneva.mechanism import Mechanism, mechanism_of
from mechwright_geneva.params import GenevaParams
from mechwright_geneva.straight import StraightSlot

DRIVER, WHEEL = "driver", "wheel"
"""The bodies that move."""

_END = 1e-9
"""Crank angle, rad, by which a sample may be past the end of a stroke and still be at it: rounding."""


def peaks_of(mechanism: Mechanism) -> Peaks:
    """Largest θw', θw'', θw''' of a stroke, per powers of the crank's angle."""
    way, time = 2 * mechanism.wheel_half, 2 * mechanism.crank_half
    of = mechanism.law.peaks
    return Peaks(way / time * of.v, way / time**2 * of.a, way / time**3 * of.j)


def straight_peaks(slots: int) -> Peaks:
    """The same of the straight slot with as many slots; its jerk is infinite at the ends besides."""
    law = StraightSlot(slots)
    way, time = 2 * law.wheel_half_angle, 2 * law.crank_half_angle
    return Peaks(
        *(value * way / time**k for k, value in enumerate((law.peaks.v, law.peaks.a, law.peaks.j), 1))
    )


def motion_of(params: GenevaParams, samples: int) -> Motion:
    """Sample one turn of the crank at constant speed, both ends included.

    The stroke begins at θd = 0. During dwell rates, forces and the pressure angle are 0. The Hertz pressure
    is left out where gap and floor leave the rollers no length.

    Raises
    ------
    DesignError
        Fewer than two samples, or a mechanism that cannot move.
    """
    refuse(feasibility(params), Stage.MOTION)
    m = mechanism_of(params)
    omega = params.speed * math.tau / 60
    theta_d = travelled(math.tau, samples)
    turn = np.floor((theta_d + _END) / m.pitch)
    within = np.clip(theta_d - turn * m.pitch, 0, None)
    moving = within <= 2 * m.crank_half + _END
    u = np.clip(within / (2 * m.crank_half), 0, 1)
    run = m.stroke(u)
    forces = contact(m, run)
    theta_w = 2 * m.wheel_half * turn + run.theta

    def still(values: Array) -> Array:
        return np.where(moving, values, 0.0)

    channels = {
        "time": Channel(theta_d / omega, "s"),
        "theta_d": Channel(theta_d, "rad"),
        "omega_d": Channel(np.full(samples, omega), "rad/s"),
        "theta_w": Channel(theta_w, "rad"),
        "omega_w": Channel(still(run.first) * omega, "rad/s"),
        "alpha_w": Channel(still(run.second) * omega**2, "rad/s^2"),
        "jerk_w": Channel(still(run.third) * omega**3, "rad/s^3"),
        "pressure_angle": Channel(still(forces.pressure_angle), "rad"),
        "contact_force": Channel(still(forces.force), "N"),
        **(
            {"contact_pressure": Channel(still(forces.pressure), "MPa")} if m.params.roller_length > 0 else {}
        ),
        "crank_torque": Channel(still(forces.crank_torque), "N*m"),
    }
    poses = {
        # The roller stands at a - b exp(iφ): the crank line points to π + φ.
        DRIVER: Poses.planar(m.axes, 0.0, math.pi + m.crank_half - theta_d),
        WHEEL: Poses.planar(0.0, 0.0, theta_w),
    }
    arm = m.axes - m.crank * np.exp(1j * (m.crank_half - theta_d))
    for k in range(params.rollers):
        turned = m.axes + (arm - m.axes) * np.exp(1j * k * m.pitch)
        angle = math.pi + m.crank_half - theta_d + k * m.pitch
        poses[roller_body(k)] = Poses.planar(turned.real, turned.imag, angle)
    if m.params.slots_made == "backed":
        for k in range(m.slots):
            poses[island_body(k)] = Poses.planar(0.0, 0.0, theta_w + 2 * m.wheel_half * k)
    return Motion("theta_d", channels, poses, _figures(m, omega), joints=_joints(m), curves=_outline(m))


_WALL_SAMPLES = 361
"""Points of a slot's wall: a third of a degree of the crank, at most."""


def _outline(m: Mechanism) -> dict[str, Curve]:
    """The walls of all slots as the rollers envelop them, loops and cusps included, and the wheel's rim."""
    run = m.stroke(np.linspace(0, 1, _WALL_SAMPLES))
    walls = {name: run.wall(m.roller, side) for name, side in (("left", LEFT), ("right", RIGHT))}
    found = {
        f"slot-{k + 1}-{name}": Curve.planar(WHEEL, wall * np.exp(2j * k * m.wheel_half))
        for k in range(m.slots)
        for name, wall in walls.items()
    }
    rim = m.rim * np.exp(1j * np.linspace(0, math.tau, _WALL_SAMPLES))
    return {"rim": Curve.planar(WHEEL, rim), **found}


def _joints(m: Mechanism) -> dict[str, Joint]:
    """Two shafts; rollers push the walls of the slots, and the driver's disc holds the wheel."""
    rollers = [roller_body(k) for k in range(m.params.rollers)]
    islands = [island_body(k) for k in range(m.slots)] if m.params.slots_made == "backed" else []
    return {
        "driver-shaft": Joint("revolute", GROUND, DRIVER, (m.axes, 0.0, 0.0), (0.0, 0.0, -1.0), drives=True),
        "wheel-shaft": Joint("revolute", GROUND, WHEEL),
        **fixed(DRIVER, *rollers),
        **fixed(WHEEL, *islands),
        "lock": Joint("contact", DRIVER, WHEEL),
        **{
            f"{roller}-in-{body}": Joint("contact", roller, body, radius=m.roller)
            for roller in rollers
            for body in (WHEEL, *islands)
        },
    }


def roller_body(k: int) -> str:
    """The body of roller k."""
    return f"roller-{k + 1}"


def island_body(k: int) -> str:
    """The body of island k on a backing plate."""
    return f"island-{k + 1}"


def _figures(m: Mechanism, omega: float) -> dict[str, Scalar]:
    peaks, straight, load = peaks_of(m), straight_peaks(m.slots), loads(m)
    moving = m.params.rollers * m.crank_half / math.pi
    return {
        "centre_distance": Scalar(m.axes, "mm"),
        "crank_radius": Scalar(m.crank, "mm"),
        "slot_bottom_radius": Scalar(m.bottom, "mm"),
        "index_angle": Scalar(2 * m.wheel_half, "rad"),
        "index_time": Scalar(2 * m.crank_half / omega, "s"),
        "dwell_share": Scalar(1 - moving, ""),
        "omega_w_max": Scalar(peaks.v * omega, "rad/s"),
        "alpha_w_max": Scalar(peaks.a * omega**2, "rad/s^2"),
        "jerk_w_max": Scalar(peaks.j * omega**3, "rad/s^3"),
        "velocity_peak": Scalar(peaks.v, ""),
        "acceleration_peak": Scalar(peaks.a, ""),
        "jerk_peak": Scalar(peaks.j, ""),
        "straight_velocity_peak": Scalar(straight.v, ""),
        "straight_acceleration_peak": Scalar(straight.a, ""),
        "straight_jerk_peak": Scalar(straight.j, ""),
        "entry_acceleration_jump": Scalar(abs(m.law.jumps[0]) * m.wheel_half / (2 * m.crank_half**2), ""),
        "contact_force_max": Scalar(load.force, "N"),
        **({"contact_pressure_max": Scalar(load.pressure, "MPa")} if m.params.roller_length > 0 else {}),
        "crank_torque_max": Scalar(load.crank_torque, "N*m"),
    }
