"""A four-bar that is set to several phases: one coupler with a hole for each pivot of each phase."""

import json
import math
import tomllib
from pathlib import Path

import numpy as np
import pytest
from designed import designed
from pydantic import ValidationError

from mechwright.contracts.finding import errors
from mechwright.designs.text import table_lines
from mechwright_cad.interference import interference_findings
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.phases import in_phase, set_joints, settings_of

FACTS = {
    fact["name"]: fact
    for fact in json.loads(
        (Path(__file__).parents[1] / "data" / "adjustable.json").read_text(encoding="utf-8")
    )["facts"]
}
TURNS = ({"crank_turn": 25, "follower_turn": 14}, {"crank_turn": -35, "follower_turn": 9})


def reference(**changes) -> FourBarParams:
    """The reference mechanism: all phases are crank-rockers."""
    table = {
        "crank": 30, "coupler": 95, "follower": 80, "ground": abs(100 + 10j),
        "ground_angle": math.degrees(math.atan2(10, 100)), "coupler_point_x": 45, "coupler_point_y": 40,
        "setting_angle": 70, "phases": TURNS, **changes,
    }  # fmt: skip
    return FourBarParams.model_validate(table)


def small(**changes) -> FourBarParams:
    """With pins that leave room between the holes."""
    return reference(**({"pin_diameter": 3, "rim": 2, "bushing_wall": 0.5} | changes))


def test_phases_are_written_and_read_back():
    """A list of tables in a design file."""
    text = "\n".join(table_lines(FourBarParams, "parameters", reference(phase=2)))
    assert FourBarParams.model_validate(tomllib.loads(text)["parameters"]) == reference(phase=2)


@pytest.mark.parametrize("phase", [1, 2, 3])
def test_each_phase_has_the_coupler_of_the_reference(phase):
    shown = in_phase(reference(phase=phase))
    expected = FACTS[f"adjust.planar4.phase{phase}.L_px_py"]["expected"]
    assert [shown.coupler, shown.coupler_point_x, shown.coupler_point_y] == pytest.approx(expected, abs=1e-9)
    assert shown.branch == "open"


@pytest.mark.parametrize("phase", [1, 2, 3])
def test_the_coupler_point_passes_the_reference_points(phase):
    fact = FACTS["adjust.planar4.three.points"]
    motion = FourBars().solve(reference(phase=phase), 3601)
    phi = np.unwrap(motion.channels["phi"].values)
    for degrees, point in zip(
        fact["inputs"]["crank_deg"][phase - 1], fact["expected"][phase - 1], strict=True
    ):
        angle = (math.radians(degrees) - phi[0]) % math.tau + phi[0]
        place = [np.interp(angle, phi, motion.channels[name].values) for name in ("xP", "yP")]
        assert place == pytest.approx(point, abs=1e-3)


def test_the_coupler_is_the_same_plate_in_all_phases():
    plates = []
    for phase in (1, 2, 3):
        parts = {part.name: part for part in FourBars().parts(small(phase=phase))}
        outline = parts["coupler"].outline
        plates.append((outline.area, outline.outer.area, len(outline.inner)))
        assert len(parts["bushing"].instances) == 7  # the follower turns on one as well
    for plate in plates[1:]:
        assert plate == pytest.approx(plates[0], rel=1e-9)
    assert plates[0][2] == 7  # A and B three times, and the point


def test_the_chords_of_the_holes_are_told():
    notes = [one for one in FourBars().check(small()) if one.code == "four-bar.setting"]
    assert len(notes) == 2
    assert "12.99 mm (A) and 19.5 mm (B)" in notes[0].message
    assert "18.04 mm (A) and 12.55 mm (B)" in notes[1].message
    assert not errors(FourBars().check(small()))


def test_every_phase_is_looked_at_for_interference():
    family = FourBars()
    for phase in (1, 2, 3):
        params = small(phase=phase)
        others = family.settings(params)
        assert list(others) == [f"phase = {one}" for one in (1, 2, 3) if one != phase]
        found = interference_findings(designed(family, params), family.parts(params), solids=False)
        (note,) = [one for one in found if one.code == "interference.settings"]
        assert all(name in note.message for name in others)
    assert family.settings(FourBarParams()) == {}


NEAR = ({"crank_turn": 12, "follower_turn": 14}, {"crank_turn": -9, "follower_turn": -6})


def clamped(**changes) -> FourBarParams:
    """Phases so near to each other that pins of 6 mm leave no land between holes."""
    return reference(**({"phases": NEAR, "rim": 3, "clearance": 0.5, "speed": 30} | changes))


def test_near_places_are_set_in_arc_slots_about_a0_and_b0():
    params = clamped()
    assert not errors(FourBars().check(params))
    ways = set_joints(params)
    a, b = ways["A"].slot, ways["B"].slot
    assert (a.radius, b.radius) == pytest.approx((30, 80))
    assert (math.degrees(a.sweep), math.degrees(b.sweep)) == pytest.approx((21, 20))
    for one, places in settings_of(params):
        assert max(one.slot.distance(place) for place in places) < 1e-9
    parts = {part.name: part for part in FourBars().parts(params)}
    assert sorted(len(loop.segments) for loop in parts["coupler"].outline.inner) == [1, 4, 4]
    assert [detail.name for detail in parts["coupler"].details] == ["scale-a", "scale-b"]
    assert parts["clamp-screw"].bought.standard == "ISO 4762"
    # The studs turn on bushings of crank and follower, and their heads lie below these.
    assert {one.body for one in parts["bushing"].instances} >= {"crank-a", "follower-b"}
    head = parts["pin-a"].turned.steps[0].length
    assert parts["pin-a"].instances[0].z + head == pytest.approx(parts["crank"].instances[0].z)
    assert parts["coupler"].instances[0].z > parts["follower"].instances[0].z
    said = [one.message for one in FourBars().check(params) if one.code == "four-bar.setting"]
    assert "2. loosen the clamp of A, turn the crank by +12 degrees to 82 and fasten A" in said[0]


def test_the_plates_of_a_clamped_machine_are_the_same_in_all_phases():
    found = []
    for phase in (1, 2, 3):
        parts = {part.name: part for part in FourBars().parts(clamped(phase=phase))}
        plates = {name: part for name, part in parts.items() if part.outline is not None}
        found.append({
            name: (part.outline.area, part.outline.outer.area, part.instances[0].z)
            for name, part in plates.items()
        })  # fmt: skip
    for other in found[1:]:
        for name, sizes in found[0].items():
            assert other[name] == pytest.approx(sizes, rel=1e-9), name


def test_slots_that_leave_no_land_to_the_point_are_refused():
    found = errors(FourBars().check(clamped(coupler_point_x=1, coupler_point_y=7)))
    assert [one.code for one in found] == ["four-bar.phases"]
    assert found[0].value < found[0].limit
    assert "pivots in one place" in found[0].message


def test_pins_too_thin_for_a_clamp_are_refused_with_those_that_are_not():
    close_by = ({"crank_turn": 5, "follower_turn": 4},)
    found = errors(FourBars().check(small(phases=close_by)))
    assert [one.code for one in found] == ["four-bar.phases"]
    assert "no screw clamps a stud of 3 mm" in found[0].message
    change = {key.removeprefix("parameters."): value for key, value in found[0].proposed[0].items()}
    assert not errors(FourBars().check(small(phases=close_by, **change)))


def test_a_second_ground_plate_over_clamps_is_refused():
    found = errors(FourBars().check(clamped(frame="two")))
    assert [one.code for one in found] == ["four-bar.layers"]


def test_an_equal_pivot_is_one_hole():
    phases = ({"crank_turn": 0, "follower_turn": 20},)
    parts = {part.name: part for part in FourBars().parts(small(phases=phases))}
    assert len(parts["coupler"].outline.inner) == 4


def test_a_pose_in_which_the_links_cannot_be_joined_is_refused():
    found = errors(FourBars().check(reference(crank=100, coupler=60, setting_angle=190)))
    assert [one.code for one in found] == ["four-bar.setting"]


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"setting_angle": None}, "setting_angle"),
        ({"phase": 4}, "phase is 4"),
        ({"coupler_bend": 10, "coupler_point_x": None, "coupler_point_y": None}, "coupler_bend"),
    ],
)
def test_what_does_not_go_together_is_refused(changes, word):
    with pytest.raises(ValidationError, match=word):
        reference(**changes)
