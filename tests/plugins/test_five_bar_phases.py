"""A five-bar that is set to several phases: the same plates, other places of A and C, another offset."""

import cmath
import math

import numpy as np
import pytest
from five_bar_reference import FACTS, NEAR, POINTS, reference
from pydantic import ValidationError

from mechwright.contracts.finding import errors
from mechwright_five_bar.family import FiveBars
from mechwright_five_bar.kinematics.dimensions import bar_of
from mechwright_five_bar.kinematics.phases import in_phase, phases_of, set_joints, settings_of
from mechwright_five_bar.parts import parts
from mechwright_five_bar.parts.hub import hub_of
from mechwright_five_bar.parts.layout import poses_of, screw_places
from mechwright_five_bar.parts.parts import parts_of
from mechwright_five_bar.rules.clamps import ORDER
from mechwright_five_bar.table import FiveBarTable

FAMILY = FiveBars()


@pytest.mark.parametrize("phase", [1, 2, 3])
def test_each_phase_has_offset_and_coupler_of_the_reference(phase):
    shown = in_phase(reference(phase=phase))
    expected = FACTS[f"adjust.planar5.phase{phase}.off_L_px_py"]["expected"]
    found = [shown.arm_angle, shown.coupler, shown.coupler_point_x, shown.coupler_point_y]
    assert found == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("phase", [1, 2, 3])
def test_the_coupler_point_passes_the_reference_points(phase):
    shown = in_phase(reference(phase=phase))
    bodies = bar_of(shown).at(np.radians(POINTS["inputs"]["crank_deg"][phase - 1])).bodies
    found = bodies["coupler"].point(shown.coupler_point).position
    expected = [complex(*point) for point in POINTS["expected"][phase - 1]]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9)


def test_showing_a_phase_and_then_the_first_again_changes_nothing():
    params = reference(phase=2)
    again = phases_of(in_phase(params))
    assert {round(one.arm_angle, 9) for one in again} == {3.5, -4.0, 9.5}
    first = next(one for one in again if abs(one.arm_angle - 3.5) < 1e-9)
    for name in ("coupler", "coupler_point_x", "coupler_point_y", "setting_angle", "swing_from", "swing_to"):
        assert getattr(first, name) == pytest.approx(getattr(params, name), abs=1e-9)


def test_the_plates_are_the_same_in_all_phases():
    for phases in (reference().phases, reference(phases=NEAR).phases):
        found = []
        for phase in (1, 2, 3):
            params = in_phase(reference(phases=phases, phase=phase))
            layout = FiveBarTable.of(params).layout
            found.append((
                layout.stack.layer,
                {name: (one.area, len(one.inner), one.outer.area) for name, one in layout.outlines.items()},
                layout.heights,
            ))  # fmt: skip
        for other in found[1:]:
            assert other[0] == found[0][0]
            assert other[2] == pytest.approx(found[0][2])
            for name, sizes in found[0][1].items():
                assert other[1][name] == pytest.approx(sizes, rel=1e-6), name


def test_the_coupler_of_every_phase_stands_where_its_joints_are():
    params = in_phase(reference(phases=NEAR))
    for number, shown in enumerate(phases_of(params)):
        poses = poses_of(params, FiveBarTable.of(shown), number)["coupler"]
        course = np.linspace(0, 1, poses.position.shape[0])
        swing = np.radians(shown.swing_from + (shown.swing_to - shown.swing_from) * course)
        bar = bar_of(shown)
        bodies = bar.at(swing).bodies
        joints = (bodies["crank"].point(bar.crank).position, bodies["rocker"].point(bar.rocker).position)
        for (_, places), joint in zip(settings_of(params), joints, strict=True):
            at = poses.transform(np.array([[places[number].real, places[number].imag, 0.0]]))[:, 0]
            np.testing.assert_allclose(at[:, 0] + 1j * at[:, 1], joint, rtol=0, atol=1e-8)


def test_places_that_are_near_are_set_in_arc_slots_about_a0_and_b1():
    params = reference(phases=NEAR)
    ways = set_joints(params)
    a, c = ways["A"].slot, ways["C"].slot
    assert (a.radius, c.radius) == pytest.approx((100, 130))
    assert (math.degrees(a.sweep), math.degrees(c.sweep)) == pytest.approx((10, 12))
    for one, places in settings_of(params):
        assert max(one.slot.distance(place) for place in places) < 1e-9
    parts = {part.name: part for part in parts_of(FiveBarTable.of(params))}
    assert {part.bought.standard for part in parts.values() if part.bought} == {"ISO 4762", "ISO 7089"}
    assert len(parts["clamp-screw"].instances) == len(parts["clamp-washer"].instances) == 2
    # The point alone has a bore; the studs turn in crank and rocker.
    arcs = [len(loop.segments) for loop in parts["coupler"].outline.inner]
    assert sorted(arcs) == [1, 4, 4]
    (scale_a, scale_c) = parts["coupler"].details
    assert min(len(scale_a.strokes), len(scale_c.strokes)) > 3


@pytest.mark.parametrize("angle", [83.0, 90.0, -90.0])
def test_marks_stand_at_the_angles_that_are_written_beside_them(monkeypatch, angle):
    seen = []
    monkeypatch.setattr(
        parts, "scale", lambda _, slot, places, written, __: seen.append((slot, places, written))
    )
    phases = ({"crank_turn": 6, "rocker_turn": 11}, {"crank_turn": -4, "rocker_turn": -5})
    params = in_phase(reference(phases=phases, setting_angle=angle))
    seen.clear()  # the width of its gears, left out, follows from what stands in its plates
    parts.scales(params)
    rocker = bar_of(params).at(math.radians(angle)).bodies["rocker"]
    arms = (cmath.rect(1, math.radians(angle)), rocker.turning.direction.item())
    turns = ([0, 6, -4], [0, 11, -5])
    for (slot, places, written), arm, turn in zip(seen, arms, turns, strict=True):
        assert max(abs(one) for one in written) <= 180
        along = np.array(places) - slot.centre
        # The coupler carries its slots, and lies at one angle while both are set.
        np.testing.assert_allclose(np.angle(along / along[0]), np.radians(turn), atol=1e-9)
        turned = np.exp(1j * np.radians(written)) / (arm / abs(arm))
        np.testing.assert_allclose(np.angle(turned), np.radians(turn), atol=1e-9)


def test_studs_reach_from_their_heads_to_the_coupler():
    params = reference(phases=NEAR)
    layout, parts = (
        FiveBarTable.of(params).layout,
        {part.name: part for part in parts_of(FiveBarTable.of(params))},
    )
    for pin, link in (("pin-a", "crank"), ("pin-c", "rocker")):
        stud, (instance,) = parts[pin], parts[pin].instances
        head = stud.turned.steps[0].length
        assert instance.z + head == pytest.approx(layout.heights[link])
        assert instance.z + stud.turned.length == pytest.approx(layout.heights["coupler"])
        screw = parts["clamp-screw"].bought.designation
        deep = float(screw.split(" x ")[1].split(" ")[0]) - params.thickness - 1.0
        assert stud.turned.steps[0].length + stud.turned.steps[1].length >= deep >= 5


def test_the_screws_of_the_gear_lie_in_its_slots_in_every_phase():
    params = in_phase(reference())
    hub = hub_of(params)
    for angle in hub.angles:
        for place, slot in zip(screw_places(hub), hub.slots, strict=True):
            turned = place * complex(math.cos(angle), math.sin(angle))
            assert slot.distance(turned) < 1e-9
    assert math.degrees(hub.sweep) == pytest.approx(13.5)  # half of the crank's 27 degrees
    assert hub_of(reference(phases=({"rocker_turn": 20},))) is None


def test_the_order_of_setting_is_told_with_angles_and_distances():
    notes = list(ORDER.inspect(FiveBarTable.of(reference(phases=NEAR))))
    assert len(notes) == 2
    assert "3. loosen the clamp of A, turn the crank by +6 degrees to 89 and fasten A" in notes[0].message
    assert "10.47 mm (A) and 20.4 mm (C)" in notes[0].message
    holes = [one.message for one in ORDER.inspect(FiveBarTable.of(reference()))]
    assert "3. take A out of its hole, turn the crank by +15 degrees to 98" in holes[0]


def test_what_leaves_no_room_for_slots_is_refused_with_what_helps():
    found = errors(
        FAMILY.check(reference(phases=NEAR, coupler_point_x=6, coupler_point_y=8, pin_diameter=8, rim=4))
    )
    assert [one.code for one in found] == ["five-bar.phases"]
    assert found[0].value < found[0].limit
    thin = errors(FAMILY.check(reference(phases=({"crank_turn": 1, "rocker_turn": 1},), pin_diameter=4)))
    assert thin[0].parameter == "pin_diameter"
    assert "no screw clamps" in thin[0].message
    mended = reference(phases=({"crank_turn": 1, "rocker_turn": 1},), **{
        key.removeprefix("parameters."): value for key, value in thin[0].proposed[0].items()
    })  # fmt: skip
    assert "pin_diameter" not in [one.parameter for one in errors(FAMILY.check(mended))]


def test_a_phase_that_does_not_reach_its_swing_is_refused():
    far = ({"crank_turn": -12, "rocker_turn": 11, "swing_from": 71, "swing_to": -150},)
    found = errors(FAMILY.check(reference(phases=far)))
    assert [one.code for one in found] == ["five-bar.swing"]
    assert found[0].parameter == "phases"


def test_a_pose_in_which_the_links_cannot_be_joined_is_refused():
    found = errors(FAMILY.check(reference(setting_angle=180)))
    assert [one.code for one in found] == ["five-bar.setting"]


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"setting_angle": None}, "setting_angle"),
        ({"phase": 4}, "phase is 4"),
        ({"swing_to": None}, "swing_to"),
    ],
)
def test_what_does_not_go_together_is_refused(changes, word):
    with pytest.raises(ValidationError, match=word):
        reference(**changes)
