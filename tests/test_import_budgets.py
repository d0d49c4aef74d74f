"""What each command imports: modules are counted, for seconds depend on the machine."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from by_night import in_ci

from mechwright.systems import usable_cores

EXAMPLES = Path(__file__).parents[1] / "examples"
PAIR, MACHINE = "elliptic-pair.toml", "four-bar-machine.toml"
NUMBERS = {"numpy", "pydantic", "typer"}
SHAPES = NUMBERS | {"shapely"}
HEAVY = SHAPES | {"cadquery", "ezdxf", "jinja2", "numba", "scipy", "vtkmodules"}
BUDGETS = [
    ("--help", "", 300, {"typer"}),
    ("families", "", 1070, NUMBERS),
    ("check", PAIR, 1520, SHAPES | {"jinja2"}),
    pytest.param("solve", PAIR, 1710, SHAPES | {"jinja2", "scipy"}, marks=in_ci),
    pytest.param("cam", PAIR, 1810, SHAPES | {"jinja2", "ezdxf"}, marks=in_ci),
    pytest.param("check", MACHINE, 2040, SHAPES | {"jinja2", "scipy", "numba"}, marks=in_ci),
    pytest.param("build", PAIR, 2490, HEAVY - {"cadquery", "vtkmodules"}, marks=in_ci),
]
"""Command, design, most modules in its first process, and which large libraries may be among them."""


@pytest.mark.parametrize(("command", "design", "most", "allowed"), BUDGETS)
def test_a_command_imports_what_it_needs(command, design, most, allowed, tmp_path):
    if command == "build" and usable_cores() < 2:
        pytest.skip("with one core there is no second process for the solids")
    words = [command] if not design else [command, str(EXAMPLES / design)]
    words += ["-o", str(tmp_path / "out")] if command in ("solve", "cam", "build") else []
    code = (
        f"import json, sys\nfrom mechwright.cli import main\nsys.argv = ['mechwright', *{words!r}]\n"
        "try: main()\nexcept SystemExit as stop: assert not stop.code\n"
        "print('MODULES', json.dumps(list(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    modules = json.loads(done.stdout.rpartition("MODULES ")[2])
    assert {name.partition(".")[0] for name in modules} & HEAVY <= allowed
    assert most / 1.25 < len(modules) <= most
