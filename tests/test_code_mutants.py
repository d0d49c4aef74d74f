"""The faults that are planted in source code: each changes just what it says, and the tests that see it are known."""

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))

from bench_mutation import AREAS, GOALS, Known, area
from code_mutants import OPERATORS, executed_names, mutants

ROOT = Path(__file__).parents[1]
TEXT = '''"""A docstring with 1 + 1."""

LIMIT: "int | None" = 3  # µm, before what is changed on the line: "é" and 2


class Plate:
    size: float = 0.5

    def fits(self, hole: float, many=2) -> bool:
        """No 7 > 6 in here."""
        if not hole or -hole < self.size <= 2 * many:
            raise ValueError(f"{hole + 1} is wrong")
        total = 0
        for one in [1, 2]:
            if one == 2:
                continue
            total += one
            print("é", total - 1)
        return [k + 1 for k in range(total)] is not None
'''


def test_each_mutant_changes_its_place_and_nothing_else() -> None:
    found = mutants("core/x.py", TEXT)
    assert {one.operator for one in found} == set(OPERATORS)
    assert len({one.key for one in found}) == len(found) > 20
    for one in found:
        changed = one.applied(TEXT)
        assert ast.dump(ast.parse(changed)) != ast.dump(ast.parse(TEXT)), one.key
        here = changed.splitlines()
        there = TEXT.splitlines()
        assert len(here) == len(there)
        assert [n for n in range(len(here)) if here[n] != there[n]] == [one.line - 1]
        assert one.old in there[one.line - 1]
        assert one.new in here[one.line - 1]


def test_what_is_said_and_what_is_typed_is_left_alone() -> None:
    keys = "\n".join(one.key for one in mutants("core/x.py", TEXT))
    for text in ("hole + 1", "7 > 6", "int | None", "1 + 1"):
        assert f"'{text}' -> " not in keys
    for text in (
        "'not hole' -> '(hole)'",
        "'-hole' -> '(hole)'",
        "'0.5' -> '1.0'",
        "'2' -> '3'",
        "'continue' -> 'pass'",
    ):
        assert text in keys


def test_functions_have_the_names_that_code_objects_have() -> None:
    place: dict[str, object] = {}
    exec(compile(TEXT, "x", "exec"), place)  # noqa: S102 - the text above
    plate = place["Plate"]
    assert {one.function for one in mutants("core/x.py", TEXT)} == {"", plate.fits.__qualname__}  # type: ignore[attr-defined]
    assert executed_names("Plate.fits.<locals>.<listcomp>") == "Plate.fits"


def test_tests_of_a_mutant_are_the_quickest_of_its_function() -> None:
    later = mutants("core/x.py", TEXT)[-1]
    seconds = {"slow": 9.0, "quick": 1.0, "middle": 3.0, "other": 2.0, "elsewhere": 0.1}
    here, beside = frozenset({"slow", "quick", "middle"}), frozenset({"other"})
    known = Known(
        seconds,
        {
            "core/x.py": {later.line: here, later.line + 1: beside},
            "core/y.py": {later.line: frozenset({"elsewhere"})},
        },
    )
    assert list(known.of(later, 5.0)) == ["quick", "middle"]
    assert list(known.of(later, 0.1)) == ["quick"]  # at least one
    assert known.of(mutants("core/x.py", TEXT)[0], 5.0) == {}


BITES = """
import doubled
def test_value():
    assert doubled.Twice().of(3) == 6
def test_sign():
    assert doubled.Twice().of(-1) < 0
"""


def test_a_mutant_is_planted_in_a_fork_and_seen_by_the_tests_that_reach_it(tmp_path: Path) -> None:
    """In a process of its own, which has a suite and forks."""
    (tmp_path / "core").mkdir()
    (tmp_path / "core" / "doubled.py").write_text(
        "class Twice:\n    def of(self, one):\n        if one == 5:\n            return 0\n        return 2 * one\n"
    )
    (tmp_path / "test_doubled.py").write_text(BITES)
    (tmp_path / "pyproject.toml").write_text("[tool.pytest.ini_options]\npythonpath = ['core']\n")
    script = """
import sys
from pathlib import Path
import mutation_tests as runs
runs.ROOT = Path.cwd()
from code_mutants import mutants
suite = runs.Suite(["test_doubled.py"], Path("temporary").resolve())
text = Path("core/doubled.py").read_text()
for one in mutants("core/doubled.py", text):
    def work():
        if not suite.planted(one, text):
            return 3
        return int(not suite.run(suite.items))
    print(one.operator, one.line, runs.forked(work, 60), file=sys.stderr)
watch = runs.Reaching(("core/",))
suite.config.pluginmanager.register(watch)
suite.run(suite.items)
print({name: lines for name, (_, lines) in watch.found.items()}, file=sys.stderr)
"""
    done = subprocess.run(
        [sys.executable, "-c", script],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT / "benchmarks")},
        capture_output=True,
        text=True,
        check=True,
    )
    *told, reached = done.stderr.splitlines()
    assert {tuple(line.split()) for line in told} == {
        ("comparison", "3", "1"),  # one != 5
        ("constant", "3", "0"),  # no test has 5 or 6
        ("constant", "4", "0"),
        ("return", "5", "1"),
        ("arithmetic", "5", "1"),
        ("constant", "5", "1"),
    }
    here = {"core/doubled.py": [2, 3, 5]}
    assert reached == str({"test_doubled.py::test_value": here, "test_doubled.py::test_sign": here})


@pytest.mark.parametrize("room", ["core", "cam", "plugins"])
def test_every_file_has_an_area_with_a_goal(room: str) -> None:
    names = {area(path.relative_to(ROOT).as_posix()) for path in (ROOT / room).rglob("*.py")}
    assert names <= set(AREAS) == set(GOALS)
