"""What the program chooses by itself is never warned of: mills, passes, feeds."""

from pathlib import Path

import pytest
from by_night import by_night

from mechwright.cli.hosting import open_host
from mechwright.contracts.finding import Severity
from mechwright.pipeline import Build, Wanted
from mechwright_cam.machining import Machining

EXAMPLES = Path(__file__).parents[2] / "examples"
DAILY = ("cam-slide", "elliptic-pair", "geneva-prototype")


def milled() -> list[object]:
    """Every example with a table ``[cam]``: a few by day, all by night."""
    names = [
        path.stem
        for path in sorted(EXAMPLES.glob("*.toml"))
        if "\n[cam" in path.read_text(encoding="utf-8") and not path.stem.endswith(("-requirement", "-study"))
    ]
    return [pytest.param(name, marks=() if name in DAILY else by_night) for name in names]


@pytest.mark.parametrize("name", milled())
def test_no_example_is_warned_of_what_the_program_has_chosen(name: str) -> None:
    with Build(EXAMPLES / f"{name}.toml", open_host(), Wanted("verify")) as build:
        found = build.made(Machining).findings
    assert [finding for finding in found if finding.severity is Severity.WARNING] == []
    assert [finding for finding in found if finding.severity is Severity.ERROR] == []
