"""Where the shafts of cam and lever stand and what loads them."""

from dataclasses import replace

from mechwright import Hub, Mounting, MountingError, Spindle
from mechwright_cam_follower.extremes import face_of
from mechwright_cam_follower.motion import CAM, FOLLOWER, loaded
from mechwright_cam_follower.params import CamParams
from mechwright_cam_follower.parts import follower_depth, follower_foot, second_foot


def mounting_of(params: CamParams) -> Mounting:
    """Both shafts.

    Raises
    ------
    MountingError
        The follower slides, the cams are two, or the cam has no bore.
    """
    if params.translating:
        raise MountingError(
            "parameters.follower: a slide has rails and no shaft, and no frame is made for it; leave "
            '[machine] out, or set follower = "oscillating"'
        )
    if params.conjugate:
        raise MountingError(
            "parameters.conjugate: the cams of a pair sit on both sides of the lever, and no frame is made "
            "for them; leave [machine] out"
        )
    if params.bore == 0:
        raise _boreless()
    most = loaded(params)
    torque = most["torque_max"].value
    force = most["contact_force_max"].value / torque if torque > 0 else 0.0
    arm = force * _arm(params) / 1000
    cam = _camshaft(params)
    return Mounting(
        (replace(cam, force=force), replace(_pivot(params), torque=arm, force=force)),
        ("parameters.axial_gap", params.axial_gap),
    )


def shafts_of(params: CamParams) -> Mounting:
    """What shafts go through: the cam or both cams, and the lever; raises MountingError without a bore."""
    if params.bore == 0:
        raise _boreless()
    cam = _camshaft(params)
    return Mounting((cam,) if params.translating else (cam, _pivot(params)))


def _boreless() -> MountingError:
    return MountingError(
        "parameters.bore: a cam without a bore has no shaft; set bore = 15", ({"parameters.bore": 15.0},)
    )


def _camshaft(params: CamParams) -> Spindle:
    top = params.thickness
    if params.conjugate:
        top = second_foot(params) + params.thickness
    hub = Hub(0.0, top, params.bore, params.keyway_width, material=params.material)
    return Spindle("cam", CAM, (0.0, 0.0), hub, "parameters.bore", drives=True)


def _pivot(params: CamParams) -> Spindle:
    foot, at = follower_foot(params), (params.value("centre_distance"), 0.0)
    hub = Hub(foot, foot + follower_depth(params), params.pivot_bore, material=params.material)
    return Spindle("lever", FOLLOWER, at, hub, "parameters.pivot_bore")


def _arm(params: CamParams) -> float:
    """Longest lever of the contact force about the lever's axis, mm."""
    if params.contact == "roller":
        return params.value("arm_length")
    return max(map(abs, face_of(params)))
