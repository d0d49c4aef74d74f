"""Ten random machines of each family that has an example: the checker of the order of assembly, by night.

Numbers of the example are changed by up to a tenth; a design that is refused by name is drawn again. The
train of the figure of eight is left out: its numbers fit each other, so that no other draw is a design.
"""

import random
import re
from pathlib import Path

import pytest
from by_night import by_night
from cam.assembly_check import faults

from mechwright.contracts.finding import Stage, errors
from mechwright.errors import MechwrightError
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright_cad.assembly_order.plan import plan_of

EXAMPLES = Path(__file__).parents[2] / "examples"

COUNT, TRIES = 10, 80

_NUMBER = re.compile(r"^(\w+ = )(\d+\.\d+|\d\d+)\s*$", re.MULTILINE)


@by_night
@pytest.mark.parametrize(
    "name",
    [
        "elliptic-pair-machine",
        "four-bar-machine",
        "slider-crank-machine",
        "geneva-machine",
        "spur-gears-machine",
        "five-bar-machine",
    ],
)
def test_random_machines_go_together_with_one_pair_of_hands(name, tmp_path):
    draw = random.Random(name)  # noqa: S311 - sizes, no secrets
    text = (EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")
    head, table, rest = text.partition("[parameters]")
    own, following, more = rest.partition("\n[")
    built = 0
    for attempt in range(TRIES):
        changed = _NUMBER.sub(lambda found: found[1] + _near(found[2], draw), own)
        path = tmp_path / f"{attempt}.toml"
        path.write_text(head + table + changed + following + more, encoding="utf-8")
        try:
            with Build(path, host(), Wanted("model")) as build:
                if errors(build.findings, Stage.PARTS):
                    continue
                plan = plan_of(build)
        except MechwrightError:
            continue
        if not plan.order.has_ways:
            continue
        assert faults(plan) == [], path.read_text(encoding="utf-8")
        built += 1
        if built == COUNT:
            break
    assert built, "no draw was a design"


def _near(number: str, draw: random.Random) -> str:
    value = float(number) * draw.uniform(0.9, 1.1)
    return f"{value:.2f}" if "." in number else f"{value:.0f}"
