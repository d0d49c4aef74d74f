"""The test kit for controls: a contract to subclass, and a program with everything in it.

It needs pytest, which the ``test`` extra brings; nothing else of Mechwright imports it.
"""
# ruff: noqa: E402 - the rewriting of assertions has to be asked for before the imports

import pytest

pytest.register_assert_rewrite("mechwright_cam.testing.post")

from mechwright_cam.testing.post import PostContract
from mechwright_cam.testing.programs import sample_program

__all__ = ["PostContract", "sample_program"]
