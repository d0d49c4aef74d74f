"""The template of a page as a third party would use it: one file and a registration."""

import csv
import io
import json

import pytest
from templates import EXAMPLES, copied, installed_into, passed, run

NAMES = {"bill-of-materials.csv", "bill-of-materials.html"}
DESIGN = EXAMPLES / "elliptic-pair.toml"


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    return copied("page-template", tmp_path_factory.mktemp("template"))


@pytest.fixture(scope="module")
def installed(copy, tmp_path_factory):
    return installed_into(tmp_path_factory.mktemp("installed"), copy)


def made(command, cwd, *installed):
    done = run(["-m", "mechwright", command, DESIGN, "-o", command], *installed, cwd=cwd)
    assert done.returncode == 0, done.stderr
    return {path.name: path for path in (cwd / command).iterdir()}


def test_the_page_is_one_file_and_a_registration(copy):
    assert {path.name for path in (copy / "src").rglob("*.py")} == {"__init__.py", "page.py", "plugin.py"}


def test_the_listing_names_it(installed, tmp_path):
    done = run(["-m", "mechwright", "families", "--json"], installed, cwd=tmp_path)
    told = json.loads(done.stdout)
    assert "bill-of-materials" in told["pages"]
    assert told["broken"] == []


def test_model_and_build_write_it_and_cam_does_not(installed, tmp_path):
    model, build = made("model", tmp_path, installed), made("build", tmp_path, installed)
    assert model.keys() >= NAMES <= build.keys()
    assert [build[name].read_bytes() for name in NAMES] == [model[name].read_bytes() for name in NAMES]
    lines = list(csv.DictReader(io.StringIO(model["bill-of-materials.csv"].read_text(encoding="utf-8"))))
    assert {f"{line['part']}.step" for line in lines} == {n for n in model if n.endswith(".step")} - {
        "assembly.step"
    }
    assert all(float(line["mass_g"]) > 0 for line in lines)
    manifest = json.loads(model["manifest.json"].read_text(encoding="utf-8"))
    assert set(manifest["outputs"]) >= NAMES
    assert not made("cam", tmp_path, installed).keys() & NAMES
    assert not made("model", tmp_path).keys() & NAMES, "it is not installed"


def test_its_own_tests_pass(installed, copy):
    assert passed(installed, copy) == 4
