"""A train whose phase is set on the machine: its kinematics, holes, load, play, and one machine for all phases."""

import dataclasses
import json
import math
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from designed import designed
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from mechwright.contracts.finding import Finding, Severity, Stage, errors
from mechwright.contracts.holes import joined
from mechwright.contracts.procedure import Procedure
from mechwright.contracts.rule_list import all_of
from mechwright.designs.design import load
from mechwright.plugins.host import host
from mechwright_cad.interference import interference, interference_findings, smooth_motion
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.kinematics.equations import Turning, phase_offset, train
from mechwright_elliptic_gears.kinematics.figures import point_peaks, point_window
from mechwright_elliptic_gears.kinematics.joint_load import Masses, joint_torque
from mechwright_elliptic_gears.kinematics.peak import peak
from mechwright_elliptic_gears.kinematics.point import speed_of_q
from mechwright_elliptic_gears.parts.dividing import PITCH, START, direction, phases_that_work, placed
from mechwright_elliptic_gears.parts.gear_parts import gears_of
from mechwright_elliptic_gears.parts.layout import dividing_of

FAMILY = EllipticGears()
Params = EllipticGears.Params
ROOT = Path(__file__).parents[2]
VARIABLE = load(ROOT / "examples" / "figure-eight-variable.toml", host()).params
PINS = {"stages": 2, "bore": 12.0, "phase_joint": "pins"}
PRINTED = json.loads((ROOT / "docs" / "seeds" / "elliptic-gears.json").read_text())

# e = 0.4, a = 50 mm, ω2 = 10 rad/s: joint angle (degrees) and its rate, greatest and least speed, greatest
# acceleration, window of 10 mm/s (length, start), torque over J5 and greatest α5, speeds at θ2 = 1, 3, 5.
REFERENCE = {
    0: (0.0, 2.3333333333, 945.1288911, 48.9795918, 70172.8395, 1.3334315, 2.475, 1809.4290286, 940.7945606,
        (316.5923519956, 49.3954853523, 200.3490286546)),
    45: (88.0479824095, 1.4133928987, 937.9631688, 120.3730137, 31868.6980, 1.7578956, 3.272, 895.7388853,
         398.2671980, (396.8329999673, 140.3298319836, 129.8381639103)),
    90: (133.6028189727, 0.7241379310, 701.5315440, 184.5256197, 13710.5075, 2.2036527, 1.886, 274.0661488,
         117.6854860, (488.2147521064, 191.3090793811, 240.1340778369)),
    135: (159.8674285678, 0.4867631075, 551.1278590, 127.3484105, 13070.7531, 0.5380850, 2.243, 86.9233601,
          37.2600451, (493.7380982094, 150.7552172079, 320.4711278518)),
    180: (180.0, 0.4285714286, 444.5751442, 114.2857143, 12888.8889, 0.5532694, 2.865, 0.0, 0.0,
          (425.0093934467, 116.9762786750, 377.2919532666)),
}  # fmt: skip
JOINT = {
    0.2: (63.707050, 112.619865, 149.125830),
    0.4: (88.047982, 133.602819, 159.867429),
    0.6: (117.773553, 151.927513, 168.175800),
    0.8: (149.968274, 167.319617, 174.729788),
}
"""φ, degrees, for γ = 45, 90, 135."""


def at(phase, **table):
    return VARIABLE.model_copy(update={"phase": float(phase), **table})


@pytest.mark.parametrize("e", JOINT)
def test_the_joint_stands_at_phi_of_gamma(e):
    assert [math.degrees(phase_offset(math.radians(g), e)) for g in (45, 90, 135)] == pytest.approx(
        JOINT[e], abs=1e-6
    )
    k = (1 + e) / (1 - e)
    for g in (10, 77, 160):
        assert math.degrees(direction(g, e) - START) == pytest.approx(
            2 * math.degrees(math.atan(k * math.tan(math.radians(g) / 2))), abs=1e-9
        )


def test_equal_steps_of_the_joint_are_uneven_phases():
    gammas = [2 * math.degrees(math.atan(math.tan(math.radians(15 * i)) * 0.6 / 1.4)) for i in range(6)]
    assert gammas == pytest.approx([0, 13.1018, 27.7958, 46.3972, 73.1736, 115.9715], abs=1e-4)
    found = [math.degrees(direction(g, 0.4) - START) for g in gammas]
    assert found == pytest.approx([30.0 * i for i in range(6)], abs=1e-9)


@pytest.mark.parametrize("phase", REFERENCE)
def test_one_machine_runs_as_the_reference_at_every_phase(phase):
    joint, rate, v_max, v_min, a_max, window, start, torque, alpha5, speeds = REFERENCE[phase]
    params, gamma = at(phase), math.radians(phase)
    assert math.degrees(phase_offset(gamma, 0.4)) == pytest.approx(joint, abs=1e-9)
    slope = (phase_offset(gamma + 1e-5, 0.4) - phase_offset(gamma - 1e-5, 0.4)) / 2e-5
    assert slope == pytest.approx(rate, rel=1e-6)
    tops = point_peaks(params)
    assert (tops["speed"].value, tops["acceleration"].value) == pytest.approx((v_max, a_max), rel=1e-8)
    assert -peak(lambda t: -500 * speed_of_q(t, 0.4, gamma)).value == pytest.approx(v_min, rel=1e-7)
    found = point_window(params)
    assert found.length == pytest.approx(window, abs=6e-4)
    assert found.start == pytest.approx(start, abs=1e-3)
    assert 500 * speed_of_q(np.array([1.0, 3.0, 5.0]), 0.4, gamma) == pytest.approx(speeds, abs=1e-7)
    alone = Masses(1e6, 0.0, 0.0, 0.5 + 0j)  # 1 kg m²
    behind = peak(lambda t: np.abs(joint_torque(t, params, gamma, alone, driver=False)))
    assert behind.value == pytest.approx(torque, rel=1e-7, abs=1e-6)
    five = peak(lambda t: np.abs(train(Turning.of(t, 10.0), 0.4, gamma)[2].alpha))
    assert five.value == pytest.approx(alpha5, rel=1e-7, abs=1e-6)


def test_five_rows_of_both_tables_come_from_one_machine():
    cells = {cell["phase"]: cell for cell in PRINTED["cells"] if cell["eccentricity"] == 0.4}
    assert sorted(cells) == list(VARIABLE.set_phases) == list(REFERENCE)
    machine = drawn(VARIABLE)
    for phase, cell in cells.items():
        params = at(phase)
        assert drawn(params) == machine
        figures = FAMILY.solve(params, 3).scalars
        assert figures["Q.speed.max"].value == pytest.approx(cell["speed"], rel=2e-4)
        assert figures["Q.acceleration.max"].value == pytest.approx(1000 * cell["acceleration"], rel=2e-3)
        length = figures["Q.constant_speed_window.length"].value
        if cell["window"] is None:
            assert length < 0.93
        else:
            start, end = cell["window"][:2]
            found = figures["Q.constant_speed_window.start"].value
            assert (found, found + length) == pytest.approx((start, end), abs=0.03)


def drawn(params):
    """All that is made or bought: plates with their features, solids by mass and box."""
    found = {}
    for part in FAMILY.parts(params):
        places = sorted((instance.body, instance.z) for instance in part.instances)
        if part.build is None:
            shape = (part.outline, part.features, part.details)
        else:
            solid = part.build()
            box = solid.BoundingBox()
            shape = tuple(
                round(number, 9)
                for number in (solid.Volume(), box.xmin, box.xmax, box.ymin, box.ymax, box.zmax)
            )
        found[part.name] = (part.thickness, part.material, places, shape)
    return found


def test_a_fixed_joint_is_another_machine_for_each_phase():
    fixed = VARIABLE.model_copy(update={"phase_joint": None, "phases": None})
    assert drawn(fixed) != drawn(fixed.model_copy(update={"phase": 45.0}))


@pytest.mark.parametrize("phase", REFERENCE)
def test_the_pin_stands_in_a_hole_of_both_gears_at_all_times(phase):
    params = at(phase)
    motion = FAMILY.solve(params, 13)
    holes = {
        body: np.array([(*hole.centre, 0.0) for hole in gear.holes if hole.name != "joint"])
        for gear in gears_of(params)
        for body, _ in gear.bodies
    }
    pin = motion.poses["phase-pin"].position
    for body in ("gear-3", "gear-4"):
        there = motion.poses[body].transform(holes[body])
        away = np.linalg.norm(there - pin[:, None, :], axis=-1)
        assert (away.min(axis=1) < 1e-9).all()
        # It is the same hole throughout.
        assert len(set(away.argmin(axis=1).tolist())) == 1


@pytest.mark.parametrize("phase", REFERENCE)
def test_nothing_collides_at_any_phase(phase):
    params = at(phase)
    parts = FAMILY.parts(params)
    report = interference(parts, smooth_motion(partial(FAMILY.solve, params), parts), solids=False)
    assert report.clear, report.collisions
    assert {finding.severity for finding in FAMILY.check(params)} == {Severity.NOTE}


@pytest.mark.parametrize("joint", ["pins", "clamp"])
def test_every_phase_of_the_joint_is_looked_at_for_interference(joint):
    params = VARIABLE.model_copy(update={"phase_joint": joint})
    others = FAMILY.settings(params)
    assert list(others) == [f"phase = {phase} deg" for phase in (0, 45, 135, 180)]
    assert {one.phase for one in others.values()} == {0.0, 45.0, 135.0, 180.0}
    (note,) = [one for one in found_of(params) if one.code == "interference.settings"]
    assert all(name in note.message for name in others)
    fixed = VARIABLE.model_copy(update={"phase_joint": None, "phases": None})
    assert FAMILY.settings(fixed) == {}
    assert "interference.settings" not in {one.code for one in found_of(fixed)}


def found_of(params, family=FAMILY):
    parts = [joined(part) for part in family.parts(params)]
    return interference_findings(designed(family, params), parts, solids=False)


def test_a_collision_at_another_phase_is_an_error_that_says_which():
    class Lifted(EllipticGears):
        """At 135 degrees gear 3 stands 5 mm higher, and at 45 degrees it cannot be made."""

        def rules(self):
            no = Finding.error("gear.made-up", "phase", "gear 3 is gone", remedy="none", stage=Stage.PARTS)
            gone = Procedure(("gear.made-up",), lambda t: [no] if t.params.phase == 45 else [])
            return all_of(super().rules(), gone)

        def parts(self, params):
            lifted = params.phase == 135
            return [
                dataclasses.replace(
                    part, instances=tuple(dataclasses.replace(one, z=one.z + 5) for one in part.instances)
                )
                if lifted and part.name == "gear-3"
                else part
                for part in super().parts(params)
            ]

    few = VARIABLE.model_copy(update={"phases": (45.0, 90.0, 135.0)})
    first, *found = errors(found_of(few, Lifted()))
    assert str(first) == "error [gear.made-up] phase: set to phase = 45 deg: gear 3 is gone; none"
    assert found
    assert {one.code for one in found} == {"interference.collision"}
    assert all(one.message.startswith("set to phase = 135 deg: ") for one in found)
    assert any("gear-3" in one.message for one in found)


def test_no_solid_stands_in_another_with_the_pin_in():
    parts = [joined(part) if part.outline is not None else part for part in FAMILY.parts(VARIABLE)]
    report = interference(parts, smooth_motion(partial(FAMILY.solve, VARIABLE), parts))
    assert report.clear, report.collisions
    # A pin of twice the radius of its hole is found.
    wide = VARIABLE.model_copy(update={"dowel_diameter": 5.0})
    thick = next(part for part in FAMILY.parts(wide) if part.name == "phase-pin")
    changed = [thick if part.name == "phase-pin" else part for part in parts]
    hits = interference(changed, smooth_motion(partial(FAMILY.solve, VARIABLE), changed)).collisions
    assert {name for hit in hits for name in (hit.first, hit.second)} >= {"phase-pin", "gear-3", "gear-4"}


def test_holes_are_h7_and_have_their_walls():
    dividing = dividing_of(VARIABLE)
    (gear3,) = [part for part in FAMILY.parts(VARIABLE) if part.name == "gear-3"]
    holes = {feature.name: feature for feature in gear3.features if feature.name.startswith("phase-")}
    assert list(holes) == ["phase-0", "phase-45", "phase-90", "phase-135", "phase-180"]
    assert {hole.fit.text for hole in holes.values()} == {"4 H7 (0/+0.012)"}
    centres = [complex(*hole.centre) for hole in holes.values()]
    least = min(abs(one - two) for k, one in enumerate(centres) for two in centres[:k])
    assert PITCH * 4 <= least < PITCH * 4 + 0.2
    assert dividing.rings == (17.5,)
    assert dividing.pin_size.text == "4 g6 (-0.012/-0.004)"


def test_holes_that_are_too_near_go_to_a_second_circle():
    params = Params(**PINS, phases=(0, 45, 90, 135, 180), dowel_circle=23.0)
    dividing = dividing_of(params)
    assert dividing.rings == (11.5, 17.5)
    assert [hole.ring for hole in dividing.holes] == [0, 0, 0, 1, 0]
    assert errors(FAMILY.check(params)) == []
    (gear4,) = [gear for gear in gears_of(params) if gear.name == "gear-4"]
    assert [hole.name for hole in gear4.holes] == ["joint", "pin-1", "pin-2", "keeper"]
    motion = FAMILY.solve(params.model_copy(update={"phase": 135.0}), 5)
    assert np.linalg.norm(motion.poses["phase-pin"].position, axis=1) == pytest.approx(17.5)


def test_the_nearest_phases_that_work_are_named():
    table = PINS | {"phases": (88.0, 90.0, 92.0, 94.0), "phase": 90.0}
    faults = errors(FAMILY.check(Params(**table)))
    assert [fault.code for fault in faults] == ["train.phases"]
    (change,) = faults[0].proposed
    works = change["parameters.phases"]
    assert errors(FAMILY.check(Params(**table | {"phases": tuple(works)}))) == []
    assert ", ".join(f"{phase:g}" for phase in works) in faults[0].remedy
    assert {88.0, 90.0} <= set(works)
    moved = min(set(works) - {88.0, 90.0, 92.0, 94.0}, key=lambda phase: abs(phase - faults[0].value))
    assert faults[0].limit == moved


def test_a_phase_without_a_hole_is_refused_with_the_nearest():
    (fault,) = errors(FAMILY.check(Params(**PINS, phase=60.0)))
    assert (fault.code, fault.parameter, fault.limit) == ("train.phase-hole", "phase", 45.0)
    assert errors(FAMILY.check(Params(**PINS, phase=fault.limit))) == []
    (around,) = errors(FAMILY.check(Params(**PINS, phase=350.0)))
    assert around.limit == 0.0
    assert errors(FAMILY.check(Params(**PINS, phase=360.0))) == [], "360 degrees are none"
    # Its motion is that of the phase all the same.
    assert FAMILY.solve(Params(**PINS, phase=60.0), 3).scalars["Q.speed.max"].value > 0


def test_a_phase_that_is_left_out_is_one_of_those_there_are():
    assert Params(**PINS).phase_degrees == 90
    assert Params(**PINS, phases=(30.0, 90.0)).phase_degrees == 90
    assert Params(**PINS, phases=(30.0, 60.0)).phase_degrees == 30


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"stages": 2, "phases": (0.0,)}, "phase_joint"),
        ({"stages": 2, "phases": (0.0,), "phase_joint": "fixed"}, "phase_joint"),
        (PINS | {"phases": (0.0, 45.0, 360.0)}, "0 degrees twice"),
        (PINS | {"phases": ()}, "phases"),
        ({"phase_joint": "pins"}, "belongs to a train"),
    ],
)
def test_tables_that_make_no_sense(table, words):
    with pytest.raises(ValidationError, match=words):
        Params(**table)


@pytest.mark.parametrize(
    ("code", "table", "mend"),
    [
        ("train.dowels", {"dowel_circle": 20.0}, 26.0),
        ("train.dowel-rim", {"dowel_circle": 90.0}, 40.0),
        ("train.dowels", {"dowel_circle": 44.0, "eccentricity": 0.16, "pin_diameter": 22.0}, None),
    ],
)
def test_circles_without_room_are_refused(code, table, mend):
    faults = errors(FAMILY.check(Params(**PINS | {"tracer_diameter": 4.0} | table)))
    assert (code, "dowel_circle") in [(fault.code, fault.parameter) for fault in faults] or mend is None
    assert all(fault.remedy for fault in faults)
    assert faults
    if mend:
        assert errors(FAMILY.check(Params(**PINS | table | {"dowel_circle": mend}))) == []


@settings(deadline=None, max_examples=30)
@given(st.lists(st.integers(0, 72), min_size=3, max_size=7, unique=True), st.floats(0, 0.6))
def test_a_phase_without_a_hole_is_moved_no_farther_than_it_must(steps, e):
    phases = tuple(5.0 * step for step in steps)
    first = placed(phases, e, 4.0, 20.0)
    middles = np.array([first.centre(hole) for hole in first.holes])
    apart = np.abs(np.subtract.outer(middles, middles))[np.triu_indices(len(middles), 1)]
    assert apart.min(initial=np.inf) >= PITCH * 4 - 1e-8
    found = phases_that_work(first, phases, e)
    if first.crowded is None:
        assert found == sorted(phases)
        return
    assert placed(tuple(found), e, 4.0, 20.0).crowded is None
    gone, come = set(phases) - set(found), set(found) - set(phases)
    if len(gone) == 1:
        (old,), (new,) = gone, come
        kept = tuple(phase for phase in phases if phase != old)
        nearer = np.arange(0.5, abs(new - old), 0.5)
        for phase in (*(old + nearer), *(old - nearer)):
            if 0 <= phase <= 360:
                assert placed((*kept, float(phase)), e, 4.0, 20.0).crowded is not None
