"""The frames on all axes over the motion, and what holds the bodies."""

import math
from collections.abc import Mapping

import numpy as np

from mechwright import GROUND, Joint, Poses
from mechwright.contracts.joint import fixed
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright_five_bar.kinematics.phases import set_joints
from mechwright_five_bar.parts.hub import hub_of
from mechwright_five_bar.parts.layout import screw_places
from mechwright_five_bar.table import FiveBarTable


def fixed_frames(m: FiveBarTable) -> dict[str, tuple[str, complex]]:
    """Frames on the axes of pins, by name: body and place in it, mm; without a layout, of the joints."""
    params, layout = m.params, m.layout_or_none
    places = {
        "crank-a": ("crank", complex(params.crank)),
        "arm-b1": ("arm", complex(params.arm)),
        "rocker-c": ("rocker", complex(params.rocker)),
        "coupler-c": ("coupler", complex(params.coupler)),
        "coupler-point": ("coupler", params.coupler_point),
        "ground-b0": ("ground", complex(params.ground)),
    }
    for name, one in set_joints(params).items():
        if one.slot is None:
            for number, at in enumerate(one.places[1:], start=2):
                places[f"coupler-{name.lower()}{number}"] = ("coupler", at)
    if layout is None:
        return places
    if params.idler_teeth:
        places["ground-idler"] = ("ground", m.train.places["idler"])
    if params.screw_hole is None:
        places |= {f"ground-post-{n}": ("ground", at) for n, at in enumerate(layout.posts, start=1)}
    hub = hub_of(params)
    if hub is not None:
        places |= {f"wheel-screw-{n}": ("wheel", at) for n, at in enumerate(screw_places(hub), start=1)}
    return places


def frames_of(m: FiveBarTable, bodies: Mapping[str, BodyMotion]) -> dict[str, Poses]:
    """Poses of all bodies, and of the frames on their axes, from the motion of the moving links."""
    pivot, moving = m.pivot, {name: bodies[name] for name in ("crank", "coupler", "rocker", "arm")}
    crank, ground = bodies["crank"].turning, math.radians(m.params.ground_angle)
    moving["ground"] = BodyMotion.about(0j, Turning.of(np.full_like(crank.theta, ground)))
    if m.layout_or_none is not None:
        train = m.train
        start = train.angles(-ground)
        turn = complex(math.cos(ground), math.sin(ground))
        for name, at in train.places.items():
            if name != "pinion":
                theta = crank.theta * train.ratio(name) + start[name] + ground
                moving[name] = BodyMotion.about(at * turn, Turning.of(theta))
    poses = {}
    places = {name: (name, 0j) for name in moving} | fixed_frames(m)
    for frame, (body, place) in places.items():
        origin = moving[body].point(place).position + pivot
        poses[frame] = Poses.planar(origin.real, origin.imag, moving[body].turning.theta)
    return poses


def held_by(m: FiveBarTable) -> dict[str, Joint]:
    """What holds the bodies of :func:`frames_of`, the loop closed in C."""
    params, held = m.params, fixed(GROUND, "ground")
    for frame, (body, _) in fixed_frames(m).items():
        held |= fixed(body, frame)
    b0 = (params.ground, 0.0, 0.0)
    held |= {
        "A0": Joint("revolute", "ground", "crank", drives=True),
        "B0": Joint("revolute", "ground", "arm", b0),
        "A": Joint("revolute", "crank", "coupler", (params.crank, 0.0, 0.0)),
        "B1": Joint("revolute", "arm", "rocker", (params.arm, 0.0, 0.0)),
        "C": Joint("revolute", "rocker", "coupler", (params.rocker, 0.0, 0.0)),
    }
    if m.layout_or_none is None:
        return held | {"gears": Joint("gear", "crank", "arm", ratio=params.ratio)}
    train, last = m.train, "crank"
    held |= fixed("arm", "wheel")
    for name, at in train.places.items():
        if name == "pinion":
            continue
        body = "arm" if name == "wheel" else name
        if body == "idler":
            held["axis-idler"] = Joint("revolute", "ground", "idler", (at.real, at.imag, 0.0))
        earlier = 1.0 if last == "crank" else train.ratio(last)
        held[f"gear-{name}"] = Joint("gear", last, body, ratio=train.ratio(name) / earlier)
        last = body
    return held
