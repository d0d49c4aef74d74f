"""The template of a page as a third party would use it: one file and a registration."""

import csv
import io
import json

import pytest
from by_night import NIGHT, by_night, in_ci
from templates import EXAMPLES, copied, installed_into, passed, run

pytestmark = in_ci

NAMES = {"saw-list.csv", "saw-list.html"}
DESIGN = EXAMPLES / "elliptic-pair.toml"


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    return copied("page-template", tmp_path_factory.mktemp("template"))


@pytest.fixture(scope="module")
def installed(copy, tmp_path_factory):
    return installed_into(tmp_path_factory.mktemp("installed"), copy)


MAKE = """
import sys
from mechwright.testing.commands import run
for command in sys.argv[2:]:
    done = run(command, sys.argv[1], "-o", command)
    assert done.returncode == 0, done.stderr
"""


def test_the_page_is_one_file_and_a_registration(copy):
    assert {path.name for path in (copy / "src").rglob("*.py")} == {"__init__.py", "page.py", "plugin.py"}


def test_the_listing_names_it(installed, tmp_path):
    command = ["-m", "mechwright", "families", "--json"]
    told = json.loads(run(command, installed, cwd=tmp_path).stdout)
    assert "saw-list" in told["pages"]
    assert told["broken"] == []
    assert "saw-list" not in json.loads(run(command, cwd=tmp_path).stdout)["pages"]


def test_model_and_build_write_it_and_cam_does_not(installed, tmp_path):
    # A build writes what the other two do.
    commands = ["model", "cam", *(["build"] if NIGHT else [])]
    done = run(["-c", MAKE, DESIGN, *commands], installed, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    model, cam, *built = (
        {path.name: path for path in (tmp_path / command).iterdir()} for command in commands
    )
    assert model.keys() >= NAMES
    for build in built:
        assert build.keys() >= NAMES
        assert [build[name].read_bytes() for name in NAMES] == [model[name].read_bytes() for name in NAMES]
    lines = list(csv.DictReader(io.StringIO(model["saw-list.csv"].read_text(encoding="utf-8"))))
    assert {f"{line['part']}.step" for line in lines} == {n for n in model if n.endswith(".step")} - {
        "assembly.step"
    }
    assert all(float(line["mass_g"]) > 0 for line in lines)
    manifest = json.loads(model["manifest.json"].read_text(encoding="utf-8"))
    assert set(manifest["outputs"]) >= NAMES
    assert not cam.keys() & NAMES


@by_night
def test_its_own_tests_pass(installed, copy):
    assert passed(installed, copy) == 4
