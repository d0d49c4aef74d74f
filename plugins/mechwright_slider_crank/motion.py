"""The motion of a design: channels, poses and figures over one turn of the crank."""

import math
from collections.abc import Callable, Sequence

import numpy as np

from mechwright import Array, Channel, Finding, KinematicsError, Load, Motion, Scalar, Stage, Trace
from mechwright.contracts.finding import errors, refuse
from mechwright.contracts.stretch import Samples
from mechwright.mechanics.linkage import Mass, moving_figures
from mechwright.mechanics.planar import Turning, acceleration_pole
from mechwright.mechanics.planar.channels import (
    point_channels,
    pole_channels,
    rate_channels,
    turning_channels,
)
from mechwright.mechanics.planar.dynamics import Forces
from mechwright_slider_crank.checks import findings
from mechwright_slider_crank.course import course_of, ends_of, is_lever, least_of, toggles
from mechwright_slider_crank.figures import Limits, limits, transmission_angle
from mechwright_slider_crank.forces import MILLI, balance, joint_forces
from mechwright_slider_crank.kinematics import Bodies, SliderCrank
from mechwright_slider_crank.params import SliderCrankParams
from mechwright_slider_crank.plates import body_poses, held_by, masses_of

_LEVER_SAMPLES = 1441
"""Samples of a lever's period for peaks: four a degree of the crank that would make it swing."""

_GRID, _ROUNDS, _CLOSER = 720, 5, np.linspace(-1, 1, 17)
"""Half degrees find a peak; five rounds on eight times closer points find its value to 1e-9 of a turn."""


def motion_of(params: SliderCrankParams, samples: Samples) -> Motion:
    """Sample one turn of the crank, or a lever's swing there and back, both ends included.

    At its limit, c = a + |e|, the linkage goes smoothly through both assemblies, in two turns of the crank.

    Forces and masses are those of the real parts, and left out where ``check`` finds that there can be none.

    Raises
    ------
    KinematicsError
        The crank cannot turn.
    """
    check_moves(params)
    time, drive = course_of(params).period(samples, abs(params.omega))
    return driven_by(params, drive, time, varies=course_of(params).rocks or bool(params.acceleration_ratio))


def check_moves(params: SliderCrankParams) -> Sequence[Finding]:
    """What ``check`` finds; raises KinematicsError where the crank cannot turn."""
    found = findings(params)
    refuse(found, Stage.MOTION, KinematicsError)
    return found


def driven_by(params: SliderCrankParams, drive: Turning, time: Array, *, varies: bool = True) -> Motion:
    """The motion for any motion of the crank, at times (n,), s; ``varies``: its speed is not constant."""
    found, linkage = check_moves(params), params.linkage
    phi, bodies = drive.theta, linkage.bodies(drive.theta, drive)
    masses = None if errors(found) else masses_of(params)
    driven = rate_channels(drive, "_a", "the crank")
    channels = {
        "time": Channel(time, "s", "time"),
        "phi": Channel(phi, "rad", "angle of the crank"),
        **(driven if varies else {"omega_a": driven["omega_a"]}),
        **_slider(linkage, bodies),
        **turning_channels(bodies.rod.turning, "sigma", "_c", "the rod"),
        "transmission_angle": Channel(transmission_angle(linkage, phi), "rad", "transmission angle"),
        **point_channels("P", bodies.rod.point(params.coupler_point)),
        **_poles(linkage, drive, bodies),
        **({} if masses is None else _forces(joint_forces(linkage, bodies, masses, params.load))),
    }
    point = params.coupler_point
    traces = {"P": Trace("rod", (point.real, point.imag, 0.0))}
    figures = _figures(params, masses)
    x, y = params.load * math.cos(linkage.direction), params.load * math.sin(linkage.direction)
    loads = {"load": Load("slider", force=(x, y, 0.0))}
    return Motion("phi", channels, body_poses(params, phi), figures, traces, held_by(params), loads=loads)


def _slider(linkage: SliderCrank, bodies: Bodies) -> dict[str, Channel]:
    """Along the slide."""
    back = np.exp(-1j * linkage.direction)
    pin = bodies.slider.origin
    return {
        "s": Channel(bodies.position, "mm", "place of the slider"),
        "v": Channel((pin.velocity * back).real, "mm/s", "velocity of the slider"),
        "a": Channel((pin.acceleration * back).real, "mm/s^2", "acceleration of the slider"),
        "jerk": Channel((pin.jerk * back).real, "mm/s^3", "jerk of the slider"),
    }


def _poles(linkage: SliderCrank, drive: Turning, bodies: Bodies) -> dict[str, Channel]:
    """The rod's acceleration pole on the ground and in the rod, for both assemblies."""
    other = SliderCrank(linkage.crank, linkage.rod, linkage.offset, linkage.direction, -linkage.branch)
    return pole_channels(acceleration_pole(bodies.rod)) | pole_channels(
        acceleration_pole(other.bodies(drive.theta, drive).rod),
        suffix="_other",
        what="the other assembly's acceleration pole",
    )


def _sizes(carried: Forces) -> dict[str, Array]:
    """Sizes of the forces, N."""
    found = {f"force_{name.replace('-', '_')}": np.abs(force) for name, force in carried.joints.items()}
    return found | {"shaking_force": np.abs(carried.shaking)}


def _forces(carried: Forces) -> dict[str, Channel]:
    found = {
        f"force_{name.replace('-', '_')}": Channel(
            np.abs(force), "N", f"force in the {name.replace('-', ' ')}"
        )
        for name, force in carried.joints.items()
    }
    found["shaking_force"] = Channel(np.abs(carried.shaking), "N", "force on the ground")
    found["moment_guide"] = Channel(carried.moments["guide"] * MILLI, "N*m", "moment on the guide")
    found["drive_torque"] = Channel(carried.drive * MILLI, "N*m", "torque of the drive")
    return found


def _figures(params: SliderCrankParams, masses: dict[str, Mass] | None) -> dict[str, Scalar]:
    """Figures of the motion, and with ``masses`` those of the forces."""
    linkage = params.linkage
    ends = ends_of(params)

    def sizes(drive: Turning) -> dict[str, Array]:
        bodies = linkage.bodies(drive.theta, drive)
        slider = bodies.slider.origin
        rates = {"v_max": np.abs(slider.velocity), "a_max": np.abs(slider.acceleration)}
        if masses is None:
            return rates
        carried = joint_forces(linkage, bodies, masses, params.load)
        forces = {f"{name}_max": size for name, size in _sizes(carried).items()}
        return rates | {"drive_torque_max": np.abs(carried.drive) * MILLI, **forces}

    most = _most(params, sizes)
    kept = limits(linkage) if linkage.at_limit else None
    units = {"v_max": "mm/s", "a_max": "mm/s^2", "drive_torque_max": "N*m"}
    return {
        "stroke": Scalar(ends.stroke, "mm"),
        "time_ratio": Scalar(ends.time_ratio, ""),
        "phi_far": Scalar(ends.far, "rad"),
        "phi_near": Scalar(ends.near, "rad"),
        "s_far": Scalar(ends.far_position, "mm"),
        "s_near": Scalar(ends.near_position, "mm"),
        "least_transmission_angle": Scalar(least_of(params), "rad"),
        **(_lever(params) if is_lever(params) else {}),
        **({} if kept is None else _in_one_assembly(kept)),
        **{name: Scalar(value, units.get(name, "N")) for name, value in most.items()},
        **({} if masses is None else _mass_figures(params, masses)),
    }


def _most(params: SliderCrankParams, sizes: Callable[[Turning], dict[str, Array]]) -> dict[str, float]:
    """Greatest values over a period; of a lever among as many samples as its ends are sought in."""
    course, speed = course_of(params), abs(params.omega)
    if course.rocks:
        _, drive = course.period(_LEVER_SAMPLES, speed)
        return {name: float(size.max()) for name, size in sizes(drive).items()}
    turned = course.travel / math.tau
    # A crank that accelerates does not end as it has begun.
    end = math.inf if params.acceleration_ratio == 0 else math.tau
    return peaks(lambda angle: sizes(course.turning(course.start + turned * angle, speed)), end)


def _in_one_assembly(ends: Limits) -> dict[str, Scalar]:
    """Stroke and time ratio of a linkage at its limit that something keeps in its assembly."""
    return {
        "assembly_stroke": Scalar(ends.stroke, "mm"),
        "assembly_time_ratio": Scalar(ends.time_ratio, ""),
    }


def _lever(params: SliderCrankParams) -> dict[str, Scalar]:
    """Where a lever turns back, and where the rod would stand across the slide: crank angles, in degrees."""
    course = course_of(params)
    low, high = sorted((course.start, course.start + course.travel))
    angles = {"swing_from": low, "swing_to": high, "input_range": high - low}
    if (found := toggles(params)) is not None:
        angles |= {"toggle_low": found[0], "toggle_high": found[1]}
    return {name: Scalar(math.degrees(angle), "deg") for name, angle in angles.items()}


def _mass_figures(params: SliderCrankParams, masses: dict[str, Mass]) -> dict[str, Scalar]:
    weights = balance(params.crank, params.rod, masses)
    return {
        **moving_figures(masses, {"rod": weights.rod, "crank": weights.crank}),
        "balance_rod_weight": Scalar(weights.rod_weight, "kg"),
    }


def peaks(functions: Callable[[Array], dict[str, Array]], end: float = math.inf) -> dict[str, float]:
    """Greatest values of functions from 0 to 2π, independent of any sampling of the motion.

    They have that period, or end there: then no value beyond ``end`` or before 0 is asked for.

    >>> found = peaks(lambda t: {"sine": 3 + np.sin(t - 1), "cosine": np.cos(t)})
    >>> round(found["sine"], 12), round(found["cosine"], 12)
    (4.0, 1.0)
    """
    grid = np.linspace(0, math.tau, _GRID + 1)
    begin = -math.inf if math.isinf(end) else 0.0
    found = {}
    for name, values in functions(grid).items():
        centre, half = float(grid[np.argmax(values)]), math.tau / _GRID
        best = float(values.max())
        for _ in range(_ROUNDS):
            at = np.clip(centre + half * _CLOSER, begin, end)
            near = functions(at)[name]
            best, centre = max(best, float(near.max())), float(at[np.argmax(near)])
            half /= 8
        found[name] = best
    return found
