"""The motion of a pair: channels and poses until both gears are back where they began."""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mechwright import GROUND, Array, Channel, Curve, Joint, KinematicsError, Load, Motion, Poses, Stage
from mechwright.contracts.figure import scalars
from mechwright.contracts.finding import errors
from mechwright.contracts.stretch import Samples, travelled
from mechwright.mechanics.gearing import Rolling
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.channels import turning_channels
from mechwright_noncircular_gears.kinematics.figures import figures
from mechwright_noncircular_gears.rules.law_rules import LAW
from mechwright_noncircular_gears.rules.remedies import advised
from mechwright_noncircular_gears.table import NAMES, GearTable

_PITCH_SAMPLES = 361
"""Points of a pitch curve that is drawn: each degree."""


def turns_of(m: GearTable) -> int:
    """Turns of the driver after which both gears stand as before.

    >>> from mechwright_noncircular_gears.parameters import NoncircularParams
    >>> turns_of(GearTable(NoncircularParams(law="ellipse", lobes=2, mate_lobes=3, teeth=40)))
    3
    """
    return m.given.mate_lobes // math.gcd(m.given.lobes, m.given.mate_lobes)


def motion_of(m: GearTable, samples: Samples) -> Motion:
    """Sample the turns of the driver at constant speed, or its swing there and back, both ends included.

    The driver turns about the origin, the driven gear about (a, 0), the other way round; a ring about
    (-a, 0), the same way.

    Raises
    ------
    KinematicsError
        The law does not turn the driven gear on all the way.
    """
    return driven_by(m, *_turned(m, samples))


def _turned(m: GearTable, samples: Samples) -> tuple[Turning, Array]:
    """The driver, and the time, s."""
    phi = travelled(math.tau * turns_of(m), samples)
    driver = Turning.of(phi, m.omega) if m.given.sector is None else swinging(m, phi)
    return driver, phi / m.omega


def swinging(m: GearTable, phase: Array) -> Turning:
    """The driver of sectors at phases (n,), rad, of its swing there and back: φ = S/2 (1 - cos)."""
    half, omega = (m.given.sector or 0.0) * math.radians(1) / 2, m.omega
    sin, cos = np.sin(phase), np.cos(phase)
    return Turning(half * (1 - cos), half * omega * sin, half * omega**2 * cos, -half * omega**3 * sin)


def driven(m: GearTable, driver: Turning) -> Turning:
    """The driven gear of any motion of the driver, about +z: a ring with the driver, others against it."""
    law, way = m.law, -m.given.side
    ratio, first, second = law.rates(driver.theta)
    return Turning(way * law.angle(driver.theta), *driver.carried(way * ratio, way * first, way * second))


def channels(m: GearTable, samples: int) -> Mapping[str, Channel]:
    """Those of one period, (samples,) of one pair and (n, samples) of a table."""
    if m.shares_law:
        return _channels(m, *_turned(m, samples))
    rows = [channels(m.row(place), samples) for place in range(m.size)]
    return {
        name: replace(one, values=np.stack([row[name].values for row in rows]))
        for name, one in rows[0].items()
    }


def _channels(m: GearTable, driver: Turning, time: Array) -> dict[str, Channel]:
    phi = driver.theta
    now = Rolling.of(m.law, phi, m.given.side)
    return {
        "time": Channel(time, "s", "time"),
        **turning_channels(driver, "theta1", "1", "gear 1"),
        **turning_channels(driven(m, driver), "theta2", "2", "gear 2"),
        "ratio": Channel(m.law.rates(phi)[0], "", "ratio of the speeds"),
        "s1": Channel(m.distance * now.r1, "mm", "pitch radius of gear 1"),
        "s2": Channel(m.distance * now.r2, "mm", "pitch radius of gear 2"),
        "pressure_angle": Channel(
            np.abs(now.tilt) + m.given.pressure_angle * math.radians(1), "rad", "pressure angle at the shaft"
        ),
    }


def driven_by(m: GearTable, driver: Turning, time: Array) -> Motion:
    """The motion for any motion of the driver, at times (n,), s; raises as :func:`motion_of`."""
    for one in errors(LAW.findings(m), Stage.MOTION):
        finding = advised(m.given, one)
        raise KinematicsError(f"{finding.parameter}: {finding.message}; {finding.remedy}")
    a, found = m.pair.axis, _channels(m, driver, time)
    poses = {
        "gear-1": Poses.planar(0.0, 0.0, driver.theta),
        "gear-2": Poses.planar(a, 0.0, found["theta2"].values),
    }
    joints = {
        "o1": Joint("revolute", GROUND, "gear-1", drives=True),
        "o2": Joint("revolute", GROUND, "gear-2", (a, 0.0, 0.0)),
        "mesh": Joint("gear", "gear-1", "gear-2"),
    }
    loads = {"load_torque": Load("gear-2", resisting=m.given.load_torque)}
    return Motion("theta1", found, poses, scalars(figures(m)), {}, joints, _pitch_curves(m), loads)


def _pitch_curves(m: GearTable) -> dict[str, Curve]:
    found = {}
    for name, curve in zip(NAMES, (m.pair.driver, m.pair.driven), strict=True):
        around = np.linspace(0.0, math.tau, _PITCH_SAMPLES)
        point = curve.frame(around if m.given.sector is None else curve.around(_PITCH_SAMPLES)).point
        found[f"pitch-{name}"] = Curve.planar(name, point[:, 0] + 1j * point[:, 1])
    return found
