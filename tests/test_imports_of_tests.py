"""The README's second command installs what its tests import: no test leans on a package that another one brought."""

import ast
import re
import sys
import tomllib
from collections.abc import Iterator, Mapping
from importlib.metadata import packages_distributions

from imported import ROOT

OF_TESTS = ROOT / "tests"

PART_OF_ANOTHER = {"OCP": "cadquery", "linuxcnc": "the control itself"}
"""Packages that are not to be had without the one that is asked for: the kernel, and the module of a control."""


def _told(requirement: str) -> str:
    """The name of a requirement as package indexes compare it."""
    return re.sub(r"[-_.]+", "-", re.match(r"[\w.-]+", requirement)[0]).lower()


def _installed_by_the_readme() -> set[str]:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    return {_told(one) for one in (*project["dependencies"], *project["optional-dependencies"]["test"])}


def _always_imported(tree: ast.Module) -> Iterator[str]:
    """The packages that a file imports as soon as it is collected; those within functions may be asked for first."""
    guarded = "importorskip" in ast.unparse(tree)
    for node in tree.body:
        if isinstance(node, ast.Import):
            yield from (name.name.split(".")[0] for name in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module.split(".")[0]
        elif isinstance(node, ast.Assign) and guarded:
            return  # what follows an importorskip is collected only where it is at hand


def strangers(sources: Mapping[str, str], owned: set[str]) -> dict[str, set[str]]:
    """The packages of each source that are neither Python's, the project's, its tests' nor among those owned."""
    homes = packages_distributions()
    rooms = [ROOT / folder for folder in ("tests", "benchmarks", "docs", "examples")]
    local = {path.stem for room in rooms for path in room.rglob("*") if path.is_dir() or path.suffix == ".py"}
    found = {}
    for name, text in sources.items():
        wanted = {
            package
            for package in _always_imported(ast.parse(text))
            if package not in sys.stdlib_module_names and package not in local | PART_OF_ANOTHER.keys()
            if not package.startswith("mechwright")
            if not {_told(home) for home in homes.get(package, [package])} & owned
        }
        if wanted:
            found[name] = wanted
    return found


def test_every_package_that_tests_import_is_installed_with_them():
    sources = {str(path.relative_to(ROOT)): path.read_text("utf-8") for path in OF_TESTS.rglob("*.py")}
    assert len(sources) > 300
    assert strangers(sources, _installed_by_the_readme()) == {}


def test_a_package_that_came_with_another_is_found():
    owned = _installed_by_the_readme()
    assert strangers({"one": "from referencing import Registry\nimport numpy, json"}, owned) == {
        "one": {"referencing"}
    }
    later = "import pytest\nsync = pytest.importorskip('playwright')\nimport playwright"
    assert strangers({"two": later}, owned) == {}
