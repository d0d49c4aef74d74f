"""Where pins and gears of a linkage stand."""

import math

import numpy as np

from mechwright import Array, Step, Turned
from mechwright_spherical.kinematics.chain import orientation
from mechwright_spherical.kinematics.drive import Train
from mechwright_spherical.kinematics.linkage import Linkage, linkage_of
from mechwright_spherical.kinematics.vectors import arc
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import shells_of
from mechwright_spherical.parts.seats import Seat, clamped, seats_of
from mechwright_spherical.parts.shells import Shells

ONE_SIZE = 0.02
"""mm. Pins of both phases that lie nearer to one circle than this share a link: less than the play of a
bore."""


def link_arcs(linkage: Linkage) -> dict[str, float]:
    """Arcs of the links with two joints, rad, those of phase 1 where phases differ."""
    loop = linkage.phases[0].loop
    found = {
        "ground": float(arc(loop.a0, loop.b0)),
        "crank": float(arc(loop.a0, loop.a1)),
        "rocker": math.acos(float(loop.cb)),
    }
    if linkage.five_bar is not None:
        found["arm"] = float(arc(loop.b0, loop.b1))
    return found


def second_size(linkage: Linkage, shells: Shells) -> dict[str, float]:
    """Links that phase 2 needs in another size, and their arcs then, rad."""
    mechanism = linkage.five_bar
    if mechanism is None:
        return {}
    pairs = {"crank": mechanism.crank_arcs, "rocker": mechanism.rocker_arcs}
    return {
        name: float(two)
        for name, (one, two) in pairs.items()
        if abs(float(one) - float(two)) * shells.links[name][1] > ONE_SIZE
    }


def pin_places(params: SphericalParams) -> dict[str, tuple[str, str, float]]:
    """Pins and shafts by part name: the key of its span, its body, and where it stands on that, rad.

    Studs that are clamped are not among them. A link that phase 2 needs in another size brings its own pin,
    with ``-n`` behind its name.
    """
    linkage = linkage_of(params)
    arcs, second = link_arcs(linkage), second_size(linkage, shells_of(params))
    pins = {"a": ("a", "crank", arcs["crank"]), "c": ("c", "rocker", arcs["rocker"])}
    found = {f"pin-{name}": pin for name, pin in pins.items() if name not in clamped(params)}
    found |= {
        f"{name}-n": (span, link, second[link]) for name, (span, link, _) in found.items() if link in second
    }
    found |= {
        "shaft-a0": ("a0", "crank", 0.0),
        "shaft-b0": ("b0", "arm" if "arm" in arcs else "rocker", 0.0),
    }
    if "arm" in arcs:
        found["pin-b"] = ("b", "arm", arcs["arm"])
    return found


def path_point(linkage: Linkage, frame: Array) -> Array:
    """The path point in the coupler's frame."""
    return np.asarray(frame.T @ linkage.phases[0].at_reference.p[0][:, 0])


def in_ground(linkage: Linkage, axis: Array) -> Array:
    """A direction in space, in the ground's frame."""
    loop = linkage.shown.loop
    return np.asarray(orientation(loop.a0, loop.b0).T @ axis)


def coupler_seats(linkage: Linkage, frame: Array) -> tuple[Seat, Seat]:
    """Where the coupler takes its two pins, in its frame."""
    a, c = (
        Seat(seat.name, frame.T @ seat.axis, tuple(frame.T @ place for place in seat.places))
        for seat in seats_of(linkage)
    )
    return a, c


def tool_of(params: SphericalParams, shells: Shells) -> Turned:
    """The tool in the coupler, from its point on the sphere outwards."""
    low, high = shells.pins["tool"]
    diameter = params.hardware.pin_diameter
    tip = min(diameter, (high - low) / 2)
    return Turned((Step(diameter, tip, start=0.0), Step(diameter, high - low - tip)))


def carried_by(params: SphericalParams, shaft: str) -> str:
    """The link on the shaft ``a0`` or ``b0``."""
    return "crank" if shaft == "a0" else "arm" if params.kind == "five-bar" else "rocker"


def gear_cones(train: Train) -> dict[str, tuple[str, float]]:
    """Gears by part name: body and half angle of the pitch cone, rad."""
    found = {"pinion": ("pinion", train.pinion), "wheel": ("arm", train.wheel)}
    if train.idler_axis is not None:
        found["idler"] = ("idler", train.idler)
    return found


def gear_span(params: SphericalParams, shells: Shells, train: Train) -> tuple[float, float]:
    """From where to where pitch cones go, mm along them: the widest one's flat end clears the ground."""
    widest = max(train.pinion, train.wheel, train.idler)
    inner = (shells.outside + params.hardware.gap) / math.cos(widest)
    return inner, inner + params.drive.face_width
