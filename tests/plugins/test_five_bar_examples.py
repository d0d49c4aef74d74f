"""The examples of the five-bar: what they reach, and that they can be found and built."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night
from five_bar_reference import NEAR, POINTS, TURNS
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright.contracts.finding import Severity, errors
from mechwright.designs.design import load
from mechwright.designs.requirement import load_requirement
from mechwright.plugins.host import host
from mechwright_five_bar.family import FiveBars
from mechwright_five_bar.kinematics.dimensions import bar_of
from mechwright_five_bar.kinematics.phases import in_phase
from mechwright_spherical.defaults import published_example

EXAMPLES = Path(__file__).parents[2] / "examples"
DESIGNS = ("five-bar-published", "five-bar-slots", "five-bar-three-phases")


def points_of(params, angles):
    """Places of the coupler point, mm, at crank angles from X, rad."""
    shown = in_phase(params)
    moved = bar_of(shown).at(angles).bodies["coupler"].point(shown.coupler_point).position
    return moved + complex(params.pivot_x, params.pivot_y)


def test_the_published_five_bar_passes_the_printed_points():
    params = load(EXAMPLES / "five-bar-published.toml", host()).params
    found = []
    for phase, turns in ((1, published_example.ANGLES), (2, published_example.ANGLES_N)):
        of_phase = params.model_copy(update={"phase": phase})
        start = in_phase(of_phase).setting_angle
        found += list(points_of(of_phase, np.radians(start + np.array(turns))))
    wanted = [complex(x, y) for x, y in published_example.TABLE_2]
    np.testing.assert_allclose(np.array(found) / 100, wanted, rtol=0, atol=1.2e-4)


@pytest.mark.parametrize(("name", "turns"), [("five-bar-three-phases", TURNS), ("five-bar-slots", NEAR)])
def test_the_examples_are_the_reference(name, turns):
    params = load(EXAMPLES / f"{name}.toml", host()).params
    assert [row.crank_turn for row in params.phases] == [row["crank_turn"] for row in turns]
    start = np.radians(POINTS["inputs"]["crank_deg"][0])
    wanted = [complex(*point) for point in POINTS["expected"][0]]
    np.testing.assert_allclose(points_of(params.model_copy(update={"phase": 1}), start), wanted, atol=1e-9)


@pytest.mark.parametrize("name", DESIGNS)
def test_every_phase_of_an_example_can_be_built(name):
    params = load(EXAMPLES / f"{name}.toml", host()).params
    for phase in range(1, 2 + len(params.phases)):
        assert not errors(FiveBars().check(params.model_copy(update={"phase": phase})))


def test_five_bars_are_found_from_points_of_three_phases():
    """Each phase's design passes that phase's points in order, at the crank angles that are told."""
    asked = load_requirement(EXAMPLES / "five-bar-phases-requirement.toml", host())
    few = asked.table.model_copy(update={"starts": 300, "designs": 1})
    result = asked.family.synthesise(asked.kind, few, lambda part, text: None)
    assert [one.severity for one in result.findings] == [Severity.NOTE]
    assert len(result.candidates) == 3
    for number, one in enumerate(result.candidates):
        assert one.params.phase == number + 1
        count = len(few.phases[number])
        angles = np.array([one.figures[f"crank_angle_{k + 1}"].value for k in range(count)])
        steps = np.diff(angles)
        assert (steps > 0).all() or (steps < 0).all()
        assert abs(angles[-1] - angles[0]) < math.tau
        missed = np.abs(points_of(one.params, angles) - [complex(*point) for point in few.phases[number]])
        told = [one.figures[f"error_{k + 1}"].value for k in range(count)]
        assert missed == pytest.approx(told, abs=1e-6)
        assert missed.max() < 0.5
        ends = sorted((in_phase(one.params).swing_from, in_phase(one.params).swing_to))
        assert np.degrees(sorted((angles[0], angles[-1]))) == pytest.approx(ends, abs=1e-6)


@by_night
@pytest.mark.parametrize("name", [*DESIGNS, "four-bar-slots"])
def test_the_examples_build_without_a_warning(name, tmp_path):
    """Every plate proven, no two bodies in one another over the motion, bought parts in the bill."""
    done = CliRunner().invoke(
        make_app(), ["build", str(EXAMPLES / f"{name}.toml"), "-o", str(tmp_path / "out")]
    )
    assert done.exit_code == 0, done.output
    assert "warning" not in done.output
    out = tmp_path / "out"
    proof = json.loads((out / "proof.json").read_text(encoding="utf-8"))
    assert proof
    plates = {path.name.split(".")[0] for path in out.glob("*.setup.html")}
    assert {"ground", "crank", "coupler"} <= plates
    if "slots" in name:
        bill = (out / "bill-of-materials.csv").read_text(encoding="utf-8")
        assert "ISO 4762" in bill
        assert "ISO 7089" in bill


@by_night
def test_a_machine_that_was_found_from_points_is_built_in_each_phase(tmp_path):
    """Three phases from points, each written as a design file and built."""
    asked = str(EXAMPLES / "five-bar-phases-requirement.toml")
    done = CliRunner().invoke(make_app(), ["synthesize", asked, "-o", str(tmp_path / "found")])
    assert done.exit_code == 0, done.output
    designs = sorted((tmp_path / "found").glob("*.toml"))
    assert len(designs) >= 3
    for number, design in enumerate(designs[:3]):
        done = CliRunner().invoke(make_app(), ["build", str(design), "-o", str(tmp_path / f"out{number}")])
        assert done.exit_code == 0, done.output
