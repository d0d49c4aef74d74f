"""The faults that are planted in source code: each changes just what it says, and the tests that see it are known."""

import ast
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
    at_once, later = mutants("core/x.py", TEXT)[0], mutants("core/x.py", TEXT)[-1]
    known = Known(
        {
            "core/x.py:Plate.fits": {"slow": 9.0, "quick": 1.0, "middle": 3.0},
            "core/x.py:other": {"other": 2.0},
            "core/y.py:Plate.fits": {"elsewhere": 0.1},
        }
    )
    assert list(known.of(later, 5.0)) == ["quick", "middle"]
    assert list(known.of(later, 0.1)) == ["quick"]  # at least one
    assert list(known.of(at_once, 5.9)) == ["quick", "other"]


@pytest.mark.parametrize("room", ["core", "cam", "plugins"])
def test_every_file_has_an_area_with_a_goal(room: str) -> None:
    names = {area(path.relative_to(ROOT).as_posix()) for path in (ROOT / room).rglob("*.py")}
    assert names <= set(AREAS) == set(GOALS)
