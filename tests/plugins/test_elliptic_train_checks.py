"""Findings of trains: each fault is found, names its parameter, and the value it offers works."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from mechwright.contracts.finding import Severity, errors
from mechwright.errors import DesignError
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.parameters import TRAIN_ONLY
from mechwright_elliptic_gears.rules.undercut import greatest_eccentricity

FAMILY = EllipticGears()
Params = EllipticGears.Params
TRAIN = {"stages": 2, "bore": 12.0}
KEYED = TRAIN | {"keyway_width": 4.0, "keyway_relief": 2.0}


def found(**table):
    return [(f.code, f.parameter) for f in errors(FAMILY.check(Params(**table)))]


@pytest.mark.parametrize("table", [TRAIN, KEYED, TRAIN | {"phase": 200}, KEYED | {"phase": 0}])
def test_sound_trains_have_nothing_to_object_to(table):
    findings = FAMILY.check(Params(**table))
    assert {finding.severity for finding in findings} == {Severity.NOTE}
    (note,) = [finding for finding in findings if finding.code == "train.phase"]
    assert ("keyway" in note.message) == ("keyway_width" in table)


def test_the_note_says_how_gears_3_and_4_stand():
    (note,) = [f for f in FAMILY.check(Params(**KEYED)) if f.code == "train.phase"]
    assert note.value == pytest.approx(133.603, abs=1e-3)
    assert "226.397 degrees counter-clockwise" in note.message


# Code, parameter, a table with the fault; the finding's limit put into the parameter has to work.
MENDED = [
    ("point.off-coupler", "point_along", {"point_along": 1.2}, "limit"),
    ("point.off-coupler", "point_along", {"point_along": -0.1, "tracer_diameter": 0}, "limit"),
    ("point.off-coupler", "point_across", {"point_across": -51.0}, "limit"),
    ("train.tracer", "tracer_diameter", {"tracer_diameter": 7.0}, "limit"),
    ("train.tracer", "point_along", {"point_along": 0.02}, "limit"),
    ("train.tracer", "point_along", {"point_along": 0.97, "point_across": 4.0}, "limit"),
    ("train.joint", "eccentricity", {"eccentricity": 0.1, "keyway_width": 4.0}, "limit"),
    ("train.joint-rim", "pin_diameter", {"pin_diameter": 32.0, "bore": 6, "eccentricity": 0.6, "teeth": 41, "tracer_diameter": 4}, None),
    ("train.tracer", "tracer_diameter", {"pin_diameter": 60.0, "bore": 6, "eccentricity": 0.6}, None),
    ("train.sweep", "eccentricity", {"eccentricity": 0.8, "teeth": 61, "bore": 12, "dowel_diameter": 1}, None),
    ("train.dowels", "dowel_circle", {"dowel_circle": 20.0}, "limit"),
    ("train.dowel-rim", "dowel_circle", {"dowel_circle": 42.0}, None),
    ("train.phase", "phase", {"phase": 180.0, "bore": 16, "keyway_width": 5, "keyway_depth": 14.0}, "limit"),
]  # fmt: skip


@pytest.mark.parametrize(("code", "parameter", "table", "mend"), MENDED, ids=lambda value: str(value)[:40])
def test_what_cannot_be_built(code, parameter, table, mend):
    table = TRAIN | table
    faults = errors(FAMILY.check(Params(**table)))
    assert (code, parameter) in [(fault.code, fault.parameter) for fault in faults]
    fault = next(fault for fault in faults if fault.code == code)
    assert fault.remedy
    with pytest.raises(DesignError):
        FAMILY.parts(Params(**table))
    if mend:
        assert found(**table | {parameter: fault.limit}) == []
        assert f"{fault.limit:g}" in fault.remedy


def test_the_smallest_eccentricity_named_for_a_sweep_works():
    table = TRAIN | {"eccentricity": 0.8, "teeth": 61}
    (fault,) = [f for f in errors(FAMILY.check(Params(**table))) if f.code == "train.sweep"]
    assert f"{fault.limit:g}" in fault.remedy
    assert "train.sweep" not in dict(found(**table | {"eccentricity": fault.limit}))
    assert "train.sweep" in dict(found(**table | {"eccentricity": fault.limit + 0.001}))


@pytest.mark.parametrize("phase", [0.0, 63.0, 227.0])
def test_the_nearest_phase_that_works_is_named(phase):
    # The dowels of gear 4 come to its joint, which stands near its shaft here.
    table = TRAIN | {
        "eccentricity": 0.24,
        "dowel_circle": 36.0,
        "dowel_diameter": 4.0,
        "teeth": 31,
        "phase": phase,
    }
    faults = errors(FAMILY.check(Params(**table)))
    assert [(fault.code, fault.parameter) for fault in faults] == [("train.phase", "phase")]
    assert "its joint" in faults[0].message
    assert faults[0].limit is not None
    assert found(**table | {"phase": faults[0].limit}) == []
    between = (phase + ((faults[0].limit - phase + 180) % 360 - 180) / 4) % 360
    assert found(**table | {"phase": between}) != []


def test_an_eccentricity_that_no_number_of_teeth_can_have():
    table = {
        "eccentricity": 0.9,
        "teeth": 30,
        "pressure_angle": 10.0,
        "dedendum": 2.0,
        "bore": 12.0,
        "stages": 2,
    }
    (fault,) = errors(FAMILY.check(Params(**table)))
    assert fault.code == "gear.undercut"
    named = float(fault.remedy.split("at most ")[1].split(",")[0])
    assert named == greatest_eccentricity(Params(**table))
    for e, works in ((named, True), (named + 0.001, False)):
        assert "with 300 teeth" in fault.remedy
        most = Params(**table | {"eccentricity": e, "teeth": 300})
        assert ("gear.undercut" not in {f.code for f in errors(FAMILY.check(most))}) == works


@pytest.mark.parametrize("band", [0, -5, -5.0, "-3 mm/s"])
def test_a_band_without_a_width_is_refused_with_what_works(band):
    with pytest.raises(ValidationError, match=r"above 0|greater than 0"):
        Params(band=band)


@pytest.mark.parametrize("name", TRAIN_ONLY)
def test_fields_of_trains_are_refused_in_a_pair(name):
    value = {"phase_joint": "pins", "phases": (20.0,), "clamp_screws": 4, "bushes": True}.get(name, 10.0)
    with pytest.raises(ValidationError, match=f"{name} belongs to a train"):
        Params(**{name: value})


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"stages": 2, "bore": 0.0}, "bore"),
        (KEYED | {"dowel_diameter": 4.0}, "dowel_diameter"),
        (KEYED | {"dowel_circle": 30.0}, "dowel_circle"),
        ({"stages": 3}, "stages"),
    ],
)
def test_tables_that_make_no_sense(table, words):
    with pytest.raises(ValidationError, match=words):
        Params(**table)


@settings(max_examples=20, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    st.fixed_dictionaries(
        {"stages": st.just(2), "bore": st.sampled_from([6.0, 10.0, 12.0, 16.0])},
        optional={
            "eccentricity": st.floats(0, 0.9),
            "teeth": st.integers(15, 45),
            "phase": st.floats(0, 360),
            "keyway_width": st.sampled_from([0.0, 2.0, 4.0]),
            "point_along": st.floats(-0.2, 1.2),
            "point_across": st.floats(-60, 60),
            "pin_diameter": st.floats(0.5, 20),
            "tracer_diameter": st.floats(0, 12),
            "dowel_diameter": st.floats(0.5, 8),
            "dowel_circle": st.floats(10, 60),
            "phase_joint": st.sampled_from(["fixed", "pins", "clamp"]),
            "clamp_screw": st.sampled_from([2.0, 3.0, 4.0]),
            "phases": st.lists(st.floats(0, 360), min_size=1, max_size=6),
        },
    )
)
def test_random_trains_are_built_or_refused_by_name(table):
    try:
        params = Params(**table)
    except ValidationError:
        return
    findings = FAMILY.check(params)
    for finding in findings:
        assert finding.severity is Severity.NOTE or (
            finding.remedy and finding.parameter in Params.model_fields
        )
    if errors(findings):
        with pytest.raises(DesignError):
            FAMILY.parts(params)
        return
    for part in FAMILY.parts(params):
        if part.outline is not None:
            polygon = part.outline.polygon()
            # All holes are inside, and none touches another one.
            assert polygon.is_valid
            assert polygon.area == pytest.approx(part.outline.area, rel=1e-3)
            assert len(polygon.interiors) == len(part.outline.inner)
