"""Many spherical four-bars at once are what each is by itself."""

import pytest
from by_night import in_ci
from many import Many

from mechwright import Stage
from mechwright_spherical.family import Spherical

pytestmark = in_ci

FAMILY = Spherical()
MANY = Many(FAMILY, {"kind": "four-bar"})
ENDS = ("least", "greatest")
FIGURES = [
    "transmission_min", "transmission_max", "T1", "T2", "T3", "T4", "time.least", "time.greatest",
    *(
        f"{name}.{end}"
        for name in ("omega", "alpha", "jerk", "psi", "omega_psi", "alpha_psi", "jerk_psi", "transmission_angle")
        for end in ENDS
    ),
]  # fmt: skip


CRANKS = {
    "four_bar__input": (15, 35),
    "four_bar__coupler": (50, 90),
    "four_bar__output": (45, 85),
    "four_bar__ground": (70, 110),
}
SMALL = {name: (low / 4, high / 4) for name, (low, high) in CRANKS.items()}
ANY = dict.fromkeys(CRANKS, (0, 180))
ONE = {"hardware": {"frame": "one"}}


def test_cranks_and_levers_of_both_branches():
    found = MANY.same(MANY.drawn(40, ONE, **ANY, four_bar__branch=[1, -1]), FIGURES, Stage.PARTS)
    assert {"spherical.assembly", "spherical.clearance"} <= set(found.counts)
    assert 0 in found.forbidden
    assert not MANY.alone


@pytest.mark.parametrize("flat", [{}, {"flat": {"make": True}}])
def test_sizes_of_links_and_stand(flat):
    batch = MANY.drawn(
        40, {**ONE, **flat}, **CRANKS, hardware__boss_diameter=(7, 30), hardware__gap=(0.1, 1.5), stand__arc=(10, 60),
        radius=(30, 100), flat__bend_radius=(1, 50), four_bar__point_azimuth=(-20, 80),
    )  # fmt: skip
    found = MANY.same(batch, ["alpha_psi.greatest"], Stage.PARTS)
    assert {"spherical.boss", "spherical.gap", "spherical.stand"} <= set(found.counts)
    assert ("spherical.strip" in found.counts) == bool(flat)
    assert not MANY.alone


@pytest.mark.parametrize("given", [{}, {"hardware": {"pin_diameter": 3}}, {"hardware": {"boss_diameter": 9}}])
def test_small_spheres_have_small_pins(given):
    hardware = {**ONE["hardware"], **given.get("hardware", {})}
    batch = MANY.drawn(
        40, {"hardware": hardware}, **SMALL, radius=(6, 60), hardware__standoff=(0, 4), stand__arc=(40, 75),
        hardware__fit=(0, 0.8), four_bar__point_azimuth=(-90, 90),
    )  # fmt: skip
    found = MANY.same(batch, ["alpha_psi.greatest"], Stage.PARTS)
    assert "spherical.clearance" in found.counts or "spherical.shafts" in found.counts
    assert 0 in found.forbidden
    assert not MANY.alone


def test_a_ground_on_both_sides_is_asked_by_itself():
    batch = MANY.drawn(6, {}, four_bar__input=(70, 90), four_bar__ground=(20, 40), four_bar__coupler=(70, 90))
    MANY.same(batch, ["transmission_min", "xP.greatest"], Stage.PARTS)
    assert MANY.alone


@pytest.mark.parametrize(
    ("content", "stage"),
    [
        ({"four_bar": {"travel": 90}}, Stage.MOTION),
        ({"stand": {"motor_flange": 60}}, Stage.PARTS),
        ({"hardware": {"frame": "two"}}, Stage.PARTS),
    ],
)
def test_what_no_formula_tells_goes_one_by_one(content, stage):
    MANY.same(MANY.drawn(2, content, radius=(90, 110)), ["transmission_min"], stage)
    assert MANY.alone == 2


def test_the_ground_and_the_motor_do_not_matter_to_the_motion():
    content = {"stand": {"motor_flange": 60}, "hardware": {"frame": "two"}}
    batch = MANY.drawn(8, content, **ANY)
    found = MANY.same(batch, ["transmission_min", "psi.greatest"], Stage.MOTION)
    assert 0 in found.forbidden
    assert not MANY.alone
