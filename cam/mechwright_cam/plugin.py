"""What the CAM stage registers: controls."""

from mechwright.plugins.hookspecs import hookimpl
from mechwright_cam.controls.contract import Control


@hookimpl
def mechwright_register_posts() -> list[type[Control]]:
    """The controls that programs can be written for."""
    from mechwright_cam.controls.fanuc import Fanuc
    from mechwright_cam.controls.grbl import Grbl
    from mechwright_cam.controls.haas import Haas
    from mechwright_cam.controls.linuxcnc import LinuxCnc
    from mechwright_cam.controls.mach3 import Mach3

    return [LinuxCnc, Fanuc, Haas, Mach3, Grbl]
