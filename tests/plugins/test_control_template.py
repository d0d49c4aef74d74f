"""The template of a control as a third party would use it: one file and a registration."""

import re

import pytest
from by_night import by_night, in_ci
from templates import EXAMPLES, answer, copied, installed_into, passed, run

pytestmark = in_ci

ASK = """
import json
from mechwright.plugins.host import load
from mechwright_cam.controls.contract import Control
host = load()
larch = host.of(Control).get("larch")
print(json.dumps({
    "distribution": larch and larch.distribution,
    "title": larch and larch.item.title,
    "broken": [str(broken) for broken in host.broken],
}))
"""
MAKE = """
from mechwright.testing.commands import run
made = run("cam", "design.toml", "-o", "out")
assert made.returncode == 0, made.stderr
verify = ["verify", "out/rod.nc", "--design", "design.toml", "--part", "rod"]
assert run(*verify).returncode == 0
foreign = run(*verify, "--control", "fanuc")
assert foreign.returncode != 0
print(foreign.stderr)
"""
DESIGN = (EXAMPLES / "slider-crank-quick-return.toml").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    return copied("control-template", tmp_path_factory.mktemp("template"))


@pytest.fixture(scope="module")
def installed(copy, tmp_path_factory):
    return installed_into(tmp_path_factory.mktemp("installed"), copy)


def test_the_host_finds_the_installed_control(installed, tmp_path):
    told = answer(run(["-c", ASK], installed, cwd=tmp_path))
    assert (told["distribution"], told["title"]) == ("mechwright-larch", "Larch 300")
    assert not [line for line in told["broken"] if "larch" in line]
    assert answer(run(["-c", ASK], cwd=tmp_path))["distribution"] is None


def test_the_control_is_one_file_and_a_registration(copy):
    assert {path.name for path in (copy / "src").rglob("*.py")} == {"__init__.py", "control.py", "plugin.py"}


@by_night
def test_its_own_tests_pass(installed, copy):
    # The contract alone brings more than twenty tests; fewer would mean that it was not collected.
    assert passed(installed, copy) > 25


def test_a_design_file_names_it_and_program_offsets_and_sheets_are_its_own(installed, tmp_path):
    design = DESIGN.replace('control = "linuxcnc"', 'control = "larch"\ncompensation = "control"')
    (tmp_path / "design.toml").write_text(design, encoding="utf-8")
    done = run(["-c", MAKE], installed, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    text, sheet, table = (
        (tmp_path / "out" / name).read_text(encoding="utf-8")
        for name in ("rod.nc", "rod.setup.html", "larch.ofs")
    )
    (number, radius) = re.search(r"\(D(\d+) HOLDS THE RADIUS OF T\d+: ([\d.]+) ", text).groups()
    assert f"<b>D{number}</b> = {float(radius):.3f}, the radius" in sheet
    assert "has to take D as a" not in sheet
    assert f"D{int(number):03d} {float(radius):.3f}\n" in table
    assert "M108" in text
    assert "M108 is no code that is read in programs for Fanuc" in done.stdout
