"""Small mechanisms get pins, rims, webs and bores that fit them, where the file leaves them out."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mechwright as mw
from mechwright import Stage
from mechwright.contracts.design_table import with_columns
from mechwright.contracts.evaluation import Batch
from mechwright.contracts.finding import Severity, errors
from mechwright.contracts.refusals import refusals
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_five_bar.defaults.complete_parameters import CompleteParams
from mechwright_five_bar.family import FiveBars
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.parameters import FourBarParams
from mechwright_geneva.defaults.dimensions import complete
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_slider_crank.parts.dimensions import dimensions_of

SHORT = {
    "four-bar of 20 mm": ("four-bar", {"crank": 5, "coupler": 18, "follower": 15, "ground": 20}),
    "four-bar of 10 mm": ("four-bar", {"crank": 3, "coupler": 10, "follower": 8, "ground": 11}),
    "point near A": (
        "four-bar",
        {
            "crank": 12,
            "coupler": 40,
            "follower": 30,
            "ground": 42,
            "coupler_point_x": 7,
            "coupler_point_y": 0,
        },
    ),
    "gear of 20 mm": ("elliptic-gears", {"semi_major": 10}),
    "train of 30 mm": ("elliptic-gears", {"semi_major": 15, "stages": 2}),
    "five-bar of 25 mm": (
        "five-bar",
        {
            "crank": 5,
            "coupler": 20,
            "rocker": 20,
            "arm": 5,
            "ground": 25,
            "coupler_point_x": 10,
            "coupler_point_y": 0,
        },
    ),
}


@pytest.mark.parametrize("name", SHORT)
def test_small_mechanisms_are_built_as_they_are(name):
    family, lengths = SHORT[name]
    mechanism = mw.design(family, thickness=2, **lengths)
    assert not mechanism.findings.errors
    assert len(mechanism.parts) > 0
    noted = [one.message for one in mechanism.findings if one.code.endswith(".sizes")]
    assert all("pin_diameter = " in one for one in noted)
    assert bool(noted) == family.endswith("-bar")


def test_what_is_given_stays_and_usual_links_have_usual_pins():
    assert FourBarParams().pin_diameter == 6
    assert CompleteParams().web_width == 12
    small = FourBarParams(crank=5, coupler=18, follower=15, ground=20, rim=1)
    assert (small.pin_diameter, small.rim) == (4, 1)
    asked = FourBarParams(crank=5, coupler=18, follower=15, ground=20, pin_diameter=6)
    assert asked.pin_diameter == 6
    assert mw.design("four-bar", crank=5, pin_diameter=6, rim=4).findings.errors


def test_files_leave_them_open():
    text = mw.design("four-bar", crank=5, coupler=18, follower=15, ground=20).toml
    assert "\n# pin_diameter = 3.0" in text
    assert "\n# pin_diameter = 6.0" in mw.design("four-bar").toml
    assert "\npin_diameter = 2" in mw.design("four-bar", pin_diameter=2).toml


def test_longer_links_get_thicker_pins_again():
    small = mw.design("four-bar", crank=5, coupler=18, follower=15, ground=20)
    assert small.with_(crank=30, coupler=80, follower=70, ground=90).design.params.pin_diameter == 6


@given(st.floats(1, 30), st.floats(1, 60), st.floats(1, 60), st.sampled_from([0.0, 0.5, 1.0]))
def test_sizes_leave_rims_wherever_some_do(crank, coupler, follower, wall):
    one = FourBarParams(crank=crank, coupler=coupler, follower=follower, ground=90, bushing_wall=wall)
    turning = one.pin_diameter + (2 * wall or one.running_fit)
    least = min(crank - one.pin_diameter, follower - one.pin_diameter, coupler - turning)
    assert least >= one.rim - 1e-9 or (one.pin_diameter, one.rim) == (6, 4)


@pytest.mark.parametrize(
    ("family", "content", "varied"),
    [
        (FourBars(), {"coupler": 24.0, "follower": 21.0, "ground": 27.0}, "crank"),
        (FourBars(), {"coupler": 24.0, "follower": 21.0, "ground": 27.0, "crank": 8.0}, "rim"),
        (EllipticGears(), {"eccentricity": 0.5, "teeth": 41}, "semi_major"),
        (FiveBars(), {"coupler": 40.0, "rocker": 40.0, "arm": 9.0, "ground": 50.0}, "crank"),
    ],
)
def test_many_at_once_have_the_sizes_of_each(family, content, varied):
    values = np.linspace(2.0, 12.0, 11)
    found = family.evaluate(Batch(family.Params, content, {varied: values}), (), Stage.PARTS)
    codes = [found.codes[one] for one in found.forbidden]
    alone = []
    for value in values:
        said = family.check(family.Params(**{**content, varied: float(value)}))
        alone.append(next((one.code for one in errors(said, Stage.PARTS)), ""))
    assert codes == alone


def thin_pins(made):
    """What is found of pins that do not bear their load."""
    found = (one for one in made.findings if one.severity is not Severity.NOTE)
    return [one.code for one in found if one.code.startswith("slider-crank.pin")]


@pytest.mark.parametrize("load", [300, -500, 1500])
def test_a_slider_crank_has_the_pin_that_its_load_asks_for(load):
    """Where the file leaves it out; the plates are those of that pin, whatever else is asked of them."""
    press = mw.design("slider-crank", crank=30, rod=120, offset=0, thickness=12, load=load)
    assert not thin_pins(press)
    (bore, *_) = [one for one in press.parts["rod"].features if one.name.startswith("bore")]
    assert bore.fit.size == dimensions_of(press.design.params).pin + 2
    thin = press.with_(pin=2)
    assert thin_pins(thin)


def test_loads_of_many_slider_cranks_give_each_its_pin():
    loads = np.array([0.0, 100.0, -500.0, 1500.0, 9000.0])
    one = SliderCrankParams(crank=30, rod=120, offset=5, thickness=12)
    pins = dimensions_of(with_columns(one, {"load": loads[:, None]})).pin
    each = [dimensions_of(one.model_copy(update={"load": float(load)})).pin for load in loads]
    assert pins.ravel().tolist() == each
    assert each == sorted(each)


@pytest.mark.parametrize(("law", "wheel"), [("straight", 12), ("straight", 20), ("cycloidal", 20)])
def test_small_geneva_wheels_have_pins_and_dowels_whose_holes_can_be_made(law, wheel):
    made = mw.design("geneva", law=law, entry_radius=wheel, thickness=5, load_inertia=1e-6)
    assert not made.findings.errors
    sizes = complete(made.design.params)
    assert sizes.pin_diameter >= 1.2
    assert sizes.crank_thickness < 6
    assert sizes.fixing == 0 or sizes.fixing >= 1


@pytest.mark.parametrize(("model", "short"), [(FourBarParams, 9.0), (CompleteParams, 8.0)])
def test_a_first_design_with_fitted_sizes_does_not_send_all_the_slow_way(model, short):
    assert model(crank=short).rim < model.model_fields["rim"].default
    assert refusals(Batch(model, {}, {"crank": np.array([short, 40.0])})).known.all()
