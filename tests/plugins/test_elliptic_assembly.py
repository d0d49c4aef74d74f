"""The default backlash: gears with all the stock that a proof lets pass go together and turn."""

import math

import numpy as np
import pytest
import shapely

from mechwright.contracts.finding import Severity, Stage
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.kinematics.equations import Turning, driven
from mechwright_elliptic_gears.parts.backlash import LEFT, OFF_CENTRE, backlash_of, least_backlash
from mechwright_elliptic_gears.parts.gear import outline_of, rack_of

FAMILY = EllipticGears()
Params = FAMILY.Params


@pytest.mark.parametrize(("e", "least"), [(0.2, 0.064855), (0.4, 0.066390), (0.6, 0.069858)])
def test_the_least_backlash_is_the_closed_form_rounded_up(e, least):
    assert pytest.approx(0.020) == LEFT
    assert pytest.approx(0.030) == OFF_CENTRE
    params = Params(eccentricity=e, teeth=31)
    assert least <= least_backlash(params) < least + 1e-3
    assert rack_of(params).backlash == backlash_of(params) == least_backlash(params)
    assert backlash_of(params.model_copy(update={"backlash": 0.0})) == 0


def test_a_train_needs_more_whatever_its_eccentricity():
    train = Params(stages=2, bore=12.0)
    assert least_backlash(train) == least_backlash(Params(stages=2, bore=12.0, eccentricity=0.1))
    assert least_backlash(train) == pytest.approx(2 * 0.05 / math.cos(math.radians(20)), abs=1e-3)


FITS = 2e-4
"""mm: what fitting and flattening may put on an outline."""


def jams(params, theta2):
    """Whether no turn of gear 4 frees gears with the most stock left, on axes that are too near."""
    grown = shapely.Polygon(outline_of(params).outer.flatten(1e-4)).buffer(LEFT / 2 - FITS, quad_segs=16)
    a = params.semi_major
    one = shapely.affinity.rotate(grown, theta2, origin=(0, 0), use_radians=True)
    theta4 = float(driven(Turning.of(np.array([theta2]), 1.0), params.eccentricity).theta[0])
    for turn in np.linspace(-1e-3, 1e-3, 401):
        other = shapely.affinity.rotate(grown, theta4 + turn, origin=(0, 0), use_radians=True)
        if not shapely.affinity.translate(other, 2 * a - OFF_CENTRE).intersects(one):
            return False
    return True


@pytest.mark.parametrize(("e", "teeth"), [(0.4, 25), (0.2, 21)])
def test_pairs_as_made_turn_with_the_default_and_jam_with_less(e, teeth):
    params = Params(eccentricity=e, teeth=teeth)
    steepest = math.acos(e)  # where the pitch tangent tilts most
    positions = [steepest, steepest + 0.01, -steepest, 0.0, math.pi]
    assert not any(jams(params, theta2) for theta2 in positions)
    short = params.model_copy(update={"backlash": 0.9 * least_backlash(params)})
    assert jams(short, steepest)
    assert jams(params.model_copy(update={"backlash": 0.0}), 0.0)


@pytest.mark.parametrize(
    "table",
    [
        {"backlash": 0.0},
        {"backlash": 0.05},
        {"backlash": 0.066, "eccentricity": 0.2, "stages": 2, "bore": 12.0},
        {"backlash": 0.0, "pressure_angle": 25.0, "tip_radius": 0.2},
    ],
    ids=str,
)
def test_too_little_backlash_is_told_with_advice_that_helps(table):
    def about(params):
        return [f for f in FAMILY.check(params) if f.code == "gear.backlash"]

    (finding,) = about(Params(**table))
    jams = table["backlash"] == 0
    assert finding.severity is (Severity.ERROR if jams else Severity.WARNING)
    assert (finding.parameter, finding.stage) == ("backlash", Stage.MACHINING)
    assert finding.value == table["backlash"]
    for better in ({**table, "backlash": finding.limit}, {k: v for k, v in table.items() if k != "backlash"}):
        found = FAMILY.check(Params(**better))
        assert not [f for f in found if f.severity is not Severity.NOTE]
    assert f"{finding.limit:g}" in finding.remedy


def test_teeth_that_are_too_fine_for_their_backlash():
    table = {"teeth": 27, "module": 0.1, "bore": 0.0, "pressure_angle": 25.0, "tip_radius": 0.1}
    (error,) = [f for f in FAMILY.check(Params(**table)) if f.severity is Severity.ERROR]
    assert (error.code, error.parameter) == ("gear.tip", "backlash")
    assert "module" in error.remedy
    (warning,) = [f for f in FAMILY.check(Params(**table, backlash=0.0)) if f.code == "gear.backlash"]
    assert "too thin" in warning.remedy
    larger = FAMILY.check(Params(**{**table, "module": 0.5}))
    assert not {"gear.tip", "gear.backlash"} & {f.code for f in larger}
