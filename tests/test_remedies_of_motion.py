"""A remedy of the parts leaves the motion what it is: a crank that turns stays one, and lengths asked for stay."""

from pathlib import Path

import pytest

from mechwright import Severity
from mechwright.contracts.finding import errors
from mechwright.designs.design import Design, design_of
from mechwright.plugins.host import host
from mechwright.remedies import Limits, nearest, of_family
from mechwright.remedies.search import Worth, worth


def design(family: str, **parameters: float) -> Design:
    content = {"format": 1, "family": family, "name": "small", "parameters": parameters}
    return design_of(content, Path("small.toml"), "", host())


@pytest.mark.parametrize(
    ("family", "lengths", "said"),
    [
        ("slider-crank", {"crank": 3.0, "rod": 10.0, "offset": 1.0}, {"pin": 2.0}),
        ("four-bar", {"crank": 3.0, "coupler": 8.0, "follower": 7.0, "ground": 9.0}, {"pin_diameter": 6.0}),
    ],
)
def test_of_a_small_mechanism_pins_are_made_smaller_and_no_length_is_changed(
    family: str, lengths: dict[str, float], said: dict[str, float]
) -> None:
    small = design(family, **lengths, **said)
    change = nearest(of_family(small, Limits(1500, 60.0)))
    assert change
    assert not {f"parameters.{name}" for name in lengths} & change.keys()
    found = small.changed(change).check()
    assert not errors(found)
    assert not [one for one in found if one.severity is Severity.WARNING and "turn" in one.message]


def test_a_crank_that_turns_is_not_made_a_lever_for_the_sake_of_its_bores() -> None:
    bench = of_family(design("slider-crank", crank=3.0, rod=10.0, offset=1.0, pin=2.0), Limits())
    (web,) = bench.errors({}) or []
    lever = {"parameters.crank": 15.4}
    assert bench.builds(lever)
    assert bench.spoils(lever)
    assert worth(bench, web, [web], lever) is Worth.REVEALS
    assert not bench.kept_by({"parameters.pin": 1.0})(lever)
    assert bench.kept_by(lever)(lever)


def test_where_a_crank_is_a_lever_already_nothing_is_spoiled() -> None:
    bench = of_family(design("slider-crank", crank=9.0, rod=9.5, offset=1.0), Limits())
    assert not bench.spoils({"parameters.crank": 15.4})
