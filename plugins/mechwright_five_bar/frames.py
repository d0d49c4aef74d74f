"""The frames on all axes over the motion, and what holds the bodies."""

import math
from collections.abc import Mapping

import numpy as np

from mechwright import GROUND, Joint, Poses, kept
from mechwright.contracts.joint import fixed
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright_five_bar.hub import hub_of
from mechwright_five_bar.layout import Layout, laid_out, screw_places
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.phases import set_joints
from mechwright_five_bar.train import train_of


def layout_of(params: FiveBarParams) -> Layout:
    """Plates and layers of a design that shows its first phase; raises as :func:`laid_out`."""
    return _kept_layout(params.unloaded)


_kept_layout = kept(laid_out)


def layout_or_none(params: FiveBarParams) -> Layout | None:
    """As :func:`layout_of`; None where there is none."""
    from mechwright import GeometryError, KinematicsError

    try:
        return layout_of(params)
    except (GeometryError, KinematicsError):
        return None


def pivot_of(params: FiveBarParams) -> complex:
    """A0, x + i y, mm."""
    return complex(params.pivot_x, params.pivot_y)


@kept
def fixed_frames(params: FiveBarParams) -> dict[str, tuple[str, complex]]:
    """Frames on the axes of pins, by name: body and place in it, mm; without a layout, of the joints."""
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
    layout = layout_or_none(params)
    if layout is None:
        return places
    if params.idler_teeth:
        places["ground-idler"] = ("ground", train_of(params).places["idler"])
    if params.screw_hole is None:
        places |= {f"ground-post-{n}": ("ground", at) for n, at in enumerate(layout.posts, start=1)}
    hub = hub_of(params)
    if hub is not None:
        places |= {f"wheel-screw-{n}": ("wheel", at) for n, at in enumerate(screw_places(hub), start=1)}
    return places


def frames_of(params: FiveBarParams, bodies: Mapping[str, BodyMotion]) -> dict[str, Poses]:
    """Poses of all bodies, and of the frames on their axes, from the motion of the moving links."""
    pivot, moving = pivot_of(params), dict(bodies)
    crank, ground = bodies["crank"].turning, math.radians(params.ground_angle)
    moving["ground"] = BodyMotion.about(0j, Turning.of(np.full_like(crank.theta, ground)))
    if layout_or_none(params) is not None:
        train = train_of(params)
        start = train.angles(-ground)
        turn = complex(math.cos(ground), math.sin(ground))
        for name, at in train.places.items():
            if name != "pinion":
                theta = crank.theta * train.ratio(name) + start[name] + ground
                moving[name] = BodyMotion.about(at * turn, Turning.of(theta))
    poses = {}
    places = {name: (name, 0j) for name in moving} | fixed_frames(params)
    for frame, (body, place) in places.items():
        origin = moving[body].point(place).position + pivot
        poses[frame] = Poses.planar(origin.real, origin.imag, moving[body].turning.theta)
    return poses


def held_by(params: FiveBarParams) -> dict[str, Joint]:
    """What holds the bodies of :func:`frames_of`, the loop closed in C."""
    held = fixed(GROUND, "ground")
    for frame, (body, _) in fixed_frames(params).items():
        held |= fixed(body, frame)
    b0 = (params.ground, 0.0, 0.0)
    held |= {
        "A0": Joint("revolute", "ground", "crank", drives=True),
        "B0": Joint("revolute", "ground", "arm", b0),
        "A": Joint("revolute", "crank", "coupler", (params.crank, 0.0, 0.0)),
        "B1": Joint("revolute", "arm", "rocker", (params.arm, 0.0, 0.0)),
        "C": Joint("revolute", "rocker", "coupler", (params.rocker, 0.0, 0.0)),
    }
    if layout_or_none(params) is None:
        return held | {"gears": Joint("gear", "crank", "arm", ratio=params.ratio)}
    train, last = train_of(params), "crank"
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
