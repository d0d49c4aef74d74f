"""Posts: from neutral programs to the text of one control."""

from mechwright_cam.posts.linuxcnc import LinuxCncPost

__all__ = ["LinuxCncPost"]
