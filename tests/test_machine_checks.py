"""The checker of whole machines over the examples: no fault is left in what is written of them."""

from pathlib import Path

import pytest
from by_night import by_night
from machines import faults, machine_of

EXAMPLES = Path(__file__).parents[1] / "examples"

BARE = (
    "planetary-gears", "geneva-motor", "cam-lever", "cam-slide", "crank-rocker-three-poles", "five-bar-slots",
    "figure-eight-train", "spherical-crank-rocker", "noncircular-lobes", "spur-gears",
)  # fmt: skip
"""Mechanisms without a frame, one or two of each family."""


def with_frames() -> list[str]:
    """Designs with a table of their machine, which carries their shafts."""
    return sorted(
        path.relative_to(EXAMPLES).with_suffix("").as_posix()
        for path in EXAMPLES.rglob("*.toml")
        if "\n[machine]\n" in path.read_text(encoding="utf-8")
    )


def test_a_small_mechanism_is_without_a_fault():
    assert faults(machine_of(EXAMPLES / "geneva-motor.toml")) == []


@by_night
@pytest.mark.parametrize("name", with_frames())
def test_a_machine_is_without_a_fault(name):
    assert faults(machine_of(EXAMPLES / f"{name}.toml")) == []


@by_night
@pytest.mark.parametrize("name", BARE)
def test_a_mechanism_without_a_frame_is_without_a_fault(name):
    assert faults(machine_of(EXAMPLES / f"{name}.toml")) == []


@by_night
@pytest.mark.parametrize(
    "name", sorted(one.stem for one in (EXAMPLES / "chains").glob("*.toml") if "requirement" not in one.stem)
)
def test_a_chain_is_without_a_fault(name):
    assert faults(machine_of(EXAMPLES / "chains" / f"{name}.toml")) == []
