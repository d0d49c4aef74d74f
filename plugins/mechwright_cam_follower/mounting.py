"""Where the shafts of cam and lever stand and what loads them."""

from mechwright import Hub, Mounting, MountingError, Spindle
from mechwright_cam_follower.extremes import face_of
from mechwright_cam_follower.motion import CAM, FOLLOWER, loaded
from mechwright_cam_follower.params import CamParams
from mechwright_cam_follower.parts import follower_depth, follower_foot


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
        raise MountingError(
            "parameters.bore: a cam without a bore has no shaft; set bore = 15", ({"parameters.bore": 15.0},)
        )
    most = loaded(params)
    torque = most["torque_max"].value
    force = most["contact_force_max"].value / torque if torque > 0 else 0.0
    arm = force * _arm(params) / 1000
    foot = follower_foot(params)
    cam = Hub(0.0, params.thickness, params.bore, params.keyway_width, material=params.material)
    lever = Hub(foot, foot + follower_depth(params), params.pivot_bore, material=params.material)
    return Mounting(
        (
            Spindle("cam", CAM, (0.0, 0.0), cam, "parameters.bore", drives=True, force=force),
            Spindle(
                "lever",
                FOLLOWER,
                (params.value("centre_distance"), 0.0),
                lever,
                "parameters.pivot_bore",
                torque=arm,
                force=force,
            ),
        ),
        ("parameters.axial_gap", params.axial_gap),
    )


def _arm(params: CamParams) -> float:
    """Longest lever of the contact force about the lever's axis, mm."""
    if params.contact == "roller":
        return params.value("arm_length")
    return max(map(abs, face_of(params)))
