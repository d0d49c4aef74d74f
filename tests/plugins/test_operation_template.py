"""The template of an operation: its own tests pass, with nothing of it installed in the project."""

import os
import re
import subprocess
import sys
from pathlib import Path

from by_night import in_ci

pytestmark = in_ci

TEMPLATE = Path(__file__).parents[2] / "examples" / "operation-template"


def run(*arguments):
    path = os.pathsep.join([str(TEMPLATE / "src"), *filter(None, sys.path)])
    return subprocess.run(
        [sys.executable, *map(str, arguments)],
        cwd=TEMPLATE,
        env={
            **os.environ,
            "PYTHONPATH": path,
            "PYTHONDONTWRITEBYTECODE": "1",
        },
        capture_output=True,
        text=True,
        check=False,
    )


def test_its_own_tests_pass():
    config = ["-c", TEMPLATE / "pyproject.toml", "--rootdir", TEMPLATE, "-p", "no:cacheprovider", "-q"]
    done = run("-m", "pytest", *config, TEMPLATE / "tests")
    assert done.returncode == 0, done.stdout + done.stderr
    assert int(re.search(r"(\d+) passed", done.stdout)[1]) > 10


def test_it_is_one_file_and_a_registration():
    package = TEMPLATE / "src" / "mechwright_trochoidal"
    assert {path.name for path in package.glob("*.py")} == {"__init__.py", "plugin.py", "operation.py"}
