"""A train whose phase a clamp sets: its torque, its scale under the mark, and one machine for all phases."""

import math
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from by_night import thinned
from pydantic import ValidationError

from mechwright.contracts.details import Engraving, Thread
from mechwright.contracts.finding import Severity, errors
from mechwright.contracts.holes import joined
from mechwright.designs.design import load
from mechwright.plugins.host import host
from mechwright.standards.screws import ENGAGEMENT, LENGTHS
from mechwright_cad.interference import interference, smooth_motion
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import machine
from mechwright_cam.planning.prepare import prepare
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.kinematics.joint_load import greatest_torque
from mechwright_elliptic_gears.parts.clamp import MARK, SETTING, Clamp, clamp_of
from mechwright_elliptic_gears.parts.layout import layout_of

FAMILY = EllipticGears()
Params = EllipticGears.Params
ROOT = Path(__file__).parents[2]
PHASES = (0.0, 45.0, 90.0, 135.0, 180.0)
CLAMP = {"stages": 2, "bore": 12.0, "phase_joint": "clamp"}
TRAIN = Params(**CLAMP)


def parts_of(params):
    return {part.name: part for part in FAMILY.parts(params)}


def test_the_torque_of_a_face_clamp():
    # Three M4 of class 8.8 on a face of 16 to 40 mm, μ = 0.12.
    clamp = Clamp(4.0, 3, 10.0, 8.0, 20.0, 4.0)
    assert clamp.preload("steel") == pytest.approx(3932.867283014, rel=1e-9)
    assert clamp.torque("steel") == pytest.approx(21.035168731 * 3932.867283014 / 3932.857401634, rel=1e-9)
    assert clamp.preload("pom") == pytest.approx(40 * math.pi / 4 * (7**2 - 4.5**2))
    (note,) = [f for f in FAMILY.check(TRAIN) if f.code == "train.clamp-torque"]
    assert note.value == pytest.approx(clamp_of(TRAIN).torque("aluminium"))
    assert f"inertia takes {greatest_torque(TRAIN, 0.0).value:.3g} N m" in note.message


@pytest.mark.parametrize(("phase", "e"), thinned(2, PHASES, [0.3, 0.4, 0.5]))
def test_the_mark_of_the_ring_stands_over_the_phase_that_is_set(phase, e):
    params = Params(**CLAMP, phase=phase, eccentricity=e, teeth=31)
    assert errors(FAMILY.check(params)) == []
    parts = parts_of(params)
    (mark,) = [one for one in parts["clamp-ring"].details if isinstance(one, Engraving)]
    (scale,) = [one for one in parts["gear-4"].details if isinstance(one, Engraving)]
    motion = FAMILY.solve(params, 5)
    over = motion.poses["gear-3"].transform(np.array([(*mark.strokes[0][0], 0.0)]))[:, 0, :2]
    start, lines = clamp_of(params).scale, []
    for stroke in scale.strokes:
        one, two = complex(*stroke[0]), complex(*stroke[-1])
        if abs(one) == pytest.approx(start) and abs((two * one.conjugate()).imag) < 1e-9:
            lines.append(stroke)
    assert len(lines) == 5
    ends = motion.poses["gear-4"].transform(np.array([(*line[0], 0.0) for line in lines]))[:, :, :2]
    cosines = (over[:, None] * ends).sum(axis=2) / np.linalg.norm(over, axis=1)[:, None]
    cosines /= np.linalg.norm(ends, axis=2)
    assert (cosines.argmax(axis=1) == PHASES.index(phase)).all()
    assert cosines.max(axis=1) == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("phase", [*PHASES, 72.5])
def test_one_machine_has_any_phase(phase):
    params = TRAIN.model_copy(update={"phase": phase})
    parts, start = parts_of(params), parts_of(TRAIN)
    for name, part in parts.items():
        other = start[name]
        assert (part.outline, part.features, part.details, part.instances) == (
            other.outline,
            other.features,
            other.details,
            other.instances,
        )
    report = interference(
        list(parts.values()), smooth_motion(partial(FAMILY.solve, params), list(parts.values())), solids=False
    )
    assert report.clear, report.collisions
    assert {finding.severity for finding in FAMILY.check(params)} == {Severity.NOTE}


def test_no_solid_stands_in_another():
    params = Params(**CLAMP, keyway_width=4, keyway_relief=2)
    parts = [joined(part) if part.outline is not None else part for part in FAMILY.parts(params)]
    report = interference(parts, smooth_motion(partial(FAMILY.solve, params), parts))
    assert report.clear, report.collisions


def test_the_plates_of_the_clamp_are_machined():
    made = load(ROOT / "examples" / "figure-eight-train.toml", host())
    findings, jobs = prepare(made, [part for part in FAMILY.parts(TRAIN) if part.name.startswith("clamp-")])
    assert errors(findings) == []
    assert {job.part.name for job in jobs} == {"clamp-flange", "clamp-register", "clamp-ring"}
    for job in jobs:
        machine(job, host().get(Control, "linuxcnc")).proof.require()


def test_the_clamp_is_screwed_together():
    clamp, parts, layout = clamp_of(TRAIN), parts_of(TRAIN), layout_of(TRAIN)
    assert (clamp.screw, clamp.screws, clamp.register, clamp.outside) == (4.0, 4, 15.0, 19.0)
    threads = [one for one in parts["gear-3"].details if isinstance(one, Thread)]
    assert [thread.designation for thread in threads] == ["M4x0.7"] * 4
    for name in ("clamp-flange", "clamp-register", "clamp-ring"):
        holes = {f.name: f.diameter for f in parts[name].features if f.name.startswith("screw-")}
        assert holes == {f"screw-{n}": 4.5 for n in range(1, 5)}, name
    assert {i.body for i in parts["clamp-screw"].instances} == {f"clamp-screw-{n}" for n in range(1, 5)}
    screw, under_head = parts["clamp-screw"], parts["clamp-screw"].instances[0].z
    assert screw.bought.designation == "ISO 4762 - M4 x 25 - 8.8"
    box = screw.build().BoundingBox()
    # 7.3 mm of it stand in gear 3, whose thread is a pitch deeper, and its head is below the coupler.
    assert clamp.ring == pytest.approx(5.7)
    assert under_head + box.zmin == pytest.approx(layout.lower + 10 - 7.3)
    assert [thread.depth for thread in threads] == pytest.approx([8.0] * 4)
    assert under_head + box.zmax == pytest.approx(layout.link - 0.5)
    # The ring presses on gear 4, not on the register.
    register = parts["clamp-register"]
    assert (
        register.instances[0].z + register.thickness < layout.upper + 10 == parts["clamp-ring"].instances[0].z
    )
    (bore,) = [feature for feature in parts["gear-4"].features if feature.name == "bore"]
    assert (bore.fit.text, bore.diameter) == ("30 H7 (0/+0.021)", 30.0105)
    assert register.outline.bounds[2] == pytest.approx(clamp.spigot.middle / 2)
    assert clamp.spigot.text == "30 g6 (-0.02/-0.007)"
    # No screw under the mark.
    assert min(abs((one - MARK + math.pi) % math.tau - math.pi) for one in clamp.directions) > 0.3


def test_a_clamp_that_slips_is_refused_with_the_speed_that_works():
    table = CLAMP | {"speed": 1500.0, "material": "pom", "clamp_screw": 2.0, "clamp_screws": 3}
    (fault,) = errors(FAMILY.check(Params(**table)))
    assert (fault.code, fault.parameter) == ("train.clamp-torque", "speed")
    assert errors(FAMILY.check(Params(**table | {"speed": fault.limit}))) == []
    assert errors(FAMILY.check(Params(**table | {"speed": fault.limit * 1.001})))


def test_a_clamp_without_room_is_refused():
    (fault,) = errors(FAMILY.check(Params(**CLAMP, clamp_screw=8)))
    assert (fault.code, fault.parameter) == ("train.clamp", "clamp_screw")
    table = CLAMP | {"eccentricity": 0.5, "teeth": 31}
    (fault,) = errors(FAMILY.check(Params(**table, phases=(0.0, 90.0, 300.0))))
    assert (fault.code, fault.parameter, fault.value) == ("train.clamp", "phases", 300.0)
    (change,) = fault.proposed
    assert errors(FAMILY.check(Params(**table, phases=change["parameters.phases"]))) == []


@pytest.mark.parametrize("screws", range(3, 9))
@pytest.mark.parametrize("screw", [2.0, 3.0, 4.0, 6.0])
@pytest.mark.parametrize("bore", [3.0, 6.0, 12.0])
def test_heads_and_walls_of_a_clamp_are_apart_and_no_more_than_they_need(bore, screw, screws):
    clamp = clamp_of(Params(**CLAMP | {"bore": bore}, clamp_screw=screw, clamp_screws=screws))
    hole, head = clamp.hole, clamp.of.head
    between_heads = 2 * clamp.circle * math.sin(math.pi / screws) - head - 0.5
    inside = clamp.circle - bore / 2 - hole
    for spare in (between_heads, inside):
        assert spare >= -1e-9
    # Radii are whole halves of a millimetre, so that one of them has less than that to spare.
    assert min(between_heads / (2 * math.sin(math.pi / screws)), inside) < 0.5
    assert 0 <= clamp.register - clamp.circle - hole + 1e-9 < 0.5
    assert clamp.outside == max(clamp.register + 4, math.ceil(2 * clamp.circle + head - 1e-9) / 2)


SOLD = {2.0: 20, 2.5: 25, 3.0: 30, 4.0: 40, 5.0: 50, 6.0: 50, 8.0: 50, 10.0: 50, 12.0: 50}
"""Thread to the longest screw that is kept, mm."""


@pytest.mark.parametrize("material", sorted(ENGAGEMENT))
@pytest.mark.parametrize("thickness", [3.0, 7.3, 10.0, 16.0, 21.0])
@pytest.mark.parametrize("screw", sorted(SOLD))
def test_screws_are_of_a_sold_length_and_find_their_thread(material, thickness, screw):
    params = Params(**CLAMP, material=material, thickness=thickness, clamp_screw=screw)
    clamp = clamp_of(params)
    grip = clamp.ring + thickness + 2.0
    if clamp.length is None:
        shortest = max(3.0, screw) + thickness + 2.0 + ENGAGEMENT[material] * screw
        assert thickness < ENGAGEMENT[material] * screw or shortest > SOLD[screw]
        return
    assert clamp.length in LENGTHS
    assert clamp.length <= SOLD[screw]
    assert ENGAGEMENT[material] * screw - 1e-6 <= clamp.length - grip <= thickness + 1e-6
    deepest = max(ENGAGEMENT[material] * screw, 2 * screw - clamp.of.pitch)
    assert clamp.length - grip <= deepest + 1e-6
    # The ring is no higher than that takes.
    assert clamp.ring == max(3.0, screw) or clamp.length - grip == pytest.approx(min(thickness, deepest))


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"thickness": 5.0}, "gear 3 is 5 mm thick: M4 needs 6 mm of thread"),
        ({"thickness": 25.0, "clamp_screw": 3.0}, "the longest screw M3 is 30 mm; 34.5 mm are needed"),
    ],
)
def test_a_clamp_without_a_screw_is_refused_with_one_that_works(table, words):
    (fault,) = errors(FAMILY.check(Params(**CLAMP | table)))
    assert (fault.code, fault.message) == ("train.clamp-length", words)
    (change,) = fault.proposed
    better = Params(**CLAMP | table | {"clamp_screw": change["parameters.clamp_screw"]})
    assert errors(FAMILY.check(better)) == []


def test_what_a_mark_that_is_set_wrong_costs():
    (note,) = [f for f in FAMILY.check(TRAIN) if f.code == "train.phase-window"]
    assert f"±{math.degrees(SETTING / clamp_of(TRAIN).scale):.3f} degrees" in note.message


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"stages": 2, "clamp_screw": 4}, "clamp_screw needs a clamp"),
        ({"stages": 2, "phase_joint": "pins", "clamp_screws": 4}, "clamp_screws needs a clamp"),
        (CLAMP | {"dowel_circle": 30.0}, "dowel_circle has no place"),
        (CLAMP | {"clamp_screw": 4.4}, "the nearest is 4"),
        (CLAMP | {"clamp_screws": 2}, "clamp_screws"),
    ],
)
def test_tables_that_make_no_sense(table, words):
    with pytest.raises(ValidationError, match=words):
        Params(**table)


def test_a_clamped_example_of_the_page_can_be_read(tmp_path):
    text = (ROOT / "examples" / "figure-eight-variable.toml").read_text(encoding="utf-8")
    path = tmp_path / "clamped.toml"
    path.write_text(text.replace('"pins"', '"clamp"'), encoding="utf-8")
    assert load(path, host()).params.phase_joint == "clamp"
