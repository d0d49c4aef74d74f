"""No example is warned of what the program has chosen itself, on any control."""

from pathlib import Path

import pytest
from by_night import by_night

from mechwright.contracts.finding import Severity
from mechwright.designs.design import load
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import Machining

EXAMPLES = Path(__file__).parents[1] / "examples"
DESIGNS = [
    path for path in sorted(EXAMPLES.glob("*.toml")) if not path.stem.endswith(("-requirement", "-study"))
]
CONTROLS = tuple(host().of(Control))
ASKED = {"cam.compensation", "cam.line-numbers"}
"""What is said of keys that elliptic-pair-haas has: not all controls have cutter compensation, or steps of numbers."""


@pytest.mark.parametrize(
    ("path", "control"),
    [
        # Each on LinuxCNC and one other in turn; by day two small ones.
        pytest.param(
            path,
            control,
            id=f"{path.stem}-{control}",
            marks=() if path.stem in {"inch-bracket", "spherical-four-bar-slots"} and place else by_night,
        )
        for number, path in enumerate(DESIGNS)
        for place, control in enumerate(
            dict.fromkeys(("linuxcnc", CONTROLS[1 + number % (len(CONTROLS) - 1)]))
        )
    ],
)
def test_what_a_design_is_told_is_of_its_own_choice(path: Path, control: str) -> None:
    design = load(path, host()).changed({"cam.control": control})
    with Build(design, host(), Wanted("verify")) as build:
        found = [*design.check(), *build.made(Machining).findings]
    told = {one.code for one in found if one.severity in {Severity.WARNING, Severity.ERROR}}
    assert told - ASKED == set()
