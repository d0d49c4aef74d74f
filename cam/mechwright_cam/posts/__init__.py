"""Posts: from neutral programs to the text of one control."""

from mechwright_cam.posts.fanuc import FanucPost
from mechwright_cam.posts.grbl import GrblPost
from mechwright_cam.posts.haas import HaasPost
from mechwright_cam.posts.linuxcnc import LinuxCncPost
from mechwright_cam.posts.mach3 import Mach3Post

__all__ = ["FanucPost", "GrblPost", "HaasPost", "LinuxCncPost", "Mach3Post"]
