"""What the CAM stage registers: posts."""

from mechwright.plugins.hookspecs import hookimpl
from mechwright_cam.controls.contract import Post


@hookimpl
def mechwright_register_posts() -> list[type[Post]]:
    """The controls that programs can be written for."""
    from mechwright_cam.controls import FanucPost, GrblPost, HaasPost, LinuxCncPost, Mach3Post

    return [LinuxCncPost, FanucPost, HaasPost, Mach3Post, GrblPost]
