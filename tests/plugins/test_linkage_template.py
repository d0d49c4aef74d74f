"""The template of a linkage as a third party would use it: a family in two files."""

import json

import pytest
from by_night import by_night, in_ci
from templates import copied, installed_into, passed, run

pytestmark = in_ci

LINES = 120
"""Most of the template, without its tests."""


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    return copied("linkage-template", tmp_path_factory.mktemp("template"))


@pytest.fixture(scope="module")
def installed(copy, tmp_path_factory):
    return installed_into(tmp_path_factory.mktemp("installed"), copy)


MAKE = """
from mechwright.testing.commands import run
for command in ("new dwell-press -o dwell-press.toml", "check dwell-press.toml", "solve dwell-press.toml -o out"):
    done = run(*command.split())
    assert done.returncode == 0, done.stderr
"""


def test_the_linkage_is_short(copy):
    modules = {path.name: path.read_text(encoding="utf-8") for path in (copy / "src").rglob("*.py")}
    assert modules.keys() == {"__init__.py", "family.py", "plugin.py"}
    assert sum(len(text.splitlines()) for text in modules.values()) <= LINES


def test_the_listing_names_family_and_page(installed, tmp_path):
    command = ["-m", "mechwright", "families", "--json"]
    found = json.loads(run(command, installed, cwd=tmp_path).stdout)
    assert "dwell-press-poles" in found["pages"]
    assert found["broken"] == []
    assert "dwell-press-poles" not in json.loads(run(command, cwd=tmp_path).stdout)["pages"]


def test_a_new_design_is_checked_and_solved(installed, tmp_path):
    done = run(["-c", MAKE], installed, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    text = (tmp_path / "dwell-press.toml").read_text(encoding="utf-8")
    assert "[parameters.dwell_press]" in text
    assert "jansen" not in text
    figures = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    assert "output_stroke" in json.dumps(figures)


@by_night
def test_its_own_tests_pass(installed, copy):
    assert passed(installed, copy) > 40
