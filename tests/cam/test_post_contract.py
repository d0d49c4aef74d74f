"""The built-in post under the kit that third parties use."""

from mechwright.testing import PostContract
from mechwright_cam.posts import LinuxCncPost


class TestLinuxCnc(PostContract):
    post = LinuxCncPost
