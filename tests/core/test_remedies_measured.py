"""Remedies for what a finding has measured and has no key for, and of several parts at once."""

from beam_family import bench, design

from mechwright.contracts.finding import Finding
from mechwright.remedies.measured import measured
from mechwright.remedies.search import related, unnamed


def deep(value: float, limit: float | None, unit: str = "mm", parameter: str = "cam.tools") -> Finding:
    return Finding.error("cam.too-deep", parameter, "no mill cuts part width", value, limit, unit)


def test_the_key_that_is_as_large_as_what_was_found_is_changed_by_what_is_too_much() -> None:
    one = bench(design(length=437.5))
    assert list(measured(one, deep(440.0, 300.0), {})) == [{"parameters.length": 297}]
    # What was decided before counts as the present value.
    assert list(measured(one, deep(440.0, 300.0), {"parameters.length": 100})) == []


def test_nothing_is_measured_without_a_limit_a_unit_or_a_key_of_its_size() -> None:
    one = bench(design(length=437.5))
    assert not any(
        list(measured(one, finding, {}))
        for finding in (deep(440.0, None), deep(440.0, 300.0, ""), deep(6000.0, 300.0), deep(440.0, 440.0))
    )


def test_a_finding_with_a_key_of_its_own_is_not_guessed_at() -> None:
    one = bench(design(length=437.5))
    assert unnamed(one, deep(440.0, 300.0), {})
    assert unnamed(one, deep(440.0, 300.0, parameter="length"), {}) == []


def test_the_name_of_a_part_is_no_key() -> None:
    one = bench(design(length=437.5))
    assert related(one, deep(440.0, 300.0)) == []
    named = Finding.error("cam.too-deep", "cam.tools", "a width of 3 mm")
    assert [key.name for key in related(one, named)] == ["width"]


def test_what_is_as_large_as_the_mechanism_makes_all_its_lengths_smaller_in_one_ratio() -> None:
    one = bench(design(length=800.0, width=200.0, holes=3))
    changes = list(measured(one, deep(1000.0, 500.0), {}))
    # Of 1000 mm the length accounts for 800, or for all: half of it, 0.4375, or 0.375 of it.
    assert changes == [
        {"parameters.length": length, "parameters.width": width}
        for length, width in ((400, 100), (350, 87.5), (300, 75))
    ]
    # A width that is no tenth of the length is a plate's, and goes along only where nothing else does.
    slender = list(measured(bench(design(length=800.0, width=70.0)), deep(1000.0, 500.0), {}))
    assert slender[:2] == [{"parameters.length": 400}, {"parameters.length": 400, "parameters.width": 35}]


def test_nothing_is_made_larger_as_a_whole() -> None:
    assert list(measured(bench(design(length=300.0, width=100.0)), deep(500.0, 1000.0), {})) == []
