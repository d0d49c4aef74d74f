"""The motion of a design over one turn of the crank: strokes and dwells."""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from mechwright import GROUND, Array, Channel, Curve, Joint, Load, Motion, Stage, refuse
from mechwright.contracts.figure import scalars
from mechwright.contracts.joint import fixed
from mechwright.contracts.stretch import Samples, travelled
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright.mechanics.planar.channels import rate_channels
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.kinematics.contact_forces import contact
from mechwright_geneva.kinematics.figures import figures
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT, Stroke
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.rules.feasibility import FEASIBLE

DRIVER, WHEEL = "driver", "wheel"
"""The bodies that move."""

_END = 1e-9
"""Crank angle, rad, by which a sample may be past the end of a stroke and still be at it: rounding."""


def motion_of(params: GenevaParams, samples: Samples) -> Motion:
    """Sample one turn of the driver, both ends included.

    Forwards the first stroke begins at θd = 0; backwards at 2 θd0, and θd falls. During dwell rates, forces
    and the pressure angle are 0. The Hertz pressure is left out where gap and floor leave the rollers no
    length.

    Raises
    ------
    DesignError
        Fewer than two samples, or a mechanism that cannot move.
    """
    m = mechanism_of(params)
    refuse(FEASIBLE.findings(m), Stage.MOTION)
    return driven_by(m, m.driver.at(turn_of(m, samples)))


def turn_of(m: Mechanism, samples: Samples) -> Array:
    """Angles (samples,) of the driver over a turn, rad, from the first entry; (n, samples) of a table."""
    way, start = m.driver.sense * math.tau, m.driver.start
    return travelled(way, samples, start) if m.single else travelled(way, samples) + start


def driven_by(m: Mechanism, turning: Turning, time: Array | None = None) -> Motion:
    """The motion for any motion of the driver, by θd; ``time`` (n,), s, is left out where it is its own."""
    params, theta_d = m.params, turning.theta
    channels = channels_of(m, theta_d, None if time is None else (turning, time))
    theta_w = channels["theta_w"].values
    rates = [channels[f"{name}_w"].values for name in ("omega", "alpha", "jerk")]
    # The roller stands at a - b exp(iφ): the crank line points to π + φ.
    back = turning.scaled(-1.0)
    crank = BodyMotion.about(complex(m.axes), replace(back, theta=math.pi + m.crank_half - theta_d))
    wheel = BodyMotion.about(0j, Turning(theta_w, *rates))
    poses = {
        DRIVER: crank.poses(rates=True),
        WHEEL: wheel.poses(rates=True),
    }
    for k in range(params.rollers):
        arm = crank.point(m.crank * np.exp(1j * k * m.pitch))
        angle = replace(crank.turning, theta=crank.turning.theta + k * m.pitch)
        poses[roller_body(k)] = BodyMotion(arm, angle).poses(rates=True)
    if m.params.slots_made == "backed":
        for k in range(m.slots):
            angle = replace(wheel.turning, theta=theta_w + 2 * m.wheel_half * k)
            poses[island_body(k)] = BodyMotion.about(0j, angle).poses(rates=True)
    return Motion(
        "theta_d",
        channels,
        poses,
        scalars(figures(m)),
        joints=_joints(m),
        curves=_outline(m),
        loads=_loads(m),
    )


def at_angle(m: Mechanism, theta_d: Array) -> tuple[Array, NDArray[np.bool_], Stroke]:
    """Number of the stroke at angles (...) of the driver, rad, whether the wheel moves, and the stroke."""
    turn = np.floor((theta_d + _END) / m.pitch)
    within = np.clip(theta_d - turn * m.pitch, 0, None)
    moving = within <= 2 * m.crank_half + _END
    return turn, moving, m.stroke(np.clip(within / (2 * m.crank_half), 0, 1))


def channels_of(
    m: Mechanism, theta_d: Array, given: tuple[Turning, Array] | None = None
) -> dict[str, Channel]:
    """The channels at angles (n,) of the driver, rad, from that of its start on; of many designs (m, n).

    ``given`` is how something else turns the driver, and the times, s.
    """
    driver = m.driver
    turning = driver.at(theta_d) if given is None else given[0]
    time = driver.time(theta_d) if given is None else given[1]
    turn, moving, run = at_angle(m, theta_d)
    forces = contact(m, run, turn, None if given is None else turning)
    rates = turning.carried(run.first, run.second, run.third)
    theta_w = 2 * m.wheel_half * turn + run.theta

    def still(values: Array) -> Array:
        return np.where(moving, values, 0.0)

    # A roller without a length has no pressure.
    pressure = np.where(np.asarray(m.params.roller_length) > 0, forces.pressure, np.nan)

    driven = rate_channels(turning, "_d", "the driver")
    return {
        "time": Channel(time, "s", "time"),
        "theta_d": Channel(theta_d, "rad", "angle of the driver"),
        "omega_d": driven["omega_d"],
        **(driven if driver.varies or given else {}),
        "theta_w": Channel(theta_w, "rad", "angle of the wheel"),
        "omega_w": Channel(still(rates[0]), "rad/s", "angular velocity of the wheel"),
        "alpha_w": Channel(still(rates[1]), "rad/s^2", "angular acceleration of the wheel"),
        "jerk_w": Channel(still(rates[2]), "rad/s^3", "angular jerk of the wheel"),
        "pressure_angle": Channel(still(forces.pressure_angle), "rad", "pressure angle of the roller"),
        "contact_force": Channel(still(forces.force), "N", "force between roller and slot"),
        "contact_wall": Channel(still(forces.carrier.astype(float)), "", "wall of the slot that carries"),
        **(
            {"contact_pressure": Channel(still(pressure), "MPa", "pressure between roller and slot")}
            if not m.single or m.params.roller_length > 0
            else {}
        ),
        "crank_torque": Channel(still(forces.crank_torque), "N*m", "torque of the drive"),
    }


def _loads(m: Mechanism) -> dict[str, Load]:
    """What the wheel carries."""
    return {"load": Load(WHEEL, resisting=m.params.load_torque, inertia=m.params.load_inertia)}


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
