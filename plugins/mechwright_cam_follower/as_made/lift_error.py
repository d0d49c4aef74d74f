"""How far the follower is from its law with the cams as their programs leave them."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from mechwright import Array, AsMade, MadeCurve, MadeFigure, MadePart
from mechwright.mechanics.gearing.running import about_bore
from mechwright_cam_follower.kinematics.contact import Contact
from mechwright_cam_follower.kinematics.mechanism import Mechanism, mechanism_of
from mechwright_cam_follower.kinematics.motion import contacts_at
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.parts.cam_outline import outline_of

RULE = "gap along the normal over the cosine of the pressure angle, of a lever over its arm too"
_STATIONS = 721
"""Places of a turn: every half degree."""


def as_made(params: CamParams, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the cams: part name to its copies as made."""
    m, figures, curves = mechanism_of(params), [], []
    theta = np.linspace(0.0, math.tau, _STATIONS)
    contacts = contacts_at(m, m.cycle.at(theta))
    unit = "mm" if m.slides else "rad"
    for cam, contact in enumerate(contacts):
        name = "cam-2" if cam else "cam"
        copies = made.get(name, ())
        if not copies:
            continue
        drawn = error_of(m, theta, contact, outline_of(m, cam)[0].flatten())
        one = copies[0]
        error = error_of(m, theta, contact, about_bore(one, params.bore))
        room = one.corridor / np.abs(contact.share)
        worst = int(np.argmax(np.abs(error)))
        figures.append(
            MadeFigure(
                f"{name}.lift-error",
                f"greatest deviation of the lift by the {'second ' if cam else ''}cam",
                unit,
                None,
                float(drawn[np.argmax(np.abs(drawn))]),
                float(error[worst]),
                float((error - room).min()),
                float((error + room).max()),
                RULE,
            )
        )
        curves.append(
            MadeCurve(
                f"Deviation of the lift, {name}",
                "angle of the cam, degrees",
                unit,
                np.degrees(theta),
                {"as drawn": drawn, "as made": error},
            )
        )
    return AsMade(tuple(figures), tuple(curves))


def error_of(m: Mechanism, theta: Array, contact: Contact, outline: Array) -> Array:
    """How much higher the follower stands on an outline (m, 2) than its law says, mm or rad, (n,)."""
    import shapely

    turned = np.exp(-1j * m.sense * theta)
    if not m.flat:
        centre = contact.centre * turned
        ring = shapely.LinearRing(outline)
        away = shapely.distance(ring, shapely.points(centre.real, centre.imag))
        over = m.roller - away
    else:
        normal = contact.outward * turned
        reach = (outline @ np.stack((normal.real, normal.imag))).max(axis=0)
        over = reach - (contact.point * np.conj(contact.outward)).real
    error: Array = over / contact.share
    return error
