"""Posts: from neutral programs to the text of one control."""

from mechwright_cam.controls.fanuc import FanucPost
from mechwright_cam.controls.grbl import GrblPost
from mechwright_cam.controls.haas import HaasPost
from mechwright_cam.controls.linuxcnc import LinuxCncPost
from mechwright_cam.controls.mach3 import Mach3Post

__all__ = ["FanucPost", "GrblPost", "HaasPost", "LinuxCncPost", "Mach3Post"]
