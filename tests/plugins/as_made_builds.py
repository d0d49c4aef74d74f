"""Builds of designs for tests: what their programs leave, and what the family says of it."""

import json
from functools import cache
from pathlib import Path
from typing import Any

from mechwright.contracts.as_made import AsMade
from mechwright.contracts.made_part import MadePart
from mechwright.pipeline import Build
from mechwright.plugins.host import host
from mechwright_cam.as_made import AsMadeParts

ROOT = Path(__file__).parents[2]
FACTS: list[dict[str, Any]] = json.loads((ROOT / "tests" / "data" / "as-made.json").read_text())["facts"]


def facts(start: str) -> list[dict[str, Any]]:
    """The reference values whose names begin so."""
    return [fact for fact in FACTS if fact["name"].startswith(start)]


def table(family: str, **parameters: Any) -> str:
    """A design file."""
    rows = [f"{name} = {json.dumps(value)}" for name, value in parameters.items()]
    return "\n".join(["format = 1", f'family = "{family}"', "[parameters]", *rows, ""])


@cache
def built(path: Path) -> tuple[list[MadePart], AsMade, Any]:
    """Parts as made, what the family says of them, and the parameters."""
    with Build(path, host()) as build:
        made = build.made(AsMadeParts)
        return made.parts, made.analysis, build.design.params


def example(name: str) -> tuple[list[MadePart], AsMade, Any]:
    """The same for a design among the examples."""
    return built(ROOT / "examples" / f"{name}.toml")
