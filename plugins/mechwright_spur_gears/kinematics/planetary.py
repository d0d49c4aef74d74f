"""Where the bodies of a planetary set stand: sun, planets on a carrier, ring.

With all members at rest tooth 0 of the sun is on +x. A planet at the angle φ is turned by
φ + π - π/z_p + φ z_s/z_p, so that a space of it takes the sun's tooth, and the ring by π z_p/z_r; each φ is a
multiple of 2π/(z_s + z_r).
"""

import math

import numpy as np

from mechwright import GROUND, Joint, Poses
from mechwright.mechanics.planar import Turning
from mechwright_spur_gears.gear_table import MEMBERS, GearTable


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
