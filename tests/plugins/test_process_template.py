"""The template of a process as a third party would use it: at most 300 lines, installed and chosen by a design."""

import json

import pytest
from by_night import by_night, in_ci
from templates import EXAMPLES, answer, copied, installed_into, passed, run

pytestmark = in_ci

MOST = 300
"""Lines of all files of the template."""
CARD = """format = 1
family = "slider-crank"
name = "card"
process = "drag-knife"

[parameters]
crank = 30
rod = 90
speed = 10
thickness = 1
material = "hdpe"
"""


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    return copied("process-template", tmp_path_factory.mktemp("template"))


@pytest.fixture(scope="module")
def installed(copy, tmp_path_factory):
    return installed_into(tmp_path_factory.mktemp("installed"), copy)


def test_it_has_at_most_300_lines():
    folder = EXAMPLES / "process-template"
    files = [path for path in folder.rglob("*") if path.suffix in {".py", ".toml", ".md"}]
    assert sum(len(path.read_text(encoding="utf-8").splitlines()) for path in files) <= MOST


def test_check_lists_it_beside_the_others(installed, tmp_path):
    (tmp_path / "card.toml").write_text(CARD)
    done = run(
        ["-m", "mechwright", "check", "card.toml", "--json", "--to", "machining"], installed, cwd=tmp_path
    )
    rows = [one for one in json.loads(done.stdout)["processes"] if one["process"] == "drag-knife"]
    assert rows
    assert all(one["chosen"] and one["able"] for one in rows)
    bare = answer(run(["-m", "mechwright", "families", "--json"], cwd=tmp_path))
    assert "drag-knife" not in bare["processes"]


@by_night
def test_its_own_tests_pass(installed, copy):
    assert passed(installed, copy) == 8
