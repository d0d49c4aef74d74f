"""The numbers of the independent check of synthesis, by name."""

import json
from pathlib import Path
from typing import Any

FACTS: list[dict[str, Any]] = json.loads(
    (Path(__file__).parents[1] / "data" / "synthesis.json").read_text(encoding="utf-8")
)["facts"]


def facts(start: str) -> list[dict[str, Any]]:
    """All whose names start so, in their order."""
    return [fact for fact in FACTS if fact["name"].startswith(start)]


def fact(name: str) -> dict[str, Any]:
    """The one of this name."""
    (found,) = [one for one in FACTS if one["name"] == name]
    return found
