"""Sectors: laws over less than a turn, against closed forms, and their outlines run against each other."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from mechwright.contracts.finding import Severity, Stage, errors
from mechwright.geometry.segments import Arc, Line
from mechwright.mechanics.gearing import SectorTeeth, prove_mesh
from mechwright_noncircular_gears.family import NoncircularGears
from mechwright_noncircular_gears.kinematics.law import extremes_of, law_of
from mechwright_noncircular_gears.kinematics.laws.sector import SectorLaw
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.table import table_of

FAMILY = NoncircularGears()

SPIRAL = {"law": "spiral", "sector": 120, "teeth": 20, "bore": 6}
WAVE = {"law": "ratio", "ratio": "1+0.3*sin(phi)", "sector": 200, "teeth": 30, "tooth_offset": 0.3, "bore": 6}
FAR = {"law": "spiral", "sector": 300, "teeth": 40, "first_ratio": 0.5, "last_ratio": 0.9, "bore": 6}
NODES = [[30.0 * k, 24.0 * k + 6 * math.sin(math.radians(36 * k))] for k in range(6)]
TABLE = {"law": "table", "sector": 150, "nodes": NODES, "teeth": 30, "bore": 6}
ANGLE = {"law": "angle", "angle": "2 + phi + 0.2*phi^2", "sector": 90, "teeth": 18, "bore": 6}
ALL = {"spiral": SPIRAL, "wave": WAVE, "far": FAR, "table": TABLE, "angle": ANGLE}


def design(table: dict[str, object], **changes: object) -> SizedParams:
    return SizedParams.model_validate({**table, **changes})


def sector_law(params: SizedParams) -> SectorLaw:
    law = law_of(params)
    assert isinstance(law, SectorLaw)
    return law


def test_a_spiral_has_the_least_travel_for_its_slope() -> None:
    """dφ = ln[i_b (1 + i_a)/(i_a (1 + i_b))]/tan ν: from 0.5 to 2 at 30 degrees in 1.20057 rad."""
    degrees = math.degrees(math.log(2) / math.tan(math.radians(30)))
    params = design(SPIRAL, sector=degrees, first_ratio=0.5, last_ratio=2)
    assert math.radians(degrees) == pytest.approx(1.20057, abs=1e-5)
    assert extremes_of(params).steepest.value == pytest.approx(math.radians(30), abs=1e-12)
    phi = np.linspace(0, math.radians(degrees), 50)
    frame = table_of(params).pair.driver.frame(-phi)
    # ρ = r √(1 + c²), the tangent's slope is the same all along, the radius an exponential.
    c = math.tan(math.radians(30))
    assert frame.radius == pytest.approx(frame.polar_radius * math.sqrt(1 + c * c), rel=1e-11)
    assert frame.polar_radius == pytest.approx(frame.polar_radius[0] * np.exp(c * phi), rel=1e-12)


def test_the_mates_arc_and_turn_are_those_of_the_law() -> None:
    """ψ of a formula in closed form; teeth over the travel are counted on an arc in closed form."""
    params = design(ANGLE)
    law, travel = sector_law(params), math.radians(90)
    phi = np.linspace(0, travel, 41)
    assert law.angle(phi) == pytest.approx(phi + 0.2 * phi**2, rel=1e-13, abs=1e-14)
    spiral = design(SPIRAL)
    c = sector_law(spiral).course.slope  # type: ignore[attr-defined]
    q0, q1 = 0.7 / 1.7, 1.4 / 2.4
    arc = table_of(spiral).pair.distance * math.sqrt(1 + c * c) / c * (q1 - q0)
    assert arc == pytest.approx(20 * table_of(spiral).rack.pitch, rel=1e-12)


@pytest.mark.parametrize("table", ALL.values(), ids=ALL)
def test_the_law_goes_on_smoothly_beyond_its_ends(table: dict[str, object]) -> None:
    law = sector_law(design(table))
    for edge in law.breaks:
        before, after = (law.rates(np.array(edge + way)) for way in (-1e-8, 1e-8))
        for one, two in zip(before, after, strict=True):
            assert abs(float(one - two)) < 1e-5
    around = np.linspace(-2, law.end + 2, 2001)
    assert law.rates(around)[0].min() > 0.2 * law.rates(law.grid(401))[0].min()


@pytest.mark.parametrize("table", ALL.values(), ids=ALL)
def test_sectors_mesh_over_their_travel(table: dict[str, object]) -> None:
    """At every position, both ends included, flanks of both sides meet; the exact motion to 5 µrad."""
    params = design(table)
    assert [one for one in FAMILY.check(params) if one.severity is not Severity.NOTE] == []
    found = table_of(params).proof()
    assert not found.collides
    assert found.mesh.overlap == 0
    assert np.isfinite(found.mesh.ahead).all()
    assert np.isfinite(found.mesh.behind).all()
    assert found.error < 5e-6
    assert found.mesh.angles[0][[0, -1]] == pytest.approx([0, math.radians(params.sector or 0)], abs=1e-12)


def test_a_sector_set_wrongly_collides() -> None:
    """The proof is no formality: a law that is off by a twentieth of a pitch runs into its mate."""
    params = design(SPIRAL)
    one, two = table_of(params).outlines
    cos, sin = math.cos(0.02), math.sin(0.02)
    turned = two.outer.flatten(1e-4) @ np.array([[cos, sin], [-sin, cos]])
    proof = prove_mesh(
        table_of(params).pair, table_of(params).rack, 20, (one.outer.flatten(1e-4), turned), 1e-3
    )
    assert proof.collides


@given(st.floats(0, 0.999), st.integers(8, 40))
@settings(deadline=None, max_examples=20)
def test_both_have_the_teeth_that_meet(offset: float, teeth: int) -> None:
    """Within half a pitch of each end, every flank of the driver has a tooth of the mate."""
    params = design(SPIRAL, tooth_offset=offset, teeth=teeth, bore=0)
    driver, driven = table_of(params).teeth
    assert isinstance(driver, SectorTeeth)
    p = driver.rack.pitch
    one = -driver.tooth_arcs[1:] / p
    two = driven.tooth_arcs[1:] / p
    for middles in (one, two):
        assert middles.min() >= -0.75 - 1e-6
        assert middles.max() <= teeth + 0.75 + 1e-6
        assert middles.max() >= teeth - 0.25 - 1e-6
    for flanks in (-driver.meeting_arcs / p).T:
        for end in (0, teeth):
            assert np.nanmin(np.abs(flanks - end)) < 0.51
    for sign in (-1, 1):
        meets = one[:, None] + sign / 2 - two
        assert np.abs(meets).min(axis=1)[1:-1].max() < 1e-6


def test_the_blank_is_drawn_taut_around_the_hub() -> None:
    hub = table_of(design(SPIRAL, sector_hub=20)).outlines[0].outer.segments[-3:]
    assert [type(one) for one in hub] == [Line, Arc, Line]
    side, arc, _ = hub
    assert isinstance(arc, Arc)
    assert arc.radius == 10
    way = np.subtract(side.end, side.start)
    assert abs(float(np.dot(way, side.end))) < 1e-9 * float(np.hypot(*way)) * 10  # it touches the hub
    chord = table_of(design(FAR)).outlines[0].outer.segments[-1]
    assert isinstance(chord, Line)
    assert chord.tag == "side"


def test_a_swing_there_and_back() -> None:
    params = design(SPIRAL)
    motion = FAMILY.solve(params, 1441)
    travel, law = math.radians(120), sector_law(params)
    assert motion["theta1"].max() == pytest.approx(travel, rel=1e-12)
    assert motion["theta1"][[0, -1]] == pytest.approx([0, 0], abs=1e-12)
    assert motion["theta2"].min() == pytest.approx(-law.turned, rel=1e-9)
    time = motion["time"]
    for rate, value in (("omega2", "theta2"), ("alpha2", "omega2"), ("jerk2", "alpha2")):
        slope = (motion[value][2:] - motion[value][:-2]) / (time[2:] - time[:-2])
        most = np.abs(motion[rate]).max()
        assert np.abs(slope - motion[rate][1:-1]).max() < 1e-4 * most
        assert motion.scalars[f"{rate}_max"].value == pytest.approx(most, rel=1e-4)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"law": "fourier", "sector": 90}, "goes all the way round"),
        ({"law": "spiral"}, "does not close; set sector"),
        ({**SPIRAL, "mate_lobes": 2}, "have no lobes"),
        ({**SPIRAL, "mate_lobes": 2, "internal": True}, "have no lobes"),
        ({"sector_hub": 20}, "sector_hub is for sectors"),
        ({**TABLE, "sector": 160}, "set sector = 150"),
        ({**TABLE, "sector": 60, "nodes": NODES[:3]}, "too few"),
        ({**SPIRAL, "sector": 400}, "in the way of the mate at the next; make it 330 at most"),
    ],
)
def test_tables_that_are_no_sectors(changes: dict[str, object], said: str) -> None:
    with pytest.raises(ValidationError, match=said):
        SizedParams.model_validate(changes)


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"law": "ratio", "ratio": "1.6", "sector": 300, "teeth": 40}, "law.sector"),
        ({"law": "spiral", "sector": 320, "first_ratio": 1, "last_ratio": 1, "teeth": 8}, "sector.extent"),
        ({**SPIRAL, "sector_hub": 120}, "sector.hub"),
        ({**SPIRAL, "sector_hub": 7}, "sector.hub"),
        ({"law": "ratio", "ratio": "0.5-0.4*phi", "sector": 120}, "law.turns-back"),
        ({"law": "ratio", "ratio": "1+0.5*sqrt((phi-1)^2)", "sector": 120}, "law.corner"),
        ({"law": "ratio", "ratio": "1/(1-phi)", "sector": 120}, "law.corner"),
        ({"law": "ratio", "ratio": "log(phi-0.1)", "sector": 120}, "law.formula"),
        (
            {"law": "ratio", "ratio": "1+0.4*sin(4*phi)", "sector": 150, "teeth": 30, "cutter": "rack"},
            "gear.convexity",
        ),
        ({"law": "spiral", "sector": 200, "teeth": 6, "bore": 0}, "gear.undercut"),
    ],
)
def test_findings_of_sectors(changes: dict[str, object], code: str) -> None:
    """By name; where there is a change, one of them gets past it."""
    params = SizedParams.model_validate({"bore": 6, **changes})
    wrong = errors(FAMILY.check(params), Stage.PARTS)[0]
    assert wrong.code == code
    assert wrong.remedy
    if code in {"law.corner", "law.formula"}:
        return
    assert wrong.proposed
    passed = []
    for change in wrong.proposed:
        own = {key.removeprefix("parameters."): value for key, value in change.items()}
        mended = SizedParams.model_validate({**params.model_dump(), **own})
        passed.append(code not in [one.code for one in errors(FAMILY.judge(mended), Stage.PARTS)])
    assert any(passed)


def test_sectors_are_a_stage_that_swings() -> None:
    """A driven swing loads them as their own that is as fast and speeds up as much."""
    stage = FAMILY.transmission(design(SPIRAL, speed=30))
    half = math.radians(60)
    assert stage.travel == pytest.approx((0, 2 * half))
    _, own = stage.at(np.linspace(0, math.tau, 721))
    assert [own.theta.min(), own.theta.max()] == pytest.approx([0, 2 * half], abs=1e-12)
    assert stage.driven_fields(own)["speed"] == pytest.approx(30, rel=1e-6)


def test_tabs_stand_apart() -> None:
    """On the sides of a sector that has two, on tips all round where it has one."""
    for table, on_sides in ((SPIRAL, True), (FAR, False)):
        part = FAMILY.parts(design(table))[0]
        (outside,) = (one for one in part.machined or () if one.name == "outside")
        sites = sorted(outside.tab_sites, key=lambda one: -one[1])[:4]  # type: ignore[union-attr]
        widest = sites[3][1]
        places = [place for place, width in outside.tab_sites if width >= widest]  # type: ignore[union-attr]
        assert (len(places) == 4) is on_sides
        apart = max(math.dist(one, two) for one in places for two in places)
        assert apart > 60


def test_how_far_sectors_may_pass_their_ends_is_told() -> None:
    """Half a pitch of arc: from the end of the travel on, the arc over that angle is found again."""
    params = design(SPIRAL)
    (told,) = (one for one in FAMILY.check(params) if one.code == "sector.stops")
    driver, end = table_of(params).pair.driver, math.radians(120)
    half = math.radians(told.value)
    arcs = [driver.arc(-np.array([at, at + step])) for at, step in ((0, -half), (end, half))]
    farthest = max(abs(float(np.diff(one)[0])) for one in arcs)
    assert farthest == pytest.approx(table_of(params).pair.pitch(20) / 2, rel=0.05)
