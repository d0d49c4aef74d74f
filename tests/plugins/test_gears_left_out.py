"""What a design of gears leaves out follows from what it says, and can be made."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mechwright as mw
from mechwright import Stage
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.mechanics.gearing import Rack
from mechwright.mechanics.gearing.usual import face_width, teeth_without_undercut, tip_radius_beside
from mechwright.testing.evaluation import assert_same
from mechwright_cam.shop.library import load_library
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.rules.undercut import without_undercut
from mechwright_elliptic_gears.table import table_of as ellipses
from mechwright_noncircular_gears.family import NoncircularGears
from mechwright_noncircular_gears.rules.shape_rules import UNDERCUT
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.table import table_of

LEFT_OUT = ("dedendum", "tip_radius", "teeth", "thickness", "bore")

BREAKS_THROUGH = 0.3
"""mm: so far an end mill goes below a plate."""


@pytest.mark.parametrize("angle", [14.5, 20.0, 25.0])
def test_on_a_circle_the_least_teeth_are_those_of_a_rack(angle):
    assert teeth_without_undercut(math.tau, 1.0, 1.25, angle) == math.ceil(
        2 / math.sin(math.radians(angle)) ** 2
    )


@settings(deadline=None)
@given(eccentricity=st.floats(0.0, 0.9), angle=st.floats(14.0, 30.0))
def test_elliptic_teeth_are_free_of_undercut_and_few(eccentricity, angle):
    """As every flank tells; one tooth in ten fewer would be too few, for some flank ends near the vertex."""
    chosen = EllipticGearParams(eccentricity=eccentricity, pressure_angle=angle)
    assert without_undercut(ellipses(chosen)).size
    fewer = chosen.model_copy(update={"teeth": math.floor(0.9 * chosen.teeth)})
    assert chosen.teeth == 25 or not without_undercut(ellipses(fewer)).size


def test_what_is_usual_stays_where_it_can_be_cut():
    for eccentricity in (0.0, 0.4, 0.6):
        found = EllipticGearParams(eccentricity=eccentricity)
        assert [getattr(found, name) for name in LEFT_OUT[:4]] == [1.25, 0.38, 25, 10]


def test_teeth_mesh_at_the_offset_that_is_given():
    for offset, teeth in ((0.0, 25), (0.5, 25), (0.25, 26), (0.75, 26)):
        assert EllipticGearParams(tooth_offset=offset).teeth == teeth


@pytest.mark.parametrize("lobes", [2, 3, 4, 5])
def test_teeth_of_several_lobes_are_whole_and_the_least_that_can_be_cut(lobes):
    chosen = SizedParams(lobes=lobes)
    assert chosen.teeth % lobes == 0
    assert UNDERCUT.allows(table_of(chosen))
    fewer = chosen.model_copy(update={"teeth": chosen.teeth - lobes})
    assert fewer.teeth < 40 or not UNDERCUT.allows(table_of(fewer))


@pytest.mark.parametrize(
    ("family", "given"),
    [
        ("elliptic-gears", {"eccentricity": 0.64}),
        ("elliptic-gears", {"eccentricity": 0.8}),
        ("elliptic-gears", {"pressure_angle": 14.5}),
        ("elliptic-gears", {"pressure_angle": 25}),
        ("elliptic-gears", {"addendum": 1.3}),
        ("elliptic-gears", {"tooth_offset": 0.75}),
        ("noncircular-gears", {"lobes": 4}),
        ("noncircular-gears", {"lobes": 3}),
        ("noncircular-gears", {"mate_lobes": 4}),
        ("noncircular-gears", {"pressure_angle": 14.5}),
        ("noncircular-gears", {"pressure_angle": 25}),
        ("noncircular-gears", {"centre_distance": 12}),
    ],
)
def test_one_key_that_is_given_is_not_the_mistake_of_one_that_is_not(family, given):
    kind = {"elliptic-gears": EllipticGears, "noncircular-gears": NoncircularGears}[family]()
    assert not [one for one in kind.judge(kind.Params(**given)) if one.severity is mw.Severity.ERROR]


def test_a_note_tells_what_was_chosen():
    said = [one.message for one in EllipticGears().check(EllipticGearParams(eccentricity=0.64, bore=8))]
    assert "defaults chosen for this design: teeth = 26" in said
    assert not any(one.code == "gear.chosen" for one in EllipticGears().check(EllipticGearParams()))


@pytest.mark.parametrize("angle", [20.0, 25.0, 28.0])
@pytest.mark.parametrize("dedendum", [1.25, 1.4])
def test_tip_arcs_leave_a_land_and_hardly_more(angle, dedendum):
    radius = float(tip_radius_beside(dedendum, angle))

    def land(tip):
        return Rack(1.0, math.radians(angle), 1.0, dedendum, tip, 0.0).half_land

    assert land(radius) >= 0
    assert radius == 0.38 or land(radius + 0.011) < 0


@pytest.mark.parametrize("module", [0.8, 0.9, 1.0, 1.2, 1.4, 1.5, 2.0, 5.0])
def test_a_mill_about_a_module_wide_goes_through_the_face_width(module):
    """Mills of the library that stands in the program; an eighth wider than a module they still run to the roots."""
    deep = float(face_width(module)) + BREAKS_THROUGH
    mills = [tool for tool in load_library(None).tools if tool.name.startswith("mill-")]
    assert any(tool.diameter <= 1.12 * module and tool.flute_length >= deep for tool in mills)


def test_many_pairs_have_what_each_would_have_by_itself():
    rng = np.random.default_rng(3)
    ranges = {"eccentricity": (0.3, 0.85), "pressure_angle": (15, 27), "addendum": (0.9, 1.3)}
    varied = {name: rng.uniform(*ends, 6) for name, ends in ranges.items()}
    family, columns = EllipticGears(), ("centre_distance", "mass")
    for size in ({"module": rng.uniform(0.5, 3.0, 6)}, {"semi_major": rng.uniform(10, 60, 6)}):
        batch = Batch(EllipticGearParams, {}, {**varied, **size})
        found = family.evaluate(batch, columns)
        assert_same(found, one_by_one(family.judge, family.solve, batch, columns, Stage.PARTS, family.parts))
        assert (found.forbidden == 0).mean() > 0.5


def test_a_study_of_lobes_refuses_none_for_teeth_that_are_left_out():
    batch = Batch(SizedParams, {"law": "ellipse"}, {"lobes": np.array([1, 2, 3])})
    assert not NoncircularGears().evaluate(batch, ("ratio_max",), Stage.MOTION).forbidden.any()
