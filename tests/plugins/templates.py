"""A template as a third party would use it: copied, installed from its source, run in a process of its own."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import mechwright

EXAMPLES = Path(__file__).parents[2] / "examples"


def copied(template, folder):
    """A copy of a template, so that building and testing it leaves no trace in the project."""
    ignored = shutil.ignore_patterns("__pycache__", ".*", "dist", "build", "*.egg-info")
    return shutil.copytree(EXAMPLES / template, folder / template, ignore=ignored)


def installed_into(target, source):
    """The folder that a source is installed into, without any index."""
    offline = ["--no-index", "--no-deps", "--no-build-isolation", "--disable-pip-version-check"]
    done = subprocess.run(
        [sys.executable, "-m", "pip", "install", "--quiet", *offline, "--target", target, source],
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


def passed(installed, copy):
    """How many of a template's own tests pass; none may fail."""
    config = ["-c", copy / "pyproject.toml", "--rootdir", copy, "-p", "no:cacheprovider", "-q"]
    done = run(["-m", "pytest", *config, copy / "tests"], installed, cwd=copy)
    assert done.returncode == 0, done.stdout + done.stderr
    return int(re.search(r"(\d+) passed", done.stdout)[1])
