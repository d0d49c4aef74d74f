"""Rack and pinion: what is refused and mended, what is left out, tables, and rack and pinion as made."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from as_made_builds import built, table

from mechwright import DesignError, MountingError, Severity, Stage, host
from mechwright.contracts.design_table import with_columns
from mechwright.contracts.evaluation import Batch
from mechwright.designs.design import load
from mechwright.mechanics.gearing.rack_as_made import MadeRack
from mechwright.mechanics.gearing.running import FINE, running_findings
from mechwright_spur_gears.family import SpurGears
from mechwright_spur_gears.gear_table import GearTable, table_of
from mechwright_spur_gears.parameters import SpurGearParams
from mechwright_spur_gears.parts.rack import designed
from mechwright_spur_gears.parts.teeth import loops_of

ROOT = Path(__file__).parents[2]
GEARS = SpurGears()
LEAST = (0.065, "rule")


def rack(**given):
    return SpurGearParams(arrangement="rack", **given)


def errors(**given):
    return {one.code for one in GEARS.check(rack(**given)) if one.severity is Severity.ERROR}


def errors_of_judge(params):
    return [one for one in GEARS.judge(params) if one.severity is Severity.ERROR]


@pytest.mark.parametrize(
    ("code", "given"),
    [
        ("rack.travel", {"rack_teeth": 12, "travel": 90.0}),
        ("rack.fillet", {"teeth": 76, "pressure_angle": 15.6, "dedendum": 1.16, "travel": 20.0}),
        ("rack.rim", {"rack_height": 6.0}),
        ("rack.holes", {"rack_holes": 40}),
        ("gear.undercut", {"teeth": 12, "shift": 0.0}),
        ("gear.shift", {"centre_distance": 23.0}),
        ("gear.rack", {"teeth": 12, "shift": 0.88}),
        ("gear.tip", {"teeth": 9, "shift": 0.7}),
        ("gear.interference", {"rack_addendum": 1.1}),
        ("gear.interference", {"teeth": 56, "shift": -0.11, "dedendum": 1.11, "rack_addendum": 0.42}),
        ("gear.contact-ratio", {"addendum": 0.5}),
        ("gear.root-land", {"tip_radius": 0.5}),
        ("gear.backlash", {"backlash": 0.0}),
        ("bore.rim", {"bore": 34.0}),
        ("gear.root", {"load_force": 30000.0}),
    ],
)
def test_what_is_wrong_with_a_rack_is_named_and_mended(code, given):
    first = next(one for one in GEARS.check(rack(**given)) if one.severity is Severity.ERROR)
    assert first.code == code
    assert first.remedy
    for change in first.proposed:
        changed = {**given, **{key.removeprefix("parameters."): value for key, value in change.items()}}
        assert code not in errors(**{key: value for key, value in changed.items() if value is not None})


def test_the_named_limits_of_a_rack_are_the_limits():
    for key, good, bad in (("rack_teeth", 16, 15), ("travel", 68.79, 68.81)):
        given = {"rack_teeth": 12, "travel": 90.0}
        message = next(one for one in GEARS.check(rack(**given)) if one.code == "rack.travel").remedy
        assert f"{good:g}" in message
        assert "rack.travel" not in errors(**{**given, key: good})
        assert "rack.travel" in errors(**{**given, key: bad})
    assert "gear.interference" not in errors(rack_addendum=0.99)
    assert "gear.interference" in errors(rack_addendum=1.01)


@pytest.mark.parametrize(
    ("given", "match"),
    [
        (
            {"arrangement": "rack", "mate_teeth": 30},
            'mate_teeth is for arrangement = "external"; leave it out of "rack"',
        ),
        ({"arrangement": "rack", "load_torque": 2.0}, "load_torque is for"),
        ({"arrangement": "rack", "ring_holes": 4}, "ring_holes is for"),
        ({"arrangement": "rack", "shift_rule": "no-undercut"}, "shift_rule is for"),
        ({"arrangement": "rack", "shift": 0.1, "centre_distance": 20.2}, "leave one of both out"),
        ({"travel": 30.0}, 'travel is for arrangement = "rack"; leave it out of "external"'),
        ({"load_force": 3.0}, "load_force is for"),
        ({"arrangement": "rack", "travel": 0.0}, "greater than 0"),
        ({"arrangement": "rack", "travel": math.nan}, "travel"),
        ({"arrangement": "rack", "rack_teeth": 1}, "greater than or equal to 2"),
    ],
)
def test_bad_input_is_refused_by_name(given, match):
    with pytest.raises(ValueError, match=match):
        SpurGearParams(**given)


def test_a_rack_has_no_frame_and_drives_no_stage():
    with pytest.raises(MountingError, match="a rack slides in a guide"):
        GEARS.mounting(rack())
    with pytest.raises(DesignError, match="a rack slides and has no shaft"):
        GEARS.transmission(rack())


def test_what_a_design_leaves_out_follows_from_the_rest():
    bare = rack(teeth=20)
    assert (bare.travel, bare.rack_teeth, bare.rack_addendum, bare.rack_holes) == (100.0, 17, 0.99, 2)
    assert rack(teeth=20, rack_teeth=40).travel == math.floor(float(table_of(bare).rack_pair.travel(40)))
    assert rack(teeth=20, rack_holes=0).rack_height < bare.rack_height
    assert rack(teeth=20, travel=3.0).rack_holes == 1
    assert rack(teeth=12).arrangement == "rack"
    assert float(table_of(rack(teeth=12)).pair.shifts[0]) == pytest.approx(0.299, abs=1e-3)


def test_tables_say_what_single_designs_say():
    rng, size = np.random.default_rng(5), 160
    varied = {
        "teeth": rng.integers(8, 60, size),
        "module": rng.uniform(0.8, 3, size),
        "shift": rng.uniform(-0.3, 0.8, size),
        "rack_teeth": rng.integers(8, 40, size),
        "travel": rng.uniform(10, 150, size),
        "rack_height": rng.uniform(6, 20, size),
        "load_force": rng.uniform(0, 400, size),
    }
    names = ("contact_ratio", "centre_distance", "sliding1", "greatest_travel", "rack_speed")
    found = GEARS.evaluate(Batch(SpurGearParams, {"arrangement": "rack"}, varied), names, Stage.PARTS)
    good, codes = 0, set()
    for place in range(size):
        one = rack(
            **{
                name: int(values[place]) if name.endswith("teeth") else float(values[place])
                for name, values in varied.items()
            }
        )
        wrong = [one for one in errors_of_judge(one) if not one.stage.is_after(Stage.PARTS)]
        code = found.codes[found.forbidden[place]]
        assert code == (wrong[0].code if wrong else "")
        codes.add(code)
        if not wrong:
            good += 1
            figures = GEARS.figures(table_of(one))
            for name in names:
                assert found.values[name][place] == pytest.approx(float(figures[name]()), rel=1e-12)
    assert good > 10
    assert {"rack.travel", "gear.undercut"} <= codes


def test_the_channels_of_tables_are_those_of_singles():
    size = 5
    teeth, travel = np.arange(18, 18 + size), np.linspace(20, 60, size)
    given = with_columns(rack(speed=30), {"teeth": teeth[:, None], "travel": travel[:, None]})
    channels = GEARS.channels(GearTable(given, size), 25)
    for place in range(size):
        motion = GEARS.solve(rack(speed=30, teeth=int(teeth[place]), travel=float(travel[place])), 25)
        for name in ("theta1", "omega1", "travel", "velocity", "acceleration", "jerk", "time"):
            row = np.broadcast_to(channels[name].values, (size, 25))[place]
            assert row == pytest.approx(motion[name], rel=1e-12, abs=1e-9)


def test_the_example_is_the_one_of_the_documentation():
    design = load(ROOT / "examples" / "rack-and-pinion.toml", host())
    m = table_of(design.params)
    assert float(m.pair.shifts[0]) == pytest.approx(0.123, abs=1e-3)
    assert errors_of_judge(design.params) == []


def made(up=0.0, **given):
    """A rack that is drawn, and stands higher by so much, with its pinion."""
    m = table_of(rack(teeth=20, travel=30.0, rack_addendum=0.9, **given))
    pinion, rack_ = (loop.flatten(1e-5) for loop, _ in loops_of(m))
    return MadeRack(designed(m), (rack_ + np.array([0.0, up]), pinion), 0.0, LEAST), m


def test_the_play_of_drawn_outlines_is_that_of_the_backlash():
    run, m = made()
    lever, room = float(m.pair.base(0)), float(m.pair.backlash) / 2 / float(m.pair.operating(0))
    for play in (*run.gaps.play(), run.mesh.ahead, run.mesh.behind):
        assert play == pytest.approx(np.full(play.size, room), abs=2 * FINE / lever)
    assert running_findings(run) == []


@pytest.mark.parametrize("up", [0.02, 0.05])
def test_a_rack_that_stands_higher_takes_play_away_by_its_sine(up):
    run, m = made(up)
    alpha, r = float(m.pair.angle), float(m.pair.operating(0))
    less = up * math.sin(alpha) / (r * math.cos(alpha))
    lever, room = r * math.cos(alpha), float(m.pair.backlash) / 2 / r
    for play in (*run.gaps.play(), run.mesh.ahead, run.mesh.behind):
        assert play == pytest.approx(np.full(play.size, room - less), abs=2 * FINE / lever)
    straight = made()[0].gaps.play(run.apart(-up))
    assert straight[0] == pytest.approx(run.gaps.play()[0], abs=2e-6)


def test_a_rack_that_stands_too_high_jams_and_is_told_its_backlash():
    run, _ = made(0.12)
    (finding,) = [one for one in running_findings(run) if one.code == "gear.as-made"]
    assert finding.severity is Severity.ERROR
    assert "mm of the rack from the middle of its travel" in finding.message
    better = finding.proposed[0]["parameters.backlash"]
    again, _ = made(0.12, backlash=better)
    assert not [one for one in running_findings(again) if one.severity is Severity.ERROR]


def test_racks_run_as_their_programs_leave_them(tmp_path):
    path = tmp_path / "rack.toml"
    given = {"teeth": 16, "module": 2.0, "travel": 20.0, "rack_holes": 0, "thickness": 4.0, "bore": 8.0}
    path.write_text(table("spur-gears", arrangement="rack", **given) + "[cam]\n", encoding="utf-8")
    parts, said, _ = built(path)
    assert {part.name for part in parts} == {"gear-1", "rack"}
    assert said.findings == ()
    figures = {figure.name: figure for figure in said.figures}
    play = figures["rack.gear-1.play.least"]
    assert play.low > 0
    backlash = figures["rack.gear-1.backlash"]
    assert abs(backlash.made - backlash.design) < 0.02
    assert json.dumps([curve.title for curve in said.curves]) == '["rack and gear 1: play"]'
