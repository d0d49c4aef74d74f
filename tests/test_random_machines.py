"""Ten random machines of each family: each passes the checker of machines, or is refused by name. By night.

A draw changes numbers of an example by some percent. It is made up to its assembly, without programs.
"""

from pathlib import Path

import pytest
from by_night import by_night
from machines import faults, machine_of
from random_machines import design_file

from mechwright.contracts.refused import RefusedError
from mechwright.errors import MechwrightError

EXAMPLES = Path(__file__).parents[1] / "examples"

COUNT = 10
"""Machines of a family."""

FAMILIES = [
    "elliptic-pair-machine", "figure-eight-machine", "four-bar-machine", "slider-crank-machine", "five-bar-machine",
    "geneva-machine", "spur-gears-machine", "spherical-machine", "spherical-double-crank-machine",
    "spherical-five-bar-machine", "linkages/whitworth", "linkages/klann", "linkages/toggle-press",
    "chains/geneva-behind-gears-machine", "chains/cam-behind-gears", "chains/five-bar-behind-gears",
    "chains/slider-behind-gears", "cam-lever", "cam-slide", "noncircular-lobes", "noncircular-slider",
    "planetary-gears", "spur-ring",
]  # fmt: skip
"""One or more examples of each family; those that have no frame yet are judged as bare mechanisms."""


def outcome(path: Path) -> list[str]:
    """The faults of a design that is allowed; nothing of one that is refused in one line, by a name.

    The name is a finding's code, or the key of the design file that is wrong.
    """
    try:
        machine = machine_of(path)
    except RefusedError as refused:
        return [f"no name: {one}" for one in refused.findings if not one.code or "\n" in one.message]
    except MechwrightError as error:
        said = str(error)
        return [f"no name: {said}"] if "\n" in said or not said.startswith(str(path)) else []
    return faults(machine)


@by_night
@pytest.mark.parametrize("example", FAMILIES)
def test_random_machines_pass_the_checker_or_are_refused_by_name(example, tmp_path):
    for number in range(COUNT):
        path = design_file(tmp_path, EXAMPLES / f"{example}.toml", number)
        assert outcome(path) == [], path.read_text(encoding="utf-8")
