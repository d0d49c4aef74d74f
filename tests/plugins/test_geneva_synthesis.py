"""Synthesis of Geneva mechanisms: the size that is asked for, sizes that can be bought, what is rejected."""

import pytest
from pydantic import ValidationError

from mechwright.contracts.finding import errors
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.defaults.preferred_sizes import PINS, ROLLERS
from mechwright_geneva.family import Geneva
from mechwright_geneva.requirements import IndexingRequirement
from mechwright_geneva.synthesis.indexing import from_indexing


def synthesis(**table):
    asked = {"laws": ["modified-sine"], "index_time": 0.4, "designs": 3, **table}
    return from_indexing(IndexingRequirement(**asked), lambda done, what: None)


@pytest.mark.parametrize("slots", [3, 6, 9, 12])
@pytest.mark.parametrize(
    "size", [{}, {"wheel_diameter": 200}, {"centre_distance": 120}], ids=["", "wheel", "axes"]
)
def test_designs_have_the_size_and_standard_rollers(slots, size):
    result = synthesis(slots=slots, **size)
    assert result.candidates
    for candidate in result.candidates:
        params, m = candidate.params, mechanism_of(candidate.params)
        assert errors(Geneva().check(params)) == []
        assert 2 * params.roller_radius in ROLLERS
        assert params.pin_diameter in PINS
        if "wheel_diameter" in size:
            assert m.rim == 100
        if "centre_distance" in size:
            assert m.axes == pytest.approx(120, abs=1e-9)
        if not size:
            assert m.rim + m.axes + m.crank <= 300


def test_an_overall_length_bounds_a_wheel_that_is_given():
    assert synthesis(slots=6, wheel_diameter=200, overall_length=300).candidates
    refused = synthesis(slots=6, wheel_diameter=200, overall_length=210)
    (fault,) = errors(refused.findings)
    assert (fault.parameter, fault.value) == ("wheel_diameter", 200)


def test_one_size_is_enough():
    with pytest.raises(ValidationError, match="leave one of them out"):
        IndexingRequirement(wheel_diameter=200, centre_distance=120)


def test_designs_that_are_not_given_have_a_reason():
    """Slots that are sound, and a disc that the horns cut: counted, with what the check says of the first."""
    (reason,) = synthesis(slots=4, designs=5).rejected
    assert (reason.code, str(reason)) == ("geneva.lock", f"{reason.count} lock")
    assert reason.count > 1
    assert "locking disc" in reason.message
