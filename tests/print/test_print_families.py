"""The first example of every family, printed, read back, sliced and put together, as the benchmark does."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

from bench_print import EXAMPLES, printed

BED = 256.0
"""mm. The base plate of the shaper takes 236 x 216 mm, more than a bed of 220 mm."""


@pytest.mark.parametrize("family", EXAMPLES)
def test_the_first_example_of_a_family_is_printed(family, request, tmp_path):
    example = request.config.rootpath / "examples" / f"{EXAMPLES[family]}.toml"
    found = printed(example, tmp_path, BED)
    assert found.parts > 0
    assert found.read in {"closed", "no reader"}
    if found.sliced is not None:
        assert found.ours == pytest.approx(found.sliced, rel=0.1)
    assert found.walls_off < 0.01
    assert found.play_error < 0.015
    assert found.overlaps == ()
