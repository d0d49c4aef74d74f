"""The template as a third party would use it: installed, found by the host, tested by its own tests."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import mechwright

TEMPLATE = Path(__file__).parents[2] / "examples" / "plugin-template"

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
    """A copy of the template, so that building and testing it leaves no trace in the project."""
    folder = tmp_path_factory.mktemp("template") / "plugin-template"
    ignored = shutil.ignore_patterns("__pycache__", ".*", "dist", "build", "*.egg-info")
    return shutil.copytree(TEMPLATE, folder, ignore=ignored)


@pytest.fixture(scope="module")
def installed(copy, tmp_path_factory):
    """The folder that the template is installed into, from its source and without any index."""
    target = tmp_path_factory.mktemp("installed")
    offline = ["--no-index", "--no-deps", "--no-build-isolation", "--disable-pip-version-check"]
    done = subprocess.run(
        [sys.executable, "-m", "pip", "install", "--quiet", *offline, "--target", target, copy],
        env={**os.environ, "PIP_CONFIG_FILE": os.devnull},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return target


def run(arguments, *paths, cwd, **environment):
    """Run Python in a process of its own with these folders and our own sources on its path."""
    home = Path(mechwright.__file__).parents[1]
    path = os.pathsep.join(map(str, (*paths, home, os.environ.get("PYTHONPATH", ""))))
    return subprocess.run(
        [sys.executable, *map(str, arguments)],
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": path.rstrip(os.pathsep), **environment},
        capture_output=True,
        text=True,
        check=False,
    )


def answer(done):
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


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
    config = ["-c", copy / "pyproject.toml", "--rootdir", copy, "-p", "no:cacheprovider", "-q"]
    done = run(["-m", "pytest", *config, copy / "tests"], installed, cwd=copy)
    assert done.returncode == 0, done.stdout + done.stderr
    passed = re.search(r"(\d+) passed", done.stdout)
    # The contract alone brings more than twenty tests; fewer would mean that it was not collected.
    assert passed
    assert int(passed[1]) > 20, done.stdout


def test_its_types_are_right(installed, copy):
    pytest.importorskip("mypy", reason="mypy is not installed")
    # From the copy, so that the settings of this project do not decide.
    done = run(["-m", "mypy", "--strict", "--cache-dir", os.devnull, copy / "src"], installed, cwd=copy)
    assert done.returncode == 0, done.stdout + done.stderr
