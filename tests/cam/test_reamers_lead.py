"""A reamer has to go through with its lead, and not with its tip alone: there the hole is not to size yet."""

import re

import pytest
from by_control import BY_NAME, EVERY, prove
from golden_operations import made

from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import REAMER_LEAD


def deep(operation: str, control: str, z: float) -> dict[str, str]:
    """What the proof says of the program whose reamer goes to Z ``z``: rule to message."""
    (one,) = made(operation, control)
    stems = {stem: re.sub(r"Z-5\.2(?!\d)", f"Z{z:.3f}", text) for stem, text in one.files.items()}
    assert stems != one.files
    text = stems if len(stems) > 1 else "".join(stems.values())
    return {check.name: check.message for check in prove(text, one.job, BY_NAME[control]).failures}


@pytest.mark.parametrize("control", EVERY)
def test_its_tip_at_the_underside_is_not_enough(control: str) -> None:
    assert "stay on the wall of pin, which is to be cut to" in deep("ream", control, -4.0)["leftover"]
    assert deep("ream", control, -4.0 - REAMER_LEAD - 0.05) == {}


def test_the_way_goes_on_by_what_is_missing() -> None:
    """A plate of 4 mm: what is not to size yet is as thick as the lead is above the underside, at 45 degrees."""
    (said,) = deep("ream-milled", "linuxcnc", -4.85).values()
    assert said.startswith("0.053 mm of stock stay on the wall of pin")


def test_its_outline() -> None:
    (one,) = made("ream", "linuxcnc")
    reamer = next(tool for tool in one.job.tools if tool.name == "reamer-6")
    assert cutter(reamer).radius_at(0.0) == pytest.approx(3.0 - REAMER_LEAD)
    assert cutter(reamer).radius_at(REAMER_LEAD) == pytest.approx(3.0)
