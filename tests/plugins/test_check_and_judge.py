"""A check gives findings and raises nothing, and the quick judge finds the same errors."""

import pytest

from mechwright.contracts.finding import Finding, errors
from mechwright.designs.design import Design
from mechwright.plugins.host import host
from mechwright.scripting.opening import design

SECTOR = {"law": "ratio", "ratio": "1 + 0.2*cos(phi)", "sector": 77.0}
JERKY = {"driver_law": "from-rest", "driver_acceleration": 20.0, "load_inertia": 6662.0}

CASES = (
    # The check raised an error, or called a design good that has no parts.
    ("noncircular-gears", {**SECTOR, "keyway_width": 19.7}, "bore.keyway-depth", "keyway_depth"),
    ("noncircular-gears", {**SECTOR, "keyway_width": 22.0}, "bore.keyway-width", "keyway_width"),
    ("five-bar", {"bushing_wall": 0.03, "running_fit": 0.1}, "five-bar.bushing-wall", "bushing_wall"),
    ("four-bar", {"bushing_wall": 0.03, "running_fit": 0.1}, "four-bar.bushing-wall", "bushing_wall"),
    # The judge missed a peak of the load.
    ("five-bar", {"arm": 59.4212, "gear_thickness": 10}, "five-bar.root", "gear_thickness"),
    # The check named another parameter than the judge.
    ("five-bar", {"module": 2.026, "load_y": -63660.0}, "five-bar.root", "gear_thickness"),
    ("noncircular-gears", {"centre_distance": 252.4, "load_torque": 12910.0}, "gear.root", "thickness"),
    ("spur-gears", {"teeth": 9, "shift": 0.0}, "gear.undercut", "shift"),
    ("spur-gears", {"diametral_pitch": 8.0, "load_torque": 3000.0}, "gear.root", "thickness"),
    (
        "four-bar",
        {"coupler_point_x": -7309.0, "coupler_point_y": -8247.0, "swing_from": 400.8, "swing_to": -205.4},
        "four-bar.eye",
        "rim",
    ),
    ("slider-crank", {"crank": 1419.0, "slider_width": 1305.0}, "slider-crank.eye", "wall"),
    ("geneva", {"law": "straight", "entry_radius": 80, "centre_distance": 40}, "geneva.straight", "crank_half_angle"),
    ("geneva", JERKY, "geneva.stud", "pin_diameter"),
    ("geneva", {"axial_gap": 9.451}, "geneva.floor", "floor"),
)  # fmt: skip
"""Family, parameters, code and parameter of the first error."""


def statement(finding: Finding) -> tuple[str, str, str]:
    return finding.code, finding.parameter, finding.message


@pytest.mark.parametrize(("family", "table", "code", "parameter"), CASES)
def test_check_gives_an_error_that_the_judge_finds_too(
    family: str, table: dict[str, object], code: str, parameter: str
) -> None:
    found: Design = design(family, **table).design
    checked = [statement(one) for one in errors(found.check())]
    assert checked[0][:2] == (code, parameter)
    assert [statement(one) for one in errors(found.judge())] == checked


@pytest.mark.parametrize("family", ["five-bar", "four-bar"])
@pytest.mark.parametrize("wall", [0.0, 0.15])
def test_a_bushing_of_the_proposed_wall_is_a_part(family: str, wall: float) -> None:
    table = {"bushing_wall": 0.03, "running_fit": 0.1}
    (thin,) = errors(design(family, **table).design.check())
    assert {"parameters.bushing_wall": wall} in thin.proposed
    params = host().family(family).Params.model_validate({**table, "bushing_wall": wall})
    assert any("bushing" in part.name for part in host().family(family).parts(params)) == (wall > 0)


def test_gears_whose_width_is_left_out_bear_the_peak_of_the_load() -> None:
    found = design("five-bar", arm=59.4212).design
    assert found.params.gear_thickness > 10
    assert not errors(found.check())
