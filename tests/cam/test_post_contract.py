"""The built-in post under the kit that third parties use."""

from mechwright_cam.controls import LinuxCncPost
from mechwright_cam.testing import PostContract


class TestLinuxCnc(PostContract):
    post = LinuxCncPost
