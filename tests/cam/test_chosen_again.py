"""What the program has chosen itself it chooses again where it does not do, before anybody is blamed for it."""

import pytest
from planning_parts import LIBRARY, bore, part, plate, rounded_box

import mechwright as mw
from mechwright import DesignError
from mechwright.contracts.finding import errors
from mechwright_cam.inspection import Machinable
from mechwright_cam.operations.choice import usable_mills
from mechwright_cam.setup.lay_out import CLAMP_RIM, check_clamp, make_job
from mechwright_cam.shop.settings import CamSettings

FINE = {"eccentricity": 0.5, "semi_major": 40, "teeth": 50, "thickness": 10}
"""A pair of module 1.49, whose fillets a mill of 2 mm leaves so full that it collides."""


def test_a_finer_mill_is_chosen_where_the_pair_as_cut_collides():
    found = Machinable().findings(mw.design("elliptic-gears", **FINE))
    assert errors(found) == []
    (told,) = (one for one in found if one.code == "cam.corner-mill")
    assert "the pair collides" in told.message
    assert told.message.endswith("so mill-1.5 is taken for their corners")


@pytest.mark.parametrize("cam", [{"corner_mill": 2.0}, {"tools": ["mill-6", "mill-2"]}])
def test_what_the_file_says_of_mills_stands(cam):
    found = Machinable().findings(mw.design("elliptic-gears", cam=cam, **FINE))
    assert [one.code for one in errors(found)] == ["gear.cut-mesh"]
    (mesh,) = errors(found)
    assert {"cam.corner_mill": 1} in mesh.proposed  # to be tried by whoever is told
    assert "cam.corner-mill" not in [one.code for one in found]


def _square(side):
    """A square plate with a bore of 5 mm in its middle."""
    return part(rounded_box(side, side, 1), bore(5))


@pytest.mark.parametrize(("half", "wide"), [(40.0, 20.0), (10.0, 18.0), (4.63, 7.2), (4.2, 7.0)])
def test_a_clamp_that_is_left_open_is_as_wide_as_the_part_bears(half, wide):
    """1 mm off the outside, and over the rim of a bore of 5 mm at least, which 4.2 mm leave no room for."""
    settings = CamSettings.model_validate({"hold": {"method": "bore"}})
    job = make_job(_square(2 * half), settings, LIBRARY.tools)
    assert job.clamp.diameter == pytest.approx(wide)
    if wide <= 2 * (half - 1):
        check_clamp(job)
    else:
        assert wide == 5 + 2 * CLAMP_RIM
        with pytest.raises(DesignError, match="comes within 1 mm of the outside"):
            check_clamp(job)


def test_a_clamp_that_the_file_says_is_taken_at_its_word():
    settings = CamSettings.model_validate({"hold": {"method": "bore", "clamp_diameter": 20}})
    job = make_job(_square(20), settings, LIBRARY.tools)
    with pytest.raises(DesignError, match=r"a clamp of 20 mm .*use at most 18\.00 mm"):
        check_clamp(job)


def test_mills_without_data_for_a_material_say_which_they_cut():
    settings = CamSettings()
    mills = [tool for tool in LIBRARY.tools if tool.name in {"mill-6", "mill-3"}]
    brass = [tool.model_copy(update={"cutting": {"brass": tool.cutting["brass"]}}) for tool in mills]
    job = make_job(plate(bore(5), material="steel"), settings, brass)
    with pytest.raises(
        mw.MechwrightError,
        match=r'none has cutting data for steel, and steel is not estimated; .*use material = "brass"',
    ):
        usable_mills(job, 5.0)
