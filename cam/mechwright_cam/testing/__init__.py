"""The test kit for controls: a contract to subclass, and a program with everything in it.

It needs pytest, which the ``test`` extra brings; nothing else of Mechwright imports it.
"""
# ruff: noqa: E402 - the rewriting of assertions has to be asked for before the imports

import pytest

pytest.register_assert_rewrite("mechwright_cam.testing.control", "mechwright_cam.testing.agreement")

from mechwright_cam.testing.control import ControlContract
from mechwright_cam.testing.programs import compensated_sample, plate_job, sample_program

__all__ = ["ControlContract", "compensated_sample", "plate_job", "sample_program"]
