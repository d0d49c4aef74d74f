"""Where the shafts of cam and lever stand and what loads them."""

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

from mechwright import DesignError, Hub, Mounting, MountingError, Post, Slideway, Spindle
from mechwright.contracts.finding import Change
from mechwright.machine.frame.fixing import fixing
from mechwright.machine.frame.shafts import LEAST_COLLAR, RELIEF
from mechwright.standards.linear_guides import linear_guides
from mechwright.standards.stock import plate_stock
from mechwright_cam_follower.field_kinds import AUTO, DEFAULTS, SPRINGS
from mechwright_cam_follower.kinematics.extremes import face_ends, load_peak
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.kinematics.motion import CAM, FOLLOWER
from mechwright_cam_follower.parts.follower_dimensions import follower_depth, follower_foot
from mechwright_cam_follower.parts.parts import second_foot
from mechwright_cam_follower.parts.slide_dimensions import BESIDE_GUIDE, carriage_place, rail_start
from mechwright_cam_follower.parts.spring_parts import SPRING, hooking, spring_place


def mounting_of(m: Mechanism) -> Mounting:
    """Both shafts, or the cam's shaft and the way of a slide; the pin of a spring that is bought.

    Raises
    ------
    MountingError
        A slide has no linear guide, a follower no spring of its own or to buy, the cams are two, or the cam
        has no bore.
    """
    if m.given.conjugate:
        raise MountingError(
            "parameters.conjugate: the cams of a pair sit on both sides of the follower, and no frame is "
            "made for them; leave [machine] out"
        )
    if m.given.bore == 0:
        raise _boreless()
    if m.slides:
        _refuse_rails(m)
        _refuse_thickness(m)
    stated = "spring_preload" if m.slides else "spring_torque"
    if m.given.spring is None and not any(getattr(m.given, name) is not None for name in SPRINGS):
        raise MountingError(
            "parameters.spring: nothing says which spring holds the follower on its cam; "
            f'set spring = "auto", or state {stated}, as a stage of a chain has to',
            ({"parameters.spring": AUTO}, {f"parameters.{stated}": DEFAULTS[stated]}),
        )
    torque = load_peak(m, "torque_max").value
    force = load_peak(m, "contact_force_max").value / torque if torque > 0 else 0.0
    cam = replace(_camshaft(m), force=force)
    lever = () if m.slides else (replace(_pivot(m), torque=force * _arm(m) / 1000, force=force),)
    return Mounting(
        (cam, *lever),
        ("parameters.axial_gap", m.given.axial_gap),
        posts=_posts(m),
        slideways=tuple(_slideways(m)),
        fastest=None if m.given.spring is None else (m.given.speed, "parameters.speed"),
    )


def _refuse_rails(m: Mechanism) -> None:
    """Rails from plate hold a slide sideways alone, and a guide has room between cam and bearing plate."""
    need = follower_foot(m) + RELIEF + LEAST_COLLAR
    able = [one.name for one in linear_guides() if one.height >= need]
    guide = m.given.linear_guide
    if guide is not None and guide.name in able:
        return
    said = (
        "rails that are cut from plate hold a slide sideways alone"
        if guide is None
        else f"{guide.name} is {guide.height:g} mm high, and {need:g} mm are between slide and bearing plate"
    )
    changes: list[Change]
    if able:
        cure, changes = f'set guide = "{able[0]}"', [{"parameters.guide": one} for one in able]
    else:
        thin = m.given.thickness - (need - linear_guides()[-1].height)
        cure, changes = f"set thickness = {thin:g}", [{"parameters.thickness": thin}]
    key = next(iter(changes[0]))
    raise MountingError(f"{key}: {said}; {cure}", tuple(changes))


def _refuse_thickness(m: Mechanism) -> None:
    """No screw that is sold goes through the slide deep enough, and not too deep, into its carriage."""
    guide, thick = m.given.linear_guide, follower_depth(m)
    if guide is None:
        return

    def fits(one: float) -> bool:
        with suppress(DesignError):
            return fixing(guide.thread, one, guide.depth) is not None
        return False

    if fits(thick):
        return
    key = "parameters.thickness" if m.flat else "parameters.follower_thickness"
    sold = sorted(plate_stock(m.given.material).thicknesses, key=lambda one: abs(one - thick))
    works = [one for one in sold if fits(one)]
    raise MountingError(
        f"{key}: no screw M{guide.thread:g} that is sold joins a slide of {thick:g} mm to the carriage of "
        f"{guide.name}; set {key.partition('.')[2]} = {works[0]:g}",
        tuple({key: one} for one in works),
    )


def _slideways(m: Mechanism) -> Iterator[Slideway]:
    """The linear guide of a slide."""
    guide = m.given.linear_guide
    if guide is None:
        return
    way = guide.length + m.stroke + 2 * BESIDE_GUIDE
    yield Slideway(
        guide.cut(way),
        FOLLOWER,
        (m.offset, rail_start(m)),
        math.pi / 2,
        follower_foot(m) - guide.height,
        (0.0, carriage_place(m)),
        follower_depth(m),
        "parameters.guide",
    )


def _posts(m: Mechanism) -> tuple[Post, ...]:
    """The pin that the spring pulls at; none without a spring that is bought."""
    place = spring_place(m)
    diameter = None if place is None else place.mounted.post
    if place is None or diameter is None:
        return ()
    at, mounted = place.stands, place.mounted
    return (
        Post(
            "spring-post",
            (at.real, at.imag),
            diameter,
            place.z + mounted.shank,
            mounted.post_head,
            frozenset({SPRING}),
            "parameters.spring",
            mounted.hangs,
            hooking(place) if mounted.hangs else "",
        ),
    )


def shafts_of(m: Mechanism) -> Mounting:
    """What shafts go through: the cam or both cams, and the lever; raises MountingError without a bore."""
    if m.given.bore == 0:
        raise _boreless()
    cam = _camshaft(m)
    return Mounting((cam,) if m.slides else (cam, _pivot(m)))


def _boreless() -> MountingError:
    return MountingError(
        "parameters.bore: a cam without a bore has no shaft; set bore = 15", ({"parameters.bore": 15.0},)
    )


def _camshaft(m: Mechanism) -> Spindle:
    top = m.given.thickness
    if m.given.conjugate:
        top = second_foot(m) + m.given.thickness
    hub = Hub(0.0, top, m.given.bore, m.given.keyway_width, material=m.given.material)
    return Spindle("cam", CAM, (0.0, 0.0), hub, "parameters.bore", drives=True)


def _pivot(m: Mechanism) -> Spindle:
    foot, at = follower_foot(m), (m.axis, 0.0)
    hub = Hub(foot, foot + follower_depth(m), m.given.pivot_bore, material=m.given.material)
    return Spindle("lever", FOLLOWER, at, hub, "parameters.pivot_bore")


def _arm(m: Mechanism) -> float:
    """Longest lever of the contact force about the lever's axis, mm."""
    arm: float = max(map(abs, face_ends(m))) if m.flat else m.arm
    return arm
