"""Machines drawn at random: numbers of an allowed example, changed a little."""

import random
import re
from pathlib import Path

SHARE = 0.08
"""By which share numbers are changed, up or down, at most."""

_NUMBER = re.compile(r"^(\s*\w+ = )(-?\d+\.\d+|\d\d+)(?=\s*(?:#.*)?$)", re.MULTILINE)
_TABLE = re.compile(r"(?m)^(?=\[)")
_DISTURBED = re.compile(r"\[+(?:parameters|machine|stage)\b")


def disturbed(text: str, draw: random.Random) -> str:
    """A design file whose numbers of the mechanism and of its frame are others; whole ones below 10 stay.

    Of each file between one number and a third of them change: many dimensions at once seldom fit each other.
    """
    tables = _TABLE.split(text)
    places = [
        (n, found.start())
        for n, table in enumerate(tables)
        if _DISTURBED.match(table)
        for found in _NUMBER.finditer(table)
    ]
    if not places:
        return text
    chosen = set(draw.sample(places, draw.randint(1, max(1, len(places) // 3))))
    return "".join(
        _NUMBER.sub(
            lambda found, n=n: found[1] + _near(found[2], draw) if (n, found.start()) in chosen else found[0],
            table,
        )
        for n, table in enumerate(tables)
    )


def _near(number: str, draw: random.Random) -> str:
    value = float(number) * draw.uniform(1 - SHARE, 1 + SHARE)
    if "." in number:
        return f"{value:.3f}"
    return f"{value:.0f}" if round(value) != int(number) else f"{int(number) + 1}"


def design_file(folder: Path, example: Path, number: int) -> Path:
    """The design file of a draw beside what the example needs: it lies in the folder."""
    draw = random.Random(f"{example.stem} {number}")  # noqa: S311 - sizes, no secrets
    path = folder / f"{example.stem}-{number}.toml"
    path.write_text(disturbed(example.read_text(encoding="utf-8"), draw), encoding="utf-8")
    for beside in example.parent.glob("*.csv"):
        (folder / beside.name).write_bytes(beside.read_bytes())
    return path
