"""Chains of mechanisms: rates through the stages, where they stand, and what is refused."""

import contextlib
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from core.disc_family import Disc

from mechwright import DesignError, MechwrightError, Turning, host
from mechwright.contracts.finding import errors
from mechwright.designs.change import changed
from mechwright.designs.design import Design, design_of
from mechwright.mechanics.chain import Chain, ChainParams, StageTable
from mechwright.mechanics.chain.checks import torques_of
from mechwright.mechanics.chain.links import Link, links_of, turns_of
from mechwright.mechanics.chain.running import finely, inputs_of

Table = Mapping[str, Any]

D1 = {"law": "fourier", "sines": [math.degrees(0.3)], "teeth": 40, "module": 2}
"""The law psi = phi + 0.3 sin phi of the reference."""

EVEN = {"eccentricity": 0.0, "teeth": 24, "module": 2, "semi_major": None}
"""Round gears: the ratio is -1."""

CIRCLES = {"law": "ellipse", "eccentricity": 0.0, "teeth": 24, "module": 2}

RING = {"law": "ellipse", "internal": True, "mate_lobes": 3, "eccentricity": 0.15, "teeth": 24}
"""A ring, which has no shaft."""

SWING = {"law": "spiral", "sector": 120, "teeth": 20}
"""Sectors, which swing."""


def chain(*stages: tuple[str, Table] | tuple[str, Table, Table], **tables: Any) -> Design:
    """A design of stages: family, parameters, and what the stage itself says."""
    content = {
        "name": "chain",
        "stage": [
            {"family": one[0], "parameters": dict(one[1]), **(one[2] if len(one) > 2 else {})}
            for one in stages
        ],
        **tables,
    }
    return design_of(content, Path("chain.toml"), "", host())


def linked(design: Design) -> tuple[Link, ...]:
    """Its stages."""
    assert isinstance(design.family, Chain)
    assert isinstance(design.params, ChainParams)
    return links_of(design.params, design.family.families)


def last(design: Design, drive: Turning) -> Turning:
    """The shaft that comes out of the last stage."""
    links = linked(design)
    *_, own = inputs_of(links, drive)
    return links[-1].transmission.move(own)


def after(at: float, omega: float = 1.0, alpha: float = 0.0, jerk: float = 0.0) -> Turning:
    """An input that begins at 0 and stands at an angle then."""
    return Turning.of([0.0, at], [1.0, omega], [0.0, alpha], [0.0, jerk])


# Rates


@pytest.mark.parametrize("phase", [0.0, 90.0, 135.0])
def test_train_of_the_seed_is_a_chain_of_two_pairs(phase: float) -> None:
    """Gear 5 of the figure-eight train and its point Q, from position to jerk, to 1e-12 of their sizes."""
    from mechwright_elliptic_gears.kinematics.equations import phase_offset

    pair = {"eccentricity": 0.4, "teeth": 25, "semi_major": 50}
    family = host().family("elliptic-gears")
    train = family.solve(family.Params.model_validate({**pair, "stages": 2, "phase": phase}), 73)
    begin = math.degrees(phase_offset(math.radians(phase), 0.4))
    motion = chain(
        ("elliptic-gears", pair), ("elliptic-gears", {**pair, "speed": 60}, {"start": begin})
    ).solve(73)
    assert motion["2.theta2"] == pytest.approx(train["theta4"] - math.tau, abs=1e-12)
    turned = (motion["2.theta4"] - train["theta5"]) / math.tau
    assert turned == pytest.approx(np.round(turned[0]) + 0 * turned, abs=1e-12)
    alike = {"omega4": "omega5", "alpha4": "alpha5", "jerk4": "jerk5", "omega3": "omega6"}
    alike |= {name: name for name in train.channels if name.startswith("Q.")}
    for one, two in alike.items():
        most = np.abs(train[two]).max()
        assert np.abs(motion[f"2.{one}"] - train[two]).max() <= 1e-12 * max(most, 1.0), one


def test_rates_are_slopes_through_three_stages() -> None:
    """A Geneva wheel behind a pair behind a four-bar that turns fully."""
    double = {"crank": 80, "coupler": 70, "follower": 75, "ground": 30}
    law = {"law": "straight", "entry_radius": 80, "roller_radius": 4}
    design = chain(("four-bar", double), ("noncircular-gears", D1), ("geneva", law, {"start": 20}))
    way = 1e-5
    angle = np.linspace(0.0, 0.4, 5)
    angles = np.sort(np.concatenate((angle, angle[1:] - way, angle[1:] + way)))
    out = last(design, Turning.of(angles, 1.0))
    places = [int(np.flatnonzero(angles == one)[0]) for one in angle[1:]]
    for name, rate in (("theta", "omega"), ("omega", "alpha"), ("alpha", "jerk")):
        values, rates = getattr(out, name), getattr(out, rate)
        for k in places:
            slope = (values[k + 1] - values[k - 1]) / (2 * way)
            assert slope == pytest.approx(rates[k], rel=1e-5, abs=1e-6), rate


def test_geneva_behind_round_gears_has_the_constant_of_its_slots() -> None:
    """Ca of a straight wheel at constant crank speed, from the closed form; the index takes a quarter."""
    motion = chain(("elliptic-gears", EVEN), ("geneva", {"law": "straight", "slots": 4})).solve(73)
    assert motion.scalars["2.Ca"].value == pytest.approx(8.493265948123813, rel=1e-6)
    assert motion.scalars["2.index_time"].value == pytest.approx(0.25, abs=1e-9)


def test_five_bar_runs_along_its_own_curve_at_the_speed_of_its_crank() -> None:
    """The same places of the coupler's point for the same angles of the crank, over two of its turns."""
    links = linked(chain(("noncircular-gears", D1), ("five-bar", {})))
    assert turns_of(links) == 2
    angle = np.linspace(0.0, 2 * math.tau, 13)
    *_, own = inputs_of(links, Turning.of(angle, 1.0))
    moved = links[1].transmission.motion(own, angle)
    plain = links[1].transmission.motion(Turning.of(own.theta, 1.0), angle)
    # The driven gear turns against its driver, and 1.3 times as fast where it begins.
    assert own.omega[0] == pytest.approx(-1.3)
    for axis in "xy":
        np.testing.assert_allclose(moved[f"{axis}P"], plain[f"{axis}P"], atol=1e-9)
        np.testing.assert_allclose(moved[f"v{axis}P"], own.omega * plain[f"v{axis}P"], atol=1e-9)
    assert moved["xP"][0] == pytest.approx(moved["xP"][-1], abs=1e-9)


# Periods and places


def test_period_brings_every_stage_back() -> None:
    """One turn of an ellipse on two lobes is half a turn: two turns of the input for a slider."""
    half = {"law": "ellipse", "mate_lobes": 2, "eccentricity": 0.1, "teeth": 30}
    links = linked(chain(("noncircular-gears", half), ("slider-crank", {})))
    assert turns_of(links) == 2
    slow = {"law": "ellipse", "lobes": 2, "mate_lobes": 3, "eccentricity": 0.05, "teeth": 40}
    assert turns_of(linked(chain(("noncircular-gears", slow), ("geneva", {})))) == 3


def test_stages_stand_on_the_shaft_before_and_over_each_other() -> None:
    """The driver's axis is that of gear 2, whichever way the wheel is turned about it."""
    for turned in (0.0, 70.0):
        geneva = {"law": "straight", "entry_radius": 80, "roller_radius": 4}
        motion = chain(("elliptic-gears", EVEN), ("geneva", geneva, {"turned": turned, "gap": 3})).solve(5)
        gear, driver = (motion.poses[name].position[0] for name in ("1-gear-4", "2-driver"))
        wheel = motion.poses["2-wheel"].position[0]
        assert driver[:2] == pytest.approx(gear[:2], abs=1e-9)
        way = wheel[:2] - driver[:2]
        assert math.degrees(math.atan2(way[1], way[0])) % 360 == pytest.approx(180 + turned, abs=1e-9)
        # Gears of 10 mm from 0 upwards; the locking disc, 12 mm, stands 1.5 mm below the wheel of 10 mm.
        assert driver[2] == pytest.approx(10 + 3 + 1.5, abs=1e-9)
        between = [
            motion.poses["1-gear-4"].rotation[k].T @ motion.poses["2-driver"].rotation[k] for k in range(5)
        ]
        for one in between[1:]:  # keyed: they turn as one
            np.testing.assert_allclose(one, between[0], atol=1e-12)


def test_a_turned_stage_turns_its_loads_and_joints() -> None:
    """The force on a slider is along its slide, and the shaft of the crank is held by the gear."""
    stages = ("elliptic-gears", EVEN), ("slider-crank", {"load": 5.0}, {"turned": 90.0})
    motion = chain(*stages).solve(3)
    assert motion.loads["2-load"].force == pytest.approx((0.0, 5.0, 0.0), abs=1e-12)
    assert motion.joints["2-shaft"].one == "1-gear-4"
    assert sum(one.drives for one in motion.joints.values()) == 1


# Loads


def test_loads_come_back_by_balance_of_power() -> None:
    """A torque behind two pairs: each stage gives on what it takes, times its ratio at every angle."""
    pair = {"law": "ellipse", "mate_lobes": 2, "eccentricity": 0.1, "teeth": 30}
    design = chain(("noncircular-gears", pair), ("noncircular-gears", {**pair, "load_torque": 8.0}))
    assert isinstance(design.family, Chain)
    assert isinstance(design.params, ChainParams)
    run = finely(design.params, design.family.families)
    one, two = torques_of(design.params, design.family.families)
    for torque, drive in ((one, run.inputs[0]), (two, run.inputs[1])):
        out = run.links[1].transmission.move(run.inputs[1])
        np.testing.assert_allclose(torque * drive.omega, 8.0 * np.abs(out.omega), rtol=1e-12)
    assert 1.0 < np.abs(one).mean() < 3.0


# What is refused


@pytest.mark.parametrize(
    ("stages", "said"),
    [
        ([("elliptic-gears", {})], "stage: 1 are no chain"),
        ([("elliptic-gears", {}), ("genova", {})], "stage.2.family"),
        ([("elliptic-gears", {}), ("geneva", {"slotz": 4})], "stage.2.parameters: unknown key 'slotz'"),
        ([("elliptic-gears", {}, {"start": 3}), ("geneva", {})], "stage.1.start"),
        ([("elliptic-gears", {}), ("geneva", {}, {"startt": 3})], "stage.2: unknown key 'startt'"),
    ],
)
def test_files_that_are_no_chain_name_the_stage(stages: Any, said: str) -> None:
    """Mistakes of the file."""
    with pytest.raises(MechwrightError) as caught:
        chain(*stages)
    assert said in str(caught.value)


def test_stages_have_no_names() -> None:
    """They go by their number, and no other table is meant."""
    with pytest.raises(
        DesignError, match=r"stage\.1: unknown key .name.; known: .*; stages go by their number$"
    ):
        chain(("elliptic-gears", {}, {"name": "a"}), ("geneva", {}, {"name": "a"}))


def test_a_head_with_a_family_is_refused() -> None:
    """Stages have theirs."""
    with pytest.raises(DesignError, match="family: a file with"):
        chain(("elliptic-gears", {}), ("geneva", {}), family="geneva")


def test_a_stage_gets_the_screws_that_its_place_wants() -> None:
    """Where the file leaves them out."""
    found = chain(("noncircular-gears", {**D1, "bore": 8}), ("five-bar", {}))
    assert found.chosen == {"stage.2.parameters.screw_hole": 5.5}
    assert not errors(found.check())


@pytest.mark.parametrize(
    ("stages", "code", "parameter"),
    [
        ([("slider-crank", {}), ("geneva", {})], "chain.output", "stage.1.family"),
        ([("five-bar", {}), ("geneva", {})], "chain.output", "stage.1.family"),
        (
            [("elliptic-gears", {}), ("five-bar", {"swing_from": 10, "swing_to": 50})],
            "chain.stage",
            "stage.2.parameters.crank",
        ),
        ([("noncircular-gears", RING), ("geneva", {})], "chain.stage", "stage.1.parameters.internal"),
        ([("noncircular-gears", SWING), ("geneva", {})], "chain.swings", "stage.2.family"),
        ([("elliptic-gears", {}), ("spherical", {})], "chain.stage", "stage.2.family"),
        ([("elliptic-gears", {}), ("cam-follower", {"bore": 0})], "chain.stage", "stage.2.parameters.bore"),
        ([("cam-follower", {}), ("geneva", {})], "chain.output", "stage.1.family"),
        ([("elliptic-gears", {}), ("geneva", {"speed": 30})], "chain.driven", "stage.2.parameters.speed"),
        (
            [("elliptic-gears", {}), ("four-bar", {"swing_from": 10, "swing_to": 50})],
            "chain.stage",
            "stage.2.parameters.crank",
        ),
        (
            [("four-bar", {"acceleration_ratio": 0.1}), ("geneva", {})],
            "chain.stage",
            "stage.1.parameters.acceleration_ratio",
        ),
        ([("elliptic-gears", {"stages": 2}), ("geneva", {})], "chain.stage", "stage.1.parameters.stages"),
        (
            [
                (
                    "noncircular-gears",
                    {"law": "ellipse", "lobes": 8, "mate_lobes": 7, "eccentricity": 0.001, "teeth": 40},
                ),
                (
                    "noncircular-gears",
                    {"law": "ellipse", "lobes": 7, "mate_lobes": 5, "eccentricity": 0.001, "teeth": 42},
                ),
                (
                    "noncircular-gears",
                    {"law": "ellipse", "lobes": 5, "mate_lobes": 8, "eccentricity": 0.001, "teeth": 40},
                ),
                ("geneva", {"slots": 11}),
                ("geneva", {"slots": 7}),
                ("geneva", {"slots": 7}),
            ],
            "chain.period",
            "stage.5",
        ),
    ],
)
def test_stages_that_cannot_be_joined_are_findings_with_their_stage(
    stages: Any, code: str, parameter: str
) -> None:
    """Each says which stage, and its remedy is none but a change or a word."""
    found = [one for one in chain(*stages).check() if one.code == code]
    assert [one.parameter for one in found] == [parameter]
    assert found[0].remedy


def test_speed_of_a_driven_stage_can_be_left_out_by_the_change_that_is_proposed() -> None:
    """The change reaches into the list of stages."""
    design = chain(("elliptic-gears", EVEN), ("geneva", {"law": "straight", "speed": 30}))
    found = next(one for one in design.check() if one.code == "chain.driven")
    assert not [one for one in design.changed(found.proposed[0]).check() if one.code == "chain.driven"]


@pytest.mark.parametrize("table", [SWING, {"law": "ratio", "ratio": "1 + 0.2*cos(phi)", "sector": 120}])
def test_sectors_become_a_pair_by_a_change_that_is_proposed(table: dict[str, Any]) -> None:
    """A spiral closes by no change of its own: another law does."""
    design = chain(("noncircular-gears", table), ("geneva", {}))
    (found,) = (one for one in design.check() if one.code == "chain.swings")
    left = []
    for change in found.proposed:
        with contextlib.suppress(DesignError):
            left.append([one.code for one in design.changed(change).check()])
    assert any("chain.swings" not in codes for codes in left)


def test_centres_that_fall_together_are_named_and_mended() -> None:
    """A second pair of the same size leads back to the first shaft."""
    design = chain(("elliptic-gears", EVEN), ("elliptic-gears", EVEN, {"turned": 180.0}))
    found = next(one for one in design.check() if one.code == "chain.centres")
    assert found.parameter == "stage.2.turned"
    assert found.value == pytest.approx(0.0, abs=1e-9)
    assert not [one for one in design.changed(found.proposed[0]).check() if one.code == "chain.centres"]


def test_text_of_a_chain_is_that_chain() -> None:
    """What is written is read as the same parameters."""
    import tomllib

    design = chain(("elliptic-gears", EVEN), ("geneva", {"slots": 6}, {"start": 30, "gap": 2}))
    again = design_of(tomllib.loads(design.text), design.path, "", host())
    assert again.params == design.params


def test_change_of_a_place_that_is_not_there_is_refused() -> None:
    """By its number."""
    with pytest.raises(DesignError, match=r"stage\.3\.start: '3' is no place"):
        changed({"stage": [{}, {}]}, {"stage.3.start": 1})


@pytest.mark.parametrize(
    ("field", "limit", "value"),
    [
        ("most_ca", 8.4, 8.493266),
        ("most_acceleration", 200, 5.406981 * math.tau**2),
        ("most_jerk", 11000, 48.0416 * math.tau**3),
    ],
)
def test_what_is_asked_of_an_output_is_held(field: str, limit: float, value: float) -> None:
    """A straight wheel of four slots at one turn a second, by its closed forms; a slack limit passes."""
    geneva = {"law": "straight", "entry_radius": 80, "roller_radius": 4}
    design = chain(("elliptic-gears", EVEN), ("geneva", geneva, {field: limit}))
    found = next(one for one in design.check() if one.code == "chain.asked")
    assert found.parameter == f"stage.2.{field}"
    assert found.value == pytest.approx(value, rel=1e-4)
    slack = design.changed({f"stage.2.{field}": value * 1.01})
    assert not [one for one in slack.check() if one.code == "chain.asked"]


def test_a_limit_of_what_a_stage_does_not_have_is_refused() -> None:
    """A pair of gears makes no moves from rest to rest."""
    design = chain(("elliptic-gears", EVEN), ("elliptic-gears", EVEN, {"turned": 60, "most_ca": 5}))
    found = next(one for one in design.check() if one.code == "chain.asked")
    assert "no such figure" in found.message


def test_live_fields_of_a_chain_are_those_of_its_stages() -> None:
    """By keys that a change takes."""
    from mechwright_cad.live.fields import fields_of

    design = chain(("elliptic-gears", EVEN), ("geneva", {"slots": 6}))
    fields = {one["key"]: one for one in fields_of(design)}
    assert fields["stage.2.parameters.slots"]["value"] == 6
    assert fields["stage.2.parameters.slots"]["given"]
    assert not fields["stage.1.parameters.bore"]["given"]
    again = design.changed({"stage.2.parameters.slots": 5})
    assert {one["key"]: one for one in fields_of(again)}["stage.2.parameters.slots"]["value"] == 5


def test_a_family_that_knows_no_shafts_is_refused() -> None:
    """One that says nothing of being a stage."""
    families = (host().family("elliptic-gears"), Disc())
    stages = tuple(StageTable(family=one.name, parameters=one.Params()) for one in families)
    found = Chain(families).check(ChainParams(stage=stages))
    assert [(one.code, one.parameter) for one in found] == [("chain.family", "stage.2.family")]
