"""Large holes in the corners of a four-bar's ground plates keep a rim between them."""

import itertools

import pytest

from mechwright.geometry import Arc
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.parameters import FourBarParams

FAMILY = FourBars()


@pytest.mark.parametrize("frame", ["one", "two"])
@pytest.mark.parametrize("hole", [6.0, 51.56, 120.0])
def test_holes_of_one_end_do_not_run_into_each_other(frame, hole):
    """They stood beside the line of both shafts as near as the bores allow, whatever their size."""
    params = FourBarParams(frame=frame, screw_hole=hole, rim=7.724)
    found = {part.name: part.outline for part in FAMILY.parts(params) if part.outline is not None}
    screws = [
        loop.segments[0]
        for loop in found["ground"].inner
        if loop.is_circle and loop.segments[0].radius == pytest.approx(hole / 2)
    ]
    assert len(screws) >= 4
    for one, two in itertools.combinations(screws, 2):
        assert isinstance(one, Arc)
        apart = abs(complex(*one.centre) - complex(*two.centre)) - one.radius - two.radius
        assert apart >= params.rim - 1e-9
