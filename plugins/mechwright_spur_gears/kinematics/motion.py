"""The motion of a pair: channels, poses and figures over one turn of the driver.

Where the bodies of a planetary set stand: sun, planets on a carrier, ring.

With all members at rest tooth 0 of the sun is on +x. A planet at the angle φ is turned by
φ + π - π/z_p + φ z_s/z_p, so that a space of it takes the sun's tooth, and the ring by π z_p/z_r; each φ is a
multiple of 2π/(z_s + z_r).
"""

import math
from collections.abc import Mapping

import numpy as np

from mechwright import GROUND, Array, Channel, Curve, Joint, Load, Motion, Poses
from mechwright.contracts.figure import Figure, scalars
from mechwright.contracts.stretch import Samples, travelled
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.channels import turning_channels
from mechwright_spur_gears.gear_table import MEMBERS, GearTable
from mechwright_spur_gears.kinematics.rack import (
    CIRCLE_SAMPLES,
    rack_figures,
    rack_motion,
    rack_table_channels,
)
from mechwright_spur_gears.parts.teeth import rolling_pair


def bodies(m: GearTable) -> list[str]:
    """Planets and pins, by name."""
    return [f"{name}-{k}" for k in range(1, m.dimensions.planets + 1) for name in ("planet", "pin")]


def starts(m: GearTable) -> dict[str, float]:
    """Body to its angle, rad, with all members at rest."""
    sun, planet, ring = m.dimensions.teeth, m.dimensions.mate_teeth, m.dimensions.ring_teeth
    found = {"sun": 0.0, "carrier": 0.0, "ring": math.pi * planet / ring}
    for k, place in enumerate(m.places[0], start=1):
        found[f"planet-{k}"] = float(place + math.pi - math.pi / planet + place * sun / planet)
        found[f"pin-{k}"] = float(place)
    return found


def poses_over(m: GearTable, driver: Turning) -> dict[str, Poses]:
    """Poses of all bodies, for any motion of the driving member."""
    start, away = starts(m), float(m.distance)
    turned = {name: float(m.rate(name)) * driver.theta for name in (*MEMBERS, "planet")}
    poses = {name: Poses.planar(0.0, 0.0, turned[name] + start[name]) for name in MEMBERS}
    for k, place in enumerate(m.places[0], start=1):
        x, y = away * np.cos(turned["carrier"] + place), away * np.sin(turned["carrier"] + place)
        poses[f"planet-{k}"] = Poses.planar(x, y, turned["planet"] + start[f"planet-{k}"])
        poses[f"pin-{k}"] = Poses.planar(x, y, turned["carrier"] + start[f"pin-{k}"])
    return poses


def joints_of(m: GearTable) -> dict[str, Joint]:
    """Members turn about the origin, or stand; planets turn on the carrier's pins."""
    given, away = m.dimensions, float(m.distance)
    found = {
        f"{name}-axis": Joint(
            "fixed" if name == given.fixed_member else "revolute",
            GROUND,
            name,
            drives=name == given.driving_member,
        )
        for name in MEMBERS
    }
    # Planets turn against the carrier; where they roll on what stands still, the carrier turns them.
    turns = float(m.rate("planet")) - float(m.rate("carrier"))
    turning = {name: "carrier" if name == given.fixed_member else name for name in ("sun", "ring")}
    for k, place in enumerate(m.places[0].tolist(), start=1):
        point = (away * math.cos(place), away * math.sin(place), 0.0)
        found[f"planet-{k}-axis"] = Joint("revolute", "carrier", f"planet-{k}", point)
        found[f"pin-{k}-seat"] = Joint("fixed", "carrier", f"pin-{k}", point)
        found |= {
            f"{name}-planet-{k}": Joint("gear", one, f"planet-{k}", ratio=turns / float(m.rate(one)))
            for name, one in turning.items()
        }
    return found


def motion_of(m: GearTable, samples: Samples) -> Motion:
    """Sample one turn of the driver at constant speed, or a rack there and back, both ends included.

    The driver turns about the origin. A driven gear turns about (a, 0), the other way round, and a ring about
    (-a, 0), the same way round. A rack slides below the driver.
    """
    if m.straight:
        return rack_motion(m, samples)
    phi = travelled(math.tau, samples)
    return motion_over(m, Turning.of(phi, float(m.omega)), phi / float(m.omega))


def driven(m: GearTable, driver: Turning) -> Turning:
    """The driven gear, for any motion of the driver."""
    return driver.scaled(m.ratio)


def channels_over(m: GearTable, driver: Turning, time: Array) -> dict[str, Channel]:
    """Angles of driver and driven gear, and of planets, with their rates."""
    one, two = (m.given.driving_member, m.driven) if m.planetary else ("gear 1", "gear 2")
    found = {
        "time": Channel(time, "s", "time"),
        **turning_channels(driver, "theta1", "1", str(one)),
        **turning_channels(driven(m, driver), "theta2", "2", two),
    }
    if m.planetary:
        found |= turning_channels(driver.scaled(m.rate("planet")), "theta3", "3", "a planet")
    return found


def motion_over(m: GearTable, driver: Turning, time: Array) -> Motion:
    """The motion for any motion of the driver, at times (n,), s."""
    channels = channels_over(m, driver, time)
    loads = {"load_torque": Load(m.driven, resisting=m.given.load_torque)}
    figures = scalars(figures_of(m))
    if m.planetary:
        return Motion(
            "theta1", channels, poses_over(m, driver), figures, {}, joints_of(m), _circles(m), loads
        )
    (one, two), pair = m.names, rolling_pair(m.pair)
    poses = {
        one: Poses.planar(0.0, 0.0, driver.theta),
        two: Poses.planar(pair.axis, 0.0, driven(m, driver).theta + pair.start),
    }
    held = {
        "o1": Joint("revolute", GROUND, one, drives=True),
        "o2": Joint("revolute", GROUND, two, (pair.axis, 0.0, 0.0)),
        "mesh": Joint("gear", one, two, ratio=float(m.ratio)),
    }
    return Motion("theta1", channels, poses, figures, {}, held, _circles(m), loads)


def _circles(m: GearTable) -> dict[str, Curve]:
    around = np.exp(1j * np.linspace(0.0, math.tau, CIRCLE_SAMPLES))
    own = [one for one in m.flanks if not one.again]
    bodies = [f"{name}-1" if name == "planet" else name for name in m.names]
    return {
        f"pitch-{body}": Curve.planar(body, abs(float(m.meshes[one.mesh].operating(one.gear))) * around)
        for one, body in zip(own, bodies, strict=True)
    }


def figures_of(m: GearTable) -> Mapping[str, Figure]:
    """The figures of a pair, or of a table of pairs."""
    if m.straight:
        return rack_figures(m)
    pair = m.pair
    found = {
        "ratio": Figure(lambda: abs(m.ratio)),
        "centre_distance": Figure(lambda: m.distance, "mm"),
        "operating_pressure_angle": Figure(lambda: pair.operating_angle, "rad"),
        "contact_ratio": Figure(lambda: pair.contact_ratio),
        "tip_shortening": Figure(lambda: pair.shortening * pair.module, "mm"),
        "backlash": Figure(lambda: pair.backlash, "mm"),
    }
    for gear in (0, 1):
        found |= {
            f"shift{gear + 1}": Figure(lambda gear=gear: pair.shifts[gear]),
            f"tip_diameter{gear + 1}": Figure(lambda gear=gear: 2 * abs(pair.tip(gear)), "mm"),
            f"root_diameter{gear + 1}": Figure(lambda gear=gear: 2 * abs(pair.root(gear)), "mm"),
            f"pitch_diameter{gear + 1}": Figure(lambda gear=gear: 2 * abs(pair.operating(gear)), "mm"),
            f"sliding{gear + 1}": Figure(lambda gear=gear: pair.sliding(gear)),
        }
    if m.planetary:
        ring = m.meshes[1]
        found |= {
            "contact_ratio_ring": Figure(lambda: ring.contact_ratio),
            "shift3": Figure(lambda: ring.shifts[1]),
            "tip_diameter3": Figure(lambda: 2 * abs(ring.tip(1)), "mm"),
            "root_diameter3": Figure(lambda: 2 * abs(ring.root(1)), "mm"),
            "planet_gap": Figure(lambda: m.gap * np.reshape(ring.module, (-1, 1)), "mm"),
        }
    return found


def table_channels(m: GearTable, samples: int) -> dict[str, Channel]:
    """The channels (n, samples) of a table of pairs over one turn of each driver, or one swing."""
    if m.straight:
        return rack_table_channels(m, samples)
    phi = travelled(math.tau, samples)
    omega = np.broadcast_to(m.omega, (m.size, 1))
    return channels_over(m, Turning.of(np.broadcast_to(phi, (m.size, samples)), omega), phi / omega)
