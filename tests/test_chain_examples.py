"""The examples of chains: what they are for, by their motion; by night they are checked whole."""

import math
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night

import mechwright
from mechwright import host
from mechwright.contracts.finding import Severity
from mechwright.designs.design import load
from mechwright.mechanics.chain import Chain, ChainParams
from mechwright.mechanics.chain.links import links_of
from mechwright.mechanics.chain.motion import motion_of
from mechwright.mechanics.chain.placing import in_plan
from mechwright_noncircular_gears.kinematics.law import extremes_of
from mechwright_noncircular_gears.sized import SizedParams

FILES = sorted(
    path
    for path in (Path(__file__).parents[1] / "examples" / "chains").glob("*.toml")
    if "requirement" not in path.stem
)


def moved(name: str, samples: int = 361):
    """The motion of an example, without its planes."""
    design = load(next(path for path in FILES if path.stem == name), host())
    assert isinstance(design.family, Chain)
    assert isinstance(design.params, ChainParams)
    families = design.family.families
    links = links_of(design.params, families)
    return design.params, motion_of(design.params, families, in_plan(links), samples)


@pytest.mark.parametrize(
    ("name", "most", "plain", "convex", "index"),
    [
        ("geneva-behind-gears", 4.1154, 8.49, False, 180),
        ("geneva-behind-fitted-gears", 4.0371, 8.49, True, 180),
        ("geneva-six-behind-gears", 4.1238, 5.65, True, 190),
        ("geneva-eight-behind-gears", 4.0880, 4.94, True, 190),
    ],
)
def test_wheels_behind_gears_accelerate_nearly_the_least(
    name: str, most: float, plain: float, convex: bool, index: float
) -> None:
    """Ca of the wheel as the chain moves, below that of its slots; teeth lean by less than 50 degrees."""
    params, motion = moved(name)
    assert 4 < motion.scalars["2.Ca"].value < most < plain
    gears = params.stage[0].parameters
    assert isinstance(gears, SizedParams)
    found = extremes_of(gears)
    assert math.degrees(found.steepest.value) + gears.pressure_angle < 50
    assert (min(one.value for one in found.curvatures) > 0) is convex
    wheel = motion["2.omega_w"]
    assert np.count_nonzero(np.abs(wheel) > 1e-12) == pytest.approx(361 * index / 360, abs=2)


def test_slider_goes_at_constant_speed_over_its_window() -> None:
    """To rounding behind the gears; the same slider at constant crank speed is off by 42 %."""
    _, motion = moved("slider-behind-gears", 721)
    angle = np.degrees(motion["1.theta1"])
    window = (angle <= 75) | (angle >= 285)
    speed = motion["2.v"][window]
    assert np.ptp(speed) / np.abs(speed.mean()) < 1e-12
    crank = np.radians(np.linspace(50, 130, 721))
    plain = np.sin(crank) + np.sin(crank) * np.cos(crank) / np.sqrt(16 - np.sin(crank) ** 2)
    assert np.ptp(plain) / plain.mean() == pytest.approx(0.4239, abs=1e-4)


@by_night
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_examples_of_chains_have_no_fault(path: Path) -> None:
    """Every stage, and all together."""
    found = load(path, host()).check()
    assert [one for one in found if one.severity is not Severity.NOTE] == []
    assert path.read_text(encoding="utf-8").startswith("# ")


@by_night
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_plate_of_a_chain_has_a_proven_program(path: Path) -> None:
    """A program is there only when its proof holds."""
    chain = mechwright.load(path)
    made = {program.job.part.name for program in chain.programs}
    assert made == {part.name for part in chain.parts if part.outline is not None and part.bought is None}


def test_sectors_turn_the_other_way_by_their_law_and_rest_with_the_lever() -> None:
    """Within 0.8 to 1.1 of the lever's speed, over the middle 24 of their 30 degrees."""
    params, motion = moved("sectors-behind-lever", 721)
    driver, out = np.degrees(motion["2.theta1"]), np.degrees(motion["2.theta2"])
    assert [driver.min(), driver.max()] == pytest.approx([3.0, 27.0], abs=0.01)
    assert 24 * 0.8 < np.ptp(out) < 24 * 1.1
    ratio = motion["2.ratio"]
    assert 0.8 < ratio.min() < ratio.max() < 1.1
    assert params.stage[1].start == pytest.approx(27.0, abs=0.01)
    rests = np.abs(motion["2.omega2"]) < 1e-9
    assert rests.mean() == pytest.approx(1 / 3, abs=0.01)
