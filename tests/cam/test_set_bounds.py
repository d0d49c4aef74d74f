"""What ``verify --set`` is given: a key and a value of few parts."""

import time
from pathlib import Path

import pytest
from foreign import coupler_drawing

from mechwright.errors import DesignError
from mechwright_cam.commands.verify_drawing import job_of


@pytest.mark.parametrize(
    "change",
    [
        ".".join(["a"] * 40_000) + "=1",
        "deburr=" + "[" * 100_000,
        "deburr=" + "9" * 6000,
        "deburr={" + "a." * 40_000 + "b=1}",
    ],
    ids=["parts", "lists", "digits", "inline"],
)
def test_what_is_set_has_bounds(tmp_path: Path, change: str) -> None:
    asked = {"control": "", "material": "", "hold": "", "stock": "", "units": "", "layers": ()}
    drawing = tmp_path / "coupler.dxf"
    coupler_drawing(drawing)
    began = time.process_time()
    with pytest.raises(DesignError):
        job_of(drawing, 6.0, "1=mill-2", library=None, **asked, changes=(change,))
    assert time.process_time() - began < 5
