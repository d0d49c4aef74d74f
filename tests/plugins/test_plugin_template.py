"""The template as a third party would use it: installed, found by the host, tested by its own tests."""

import pytest
from by_night import in_ci
from templates import answer, copied, installed_into, passed, run

pytestmark = in_ci

ASK = """
import json
from mechwright.contracts.family import Family
from mechwright.plugins.host import load
host = load()
yoke = host.of(Family).get("scotch-yoke")
print(json.dumps({
    "distribution": yoke and yoke.distribution,
    "plugin": yoke and yoke.plugin,
    "parts": yoke and [part.name for part in yoke.item.parts(yoke.item.Params())],
    "broken": [str(broken) for broken in host.broken],
}))
"""


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    return copied("plugin-template", tmp_path_factory.mktemp("template"))


@pytest.fixture(scope="module")
def installed(copy, tmp_path_factory):
    return installed_into(tmp_path_factory.mktemp("installed"), copy)


def test_the_host_finds_the_installed_family(installed, tmp_path):
    told = answer(run(["-c", ASK], installed, cwd=tmp_path))
    assert told["distribution"] == "mechwright-scotch-yoke"
    assert told["plugin"] == "scotch-yoke"
    assert told["parts"] == ["crank", "yoke"]
    assert not [line for line in told["broken"] if "scotch" in line]


def test_without_the_installation_or_switched_off_it_is_not_there(installed, tmp_path):
    assert answer(run(["-c", ASK], cwd=tmp_path))["distribution"] is None
    off = run(["-c", ASK], installed, cwd=tmp_path, MECHWRIGHT_DISABLE_PLUGINS="scotch-yoke")
    assert answer(off)["distribution"] is None


def test_the_installation_holds_the_package_and_nothing_else(installed):
    top = {path.name for path in installed.iterdir()}
    assert {name for name in top if not name.endswith(".dist-info")} == {"mechwright_scotch_yoke"}
    assert (installed / "mechwright_scotch_yoke" / "py.typed").is_file()


def test_its_own_tests_pass(installed, copy):
    # The contract alone brings more than twenty tests; fewer would mean that it was not collected.
    assert passed(installed, copy) > 20
