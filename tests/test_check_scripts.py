"""Checks by a script: the findings of the command, of a file, a family or a mechanism."""

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

import mechwright as mw
from mechwright.cli.app import make_app
from mechwright.designs.text import toml

EXAMPLES = Path(__file__).parents[1] / "examples"
BUILDS = ("inch-bracket", "four-bar-double-rocker", "geneva-cycloidal", "chains/figure-eight-chain")
REFUSED: tuple[tuple[str, dict[str, Any]], ...] = (
    ("elliptic-gears", {"teeth": 13}),
    ("five-bar", {"bushing_wall": 0.03, "running_fit": 0.1}),
    ("slider-crank", {"crank": 60, "rod": 150, "slider_width": 5}),
    ("geneva", {"cam.machine.travel_x": 20}),
    ("noncircular-gears", {"law": "ratio", "ratio": "1 + 0.2*cos(phi)", "sector": 77.0, "keyway_width": 22}),
)


def by_command(path: Path, *more: str) -> tuple[bool, list[dict[str, Any]]]:
    done = CliRunner().invoke(make_app(), ["check", str(path), "--json", *more])
    said = json.loads(done.stdout)
    return said["ok"], said["findings"]


def plain(findings: mw.Findings) -> list[dict[str, Any]]:
    return json.loads(json.dumps([one.as_dict() for one in findings]))


@pytest.mark.parametrize("name", BUILDS)
def test_a_file_has_the_findings_of_the_command(name: str) -> None:
    path = EXAMPLES / f"{name}.toml"
    steps: list[float] = []
    found = mw.check(str(path), progress=lambda done, _: steps.append(done))
    assert (not found.errors, plain(found)) == by_command(path)
    assert not found.errors
    assert steps


def test_a_stage_is_that_of_the_command() -> None:
    path = EXAMPLES / "four-bar-double-rocker.toml"
    found = mw.check(path, to="motion")
    assert (not found.errors, plain(found)) == by_command(path, "--to", "motion")


@pytest.mark.parametrize(("family", "table"), REFUSED, ids=[family for family, _ in REFUSED])
def test_a_refused_design_has_the_findings_of_the_command(
    tmp_path: Path, family: str, table: dict[str, Any]
) -> None:
    path = tmp_path / "refused.toml"
    keys = {key if "." in key else f"parameters.{key}": toml(value) for key, value in table.items()}
    path.write_text("\n".join(f"{key} = {value}" for key, value in {"family": toml(family), **keys}.items()))
    builds, findings = by_command(path)
    assert not builds
    found = mw.check(path)
    assert found.errors
    assert plain(found) == findings
    assert plain(mw.check(family, **table)) == findings
    assert plain(mw.check(mw.design(family), **table)) == findings


def test_a_parameter_is_changed_and_the_mechanism_stays_as_it_is() -> None:
    path = EXAMPLES / "four-bar-double-rocker.toml"
    given = mw.load(path)
    found = mw.check(given, rim=0.5)
    assert plain(found) == plain(mw.check(path, rim=0.5)) == plain(given.with_(rim=0.5).check())
    assert plain(mw.check(given)) == plain(given.check()) != plain(found)


@pytest.mark.parametrize(
    ("subject", "parameters", "error", "said"),
    [
        ("slider-crank", {"rot": 80}, mw.DesignError, "unknown key 'rot'; did you mean 'rod'?"),
        ("slider-krank", {}, mw.PluginError, "slider-krank"),
        ("none.toml", {}, mw.OutputError, "none.toml: cannot be read"),
    ],
)
def test_what_cannot_be_checked_is_raised(
    subject: str, parameters: dict[str, Any], error: type[Exception], said: str
) -> None:
    with pytest.raises(error) as raised:
        mw.check(subject, **parameters)
    assert said in str(raised.value)
