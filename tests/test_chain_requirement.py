"""Requirements over a whole chain: what is found keeps its limits, and what cannot be is told."""

import math
import tomllib
from pathlib import Path
from typing import Any

import pytest
from by_night import by_night
from jsonschema import Draft202012Validator
from pydantic import ValidationError

from mechwright import host
from mechwright.designs.requirement import Requirement, requirement_of
from mechwright.designs.schema import file_schema
from mechwright.errors import DesignError
from mechwright.mechanics.chain import ChainParams
from mechwright.mechanics.chain.motion import rate_figures
from mechwright.mechanics.chain.wanted import ChainRequirement, FigureLimit, FreeKey
from mechwright.scripting.synthesis import sought

GEARS = {
    "family": "elliptic-gears",
    "parameters": {"eccentricity": 0.25, "teeth": 36, "bore": 6},
}
ROCKER = {
    "family": "four-bar",
    "parameters": {"crank": 30, "coupler": 100, "follower": 70, "ground": 105},
}
FREE = {"key": "stage.1.parameters.eccentricity", "low": 0.0, "high": 0.3}
START = {"key": "stage.2.start", "low": 0.0, "high": 360.0}


def asked(requirement: dict[str, Any], stages: list[dict[str, Any]] | None = None) -> Requirement:
    content = {"format": 1, "name": "sought", "stage": stages or [GEARS, ROCKER], "requirement": requirement}
    return requirement_of(content, Path("sought.toml"), "", host())


@by_night
def test_the_least_within_limits_is_no_worse_than_any_of_a_grid() -> None:
    """The rocker's greatest speed over the gears' eccentricity, which a limit of the ratio ends."""
    limit = {"figure": "1.ratio_max", "most": 1.4}
    wanted = asked({"least": "-2.output_speed_max", "free": [FREE], "limits": [limit], "tries": 24})
    found = sought(wanted, host()).result
    (best,) = found.candidates
    assert isinstance(best.params, ChainParams)
    e = best.params.stage[0].parameters.eccentricity  # type: ignore[attr-defined]
    # Of elliptic gears the greatest ratio is (1 + e)/(1 - e).
    assert (1 + e) / (1 - e) <= 1.4 * (1 + 1e-9)
    assert e == pytest.approx(0.4 / 2.4, abs=0.002)
    value = best.figures["2.output_speed_max"].value
    families = wanted.family.families
    for other in (0.0, 0.05, 0.1, 0.15):
        own = best.params.stage[0].parameters.model_copy(update={"eccentricity": other})
        stage = best.params.stage[0].model_copy(update={"parameters": own})
        chain = ChainParams(stage=(stage, *best.params.stage[1:]))
        assert rate_figures(chain, families)["2.output_speed_max"].value < value
    assert "chains within the bounds" in found.findings[0].message


def test_the_same_requirement_gives_the_same_chain_and_other_keys_stay() -> None:
    table = {"least": "2.output_acceleration_max", "free": [FREE, START], "tries": 7}
    one, two = (sought(asked(table), host()).result.candidates[0] for _ in range(2))
    assert one.params == two.params
    assert isinstance(one.params, ChainParams)
    gears = one.params.stage[0].parameters
    assert gears.teeth == 36  # type: ignore[attr-defined]
    assert one.params.stage[1].parameters == asked(table).family.base.stage[1].parameters


def test_limits_that_no_chain_keeps_are_told_with_the_nearest() -> None:
    limit = {"figure": "1.ratio_max", "least": 3.0}
    table = {"least": "2.output_speed_max", "free": [FREE], "limits": [limit], "tries": 6}
    result = sought(asked(table), host()).result
    assert not result.candidates
    (finding,) = result.findings
    assert finding.code == "chain.limits"
    assert 1.6 < finding.value <= 1.3 / 0.7 + 1e-9
    assert "stage.1.parameters.eccentricity = 0." in finding.message


def test_what_is_no_figure_is_told_with_those_that_are() -> None:
    result = sought(asked({"least": "2.speed", "free": [FREE], "tries": 6}), host()).result
    assert result.findings[0].code == "chain.no-figure"
    assert "2.output_speed_max" in result.findings[0].remedy


def test_chains_that_do_not_move() -> None:
    crank = {"key": "stage.2.parameters.crank", "low": 90.0, "high": 99.0}
    stages = [GEARS, {**ROCKER, "parameters": {**ROCKER["parameters"], "crank": 95}}]
    result = sought(
        asked({"least": "2.output_speed_max", "free": [crank], "tries": 6}, stages), host()
    ).result
    assert result.findings[0].code == "chain.no-motion"
    assert "stage" in result.findings[0].message


@pytest.mark.parametrize(
    ("key", "said"),
    [
        ("parameters.teeth", "is no key of a stage"),
        ("stage.3.parameters.teeth", "there are 2 stages"),
        ("stage.1.parameters.tooth", "has no parameters.tooth"),
        ("stage.1.parameters.material", "is no number"),
        ("stage.1.parameters.module", "is no number"),
        ("stage.1.family", "is no number"),
        ("stage.2.parameters", "is no number"),
    ],
)
def test_keys_that_are_no_numbers(key: str, said: str) -> None:
    free = {"key": key, "low": 0, "high": 1}
    with pytest.raises(DesignError, match=said):
        sought(asked({"least": "2.output_speed_max", "free": [free], "tries": 6}), host())


def test_tables_that_ask_for_nothing() -> None:
    with pytest.raises(ValidationError, match="above low"):
        FreeKey(key="stage.1.start", low=1, high=1)
    with pytest.raises(ValidationError, match="give least or most"):
        FigureLimit(figure="period")
    with pytest.raises(ValidationError):
        ChainRequirement(least="period", free=())
    with pytest.raises(DesignError, match=r"requirement"):
        asked({"least": "period", "free": [FREE], "kind": "most"})


def test_numbers_of_lists_and_whole_ones_are_set() -> None:
    gears = {"family": "noncircular-gears", "parameters": {"sines": [-12, 2], "teeth": 36, "bore": 6}}
    wave = {"key": "stage.1.parameters.sines.2", "low": -4.0, "high": 4.0}
    teeth = {"key": "stage.1.parameters.teeth", "low": 30.0, "high": 44.0}
    table = {"least": "1.centre_distance", "free": [wave, teeth], "tries": 9}
    (best,) = sought(asked(table, [gears, ROCKER]), host()).result.candidates
    assert isinstance(best.params, ChainParams)
    own = best.params.stage[0].parameters
    assert own.sines[0] == -12  # type: ignore[attr-defined]
    assert isinstance(own.teeth, int)  # type: ignore[attr-defined]
    assert own.teeth < 36  # type: ignore[attr-defined]
    assert math.isfinite(best.figures["1.centre_distance"].value)


def test_editors_know_the_file() -> None:
    schema = file_schema(host(), requirement=True)
    example = Path(__file__).parents[1] / "examples" / "chains" / "geneva-behind-gears-requirement.toml"
    content = tomllib.loads(example.read_text(encoding="utf-8"))
    validator = Draft202012Validator(schema)
    assert not list(validator.iter_errors(content))
    for wrong in (
        {**content, "requirement": {**content["requirement"], "leest": 1}},
        {**content, "stage": [{**content["stage"][0], "parameters": {"teth": 3}}, content["stage"][1]]},
        {key: value for key, value in content.items() if key != "stage"},
    ):
        assert list(validator.iter_errors(wrong))
