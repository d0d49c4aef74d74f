"""Where the shafts of cam and lever stand and what loads them."""

from dataclasses import replace

from mechwright import Hub, Mounting, MountingError, Post, Spindle
from mechwright_cam_follower.kinematics.extremes import face_ends, load_peak
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.kinematics.motion import CAM, FOLLOWER
from mechwright_cam_follower.parts.follower_dimensions import follower_depth, follower_foot
from mechwright_cam_follower.parts.parts import second_foot
from mechwright_cam_follower.parts.spring_parts import SPRING, spring_place


def mounting_of(m: Mechanism) -> Mounting:
    """Both shafts.

    Raises
    ------
    MountingError
        The follower slides, the cams are two, or the cam has no bore.
    """
    if m.slides:
        raise MountingError(
            "parameters.follower: a slide has rails and no shaft, and no frame is made for it; leave "
            '[machine] out, or set follower = "oscillating"'
        )
    if m.given.conjugate:
        raise MountingError(
            "parameters.conjugate: the cams of a pair sit on both sides of the lever, and no frame is made "
            "for them; leave [machine] out"
        )
    if m.given.bore == 0:
        raise _boreless()
    torque = load_peak(m, "torque_max").value
    force = load_peak(m, "contact_force_max").value / torque if torque > 0 else 0.0
    arm = force * _arm(m) / 1000
    cam = _camshaft(m)
    return Mounting(
        (replace(cam, force=force), replace(_pivot(m), torque=arm, force=force)),
        ("parameters.axial_gap", m.given.axial_gap),
        posts=_posts(m),
        fastest=None if m.given.spring is None else (m.given.speed, "parameters.speed"),
    )


def _posts(m: Mechanism) -> tuple[Post, ...]:
    """The pin that the spring pulls at; none without a spring that is bought."""
    place = spring_place(m)
    if place is None or place.held.post is None:
        return ()
    at, held = place.stands, place.held
    return (
        Post(
            "spring-post",
            (at.real, at.imag),
            held.post,
            place.z,
            held.head,
            frozenset({SPRING}),
            "parameters.spring",
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
