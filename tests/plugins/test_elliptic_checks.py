"""Findings: each named fault is found, names its parameter, and its remedy works."""

import math
import re
from itertools import pairwise

import numpy as np
import pytest
from pydantic import ValidationError

from mechwright.contracts.finding import Severity, errors
from mechwright.errors import DesignError
from mechwright.geometry.keyway import KEYS, Opening, key_for_bore
from mechwright_elliptic_gears.family import EllipticGears

FAMILY = EllipticGears()
Params = EllipticGears.Params


def the(code, **table):
    """The one finding of this code."""
    found = [finding for finding in FAMILY.check(Params(**table)) if finding.code == code]
    assert len(found) == 1, [str(f) for f in FAMILY.check(Params(**table))]
    return found[0]


def codes(**table):
    return {
        finding.code for finding in FAMILY.check(Params(**table)) if finding.severity is not Severity.NOTE
    }


def number(text):
    return float(re.findall(r"[\d.]+", text)[0])


def test_the_example_has_nothing_to_object_to():
    assert codes(eccentricity=0.4, semi_major=50.0, teeth=25, thickness=10.0) == set()
    assert FAMILY.check(Params())[0].code == "gear.mesh"


@pytest.mark.parametrize(
    ("e", "teeth", "least"), [(0.2, 15, 19), (0.4, 15, 20), (0.6, 24, 25), (0.8, 38, 39), (0.0, 17, 18)]
)
def test_undercut_names_the_least_number_of_teeth(e, teeth, least):
    finding = the("gear.undercut", eccentricity=e, teeth=teeth, bore=0.0)
    assert (finding.severity, finding.parameter, finding.value) == (Severity.ERROR, "teeth", teeth)
    named = int(number(finding.remedy))
    assert named == finding.limit
    assert named <= least
    assert "gear.undercut" not in codes(eccentricity=e, teeth=named, bore=0.0)
    assert all("gear.undercut" in codes(eccentricity=e, teeth=z, bore=0.0) for z in range(teeth, named))


def test_undercut_keeps_the_parity_that_an_offset_asks_for():
    finding = the("gear.undercut", eccentricity=0.8, teeth=38, tooth_offset=0.25, bore=0.0)
    assert finding.limit == 40
    assert "gear.undercut" not in codes(eccentricity=0.8, teeth=40, tooth_offset=0.25, bore=0.0)


def test_undercut_names_the_largest_module():
    finding = the("gear.undercut", eccentricity=0.6, teeth=24, semi_major=50.0)
    largest = number(finding.remedy.split("module of at most")[1])
    better = Params(eccentricity=0.6, teeth=25, module=math.floor(largest * 1e4) / 1e4)
    assert not errors(FAMILY.check(better))
    # The rule of thumb of the whole ellipse, which the exact limit can only exceed.
    assert largest < 0.116978 * 50 * (1 - 0.36) < largest * 25 / 24


def test_undercut_without_a_number_that_works():
    finding = the("gear.undercut", eccentricity=0.9, teeth=30, pressure_angle=10.0, dedendum=2.0)
    assert finding.limit is None
    assert "eccentricity" in finding.remedy


@pytest.mark.parametrize(
    ("teeth", "offset", "right"), [(25, 0.25, (0.0, 0.5)), (40, 0.0, (0.25, 0.75)), (41, 0.9, (0.0, 0.5))]
)
def test_wrong_phase(teeth, offset, right):
    finding = the("gear.phase", teeth=teeth, tooth_offset=offset)
    assert (finding.severity, finding.parameter) == (Severity.ERROR, "tooth_offset")
    assert f"{right[0]:g} or {right[1]:g}" in finding.remedy
    for value in right:
        assert not errors(FAMILY.check(Params(teeth=teeth, tooth_offset=value)))


@pytest.mark.parametrize(
    ("code", "parameter", "table"),
    [
        ("gear.module", "teeth", {"teeth": 300, "semi_major": 2.0}),
        ("gear.rack", "tip_radius", {"tip_radius": 0.6, "dedendum": 0.5, "addendum": 0.3}),
        ("gear.clearance", "dedendum", {"addendum": 1.25, "dedendum": 1.25}),
        ("gear.convexity", "dedendum", {"eccentricity": 0.9, "teeth": 8}),
        ("gear.root-land", "tip_radius", {"tip_radius": 0.5}),
        ("gear.root-land", "dedendum", {"dedendum": 1.7, "pressure_angle": 30.0, "tip_radius": 0.1}),
        ("gear.tip", "addendum", {"addendum": 1.1, "pressure_angle": 30, "dedendum": 1.3, "tip_radius": 0}),
        ("gear.tip", "backlash", {"teeth": 61, "backlash": 2.0}),
        ("bore.rim", "bore", {"bore": 50.0}),
        ("bore.rim", "keyway_depth", {"semi_major": 20, "teeth": 41, "keyway_width": 3, "keyway_depth": 22}),
        ("bore.size", "bore", {"bore": 0.1}),
        ("bore.size", "keyway_width", {"keyway_width": 0.2}),
        ("bore.size", "keyway_relief", {"keyway_width": 3.0, "keyway_relief": 0.01}),
        ("bore.rim", "eccentricity", {"eccentricity": 0.9, "teeth": 23, "pressure_angle": 30.0, "bore": 0.0,
                                      "dedendum": 0.7, "tip_radius": 0.0, "addendum": 0.5}),
        ("gear.mesh", "addendum", {"addendum": 1.2, "dedendum": 1.25}),
        ("bore.keyway-width", "keyway_width", {"bore": 6.0, "keyway_width": 6.0}),
        ("bore.keyway-depth", "keyway_depth", {"bore": 20.0, "keyway_width": 7.0}),
        ("bore.keyway-depth", "keyway_depth", {"bore": 20.0, "keyway_width": 6.0, "keyway_depth": 2.0}),
        ("bore.keyway-relief", "keyway_relief", {"bore": 20.0, "keyway_width": 6.0, "keyway_relief": 4.3}),
    ],
)  # fmt: skip
def test_what_cannot_be_built(code, parameter, table):
    finding = the(code, **table)
    assert finding.severity is Severity.ERROR
    assert finding.parameter == parameter
    assert finding.remedy
    with pytest.raises(DesignError, match=parameter):
        FAMILY.parts(Params(**table))


@pytest.mark.parametrize(
    ("code", "parameter", "table"),
    [
        ("gear.pressure-angle", "eccentricity", {"eccentricity": 0.6, "teeth": 41}),
        ("gear.clearance", "dedendum", {"dedendum": 1.09, "tip_radius": 0.1}),
        ("gear.contact", "addendum", {"eccentricity": 0.0, "addendum": 0.5}),
        ("bore.rim", "bore", {"bore": 40.0}),
        ("bore.keyway-series", "keyway_width", {"bore": 20.0, "keyway_width": 5.0}),
        ("bore.keyway-depth", "keyway_depth", {"bore": 20.0, "keyway_width": 6.0, "keyway_depth": 3.0}),
    ],
)
def test_what_an_engineer_should_look_at(code, parameter, table):
    finding = the(code, **table)
    assert (finding.severity, finding.parameter) == (Severity.WARNING, parameter)
    assert finding.remedy
    assert FAMILY.parts(Params(**table))


def test_the_numbers_in_remedies_work():
    bore = number(the("bore.rim", bore=50.0).remedy)
    assert not errors(FAMILY.check(Params(bore=bore)))
    assert errors(FAMILY.check(Params(bore=bore + 0.05)))
    radius = number(the("gear.root-land", tip_radius=0.5).remedy)
    assert not errors(FAMILY.check(Params(tip_radius=radius)))
    assert errors(FAMILY.check(Params(tip_radius=radius + 1e-3)))
    relief = number(the("bore.keyway-relief", bore=20.0, keyway_width=6.0, keyway_relief=5.0).remedy)
    assert not errors(FAMILY.check(Params(bore=20.0, keyway_width=6.0, keyway_relief=relief)))
    most = int(number(the("gear.module", teeth=300, semi_major=2.0, bore=0.0).remedy))
    assert "gear.module" not in codes(teeth=most, semi_major=2.0, bore=0.0)
    e = number(the("gear.pressure-angle", eccentricity=0.6, teeth=41).remedy)
    assert "gear.pressure-angle" not in codes(eccentricity=e, teeth=41)
    assert "gear.pressure-angle" in codes(eccentricity=e + 0.001, teeth=41)


@pytest.mark.parametrize(
    "table",
    [
        {"module": 2.0, "semi_major": 50.0},
        {"module": None, "semi_major": None},
        {"bore": 0.0, "keyway_width": 6.0},
        {"keyway_depth": 2.8},
        {"keyway_relief": 2.0},
        {"material": "cheese"},
        {"eccentricity": 1.0},
        {"teeth": 25.5},
        {"tooth": 25},
    ],
    ids=str,
)
def test_tables_that_make_no_sense_are_refused(table):
    with pytest.raises(ValidationError):
        Params(**table)


def test_module_and_semi_major_make_the_same_gear():
    from mechwright_elliptic_gears.parts.gear import ellipse_of, rack_of

    by_module = Params(teeth=39, module=2.0)
    by_axis = Params(teeth=39, semi_major=ellipse_of(by_module).semi_major)
    assert rack_of(by_axis).module == pytest.approx(2.0, rel=1e-14)


def test_the_key_table_is_the_standard_series():
    # Sizes joined without gaps, and a clearance over every key as the standard's tolerances ask for.
    for one, two in pairwise(KEYS):
        assert one.bore_to == two.bore_over
        assert one.width < two.width
    for key in KEYS:
        assert 0.2 - 1e-9 <= key.shaft_depth + key.hub_depth - key.height <= 0.4 + 1e-9
        assert key_for_bore(key.bore_to) is key
        assert key_for_bore(key.bore_over + 0.1) is key
    assert key_for_bore(6.0) is None
    assert key_for_bore(231.0) is None


@pytest.mark.parametrize("relief", [0.0, 2.5])
def test_the_keyway_opening(relief):
    opening = Opening(20.0, 6.0, 2.8, relief)
    loop = opening.loop()
    half = math.asin(3 / 10)
    # Sector of the bore beside the keyway, the triangle of its chord, the keyway, and what reliefs add: a
    # semicircle over the diagonal less the triangle that was there already, twice.
    area = 100 * (math.pi - half) + opening.mouth * 3 + 6 * (12.8 - opening.mouth)
    area += 2 * (math.pi * relief**2 / 8 - relief**2 / 4)
    assert -loop.area == pytest.approx(area, rel=1e-12)
    assert loop.bounds[2] == pytest.approx(12.8 + (relief / 2) * (1 - 1 / math.sqrt(2)), abs=1e-3)
    if relief:
        corner = np.array([12.8, 3.0])
        reliefs = [segment for segment in loop.segments if segment.tag == "relief"]
        assert len(reliefs) == 2
        np.testing.assert_allclose(reliefs[0].at(0.5)[0], corner, atol=1e-12)
        assert {segment.radius for segment in reliefs} == {relief / 2}
