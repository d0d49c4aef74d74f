"""The types of every template, checked as its author would, without the settings of this project."""

import os

import pytest
from by_night import in_ci
from templates import EXAMPLES, copied, run

pytestmark = in_ci
TEMPLATES = sorted(path.name for path in EXAMPLES.glob("*-template"))


def test_the_types_of_all_templates_are_right(tmp_path):
    pytest.importorskip("mypy", reason="mypy is not installed")
    assert len(TEMPLATES) > 3
    # In one run: most of its time goes to the types of the packages that they all import.
    sources = [copied(name, tmp_path) / "src" for name in TEMPLATES]
    settings = sources[TEMPLATES.index("operation-template")].parent / "pyproject.toml"
    ask = ["-m", "mypy", "--strict", "--config-file", settings, "--cache-dir", os.devnull]
    done = run([*ask, *sources], *sources, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    packages = [package for source in sources for package in source.glob("mechwright_*")]
    assert f"in {sum(1 for p in packages for _ in p.rglob('*.py'))} source files" in done.stdout
