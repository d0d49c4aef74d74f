"""What is said of changes: which key is set to what, and what it is now."""

from typing import Any

from mechwright.contracts.finding import Change
from mechwright.designs.change import found_at
from mechwright.designs.text import toml
from mechwright.remedies.bench import Bench


def said(bench: Bench, change: Change) -> str:
    """A change in one line, such as ``set ground = 11 (now 9)``."""
    lines = each(bench, change)
    return ", ".join([lines[0], *(line.removeprefix("set ") for line in lines[1:])]) if lines else ""


def each(bench: Bench, change: Change) -> list[str]:
    """A line for each key of a change."""
    return [_one(bench, path, value) for path, value in change.items()]


def _one(bench: Bench, path: str, value: Any) -> str:
    name = path.removeprefix("parameters.")
    now = _now(bench, path)
    return f"leave out {name} ({now})" if value is None else f"set {name} = {toml(value)} ({now})"


def _now(bench: Bench, path: str) -> str:
    """What the file says of a key, in its own words."""
    stands, value = found_at(bench.design.content, path)
    if stands:
        return f"now {toml(value)}"
    key = bench.keys.get(path)
    if key is None or key.default is None:
        return "now left out"
    return f"now {toml(key.default)}, " + (f"lent by the {key.lender}" if key.lender else "by default")
