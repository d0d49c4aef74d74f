"""Cams as stages of chains: a slide or a lever behind gears, and what a lever turns."""

import math

import numpy as np
import pytest
from test_chain import CIRCLES, D1, chain, last, linked

from mechwright import Stage, Turning
from mechwright.designs.design import Design
from mechwright.mechanics.chain import ChainParams
from mechwright.mechanics.chain.assembly import assembly_of
from mechwright.mechanics.chain.checks import torques_of
from mechwright.mechanics.chain.running import finely, inputs_of

GEARS = ("noncircular-gears", D1)
LEVER = {"follower": "oscillating", "laws": ["4-5-6-7"]}


def params_of(design: Design) -> ChainParams:
    """Of a chain."""
    assert isinstance(design.params, ChainParams)
    return design.params


@pytest.mark.parametrize("turning", ["ccw", "cw"])
@pytest.mark.parametrize("kind", [{"laws": ["4-5-6-7"]}, LEVER])
def test_a_cam_behind_gears_lifts_by_where_its_shaft_stands(turning: str, kind: dict[str, object]) -> None:
    """Lift of the family at the same angle of the cam; velocity, acceleration and jerk are its slopes."""
    design = chain(GEARS, ("cam-follower", {**kind, "turning": turning}, {"start": 30}))
    motion = design.solve(7201)
    time, cam = motion["time"], motion["2.theta"]
    alone = design_alone(turning, kind)
    sense = 1 if turning == "ccw" else -1
    at = np.mod(sense * cam, math.tau)
    np.testing.assert_allclose(motion["2.lift"], alone.at(at).s, atol=1e-9)
    for name, rate in (("lift", "velocity"), ("velocity", "acceleration"), ("acceleration", "jerk")):
        slope = np.gradient(motion[f"2.{name}"], time, edge_order=2)
        most = np.abs(motion[f"2.{rate}"]).max()
        assert np.abs(slope - motion[f"2.{rate}"]).max() < 3e-3 * most, rate


def design_alone(turning: str, kind: dict[str, object]):
    """The turn of the same cam."""
    from mechwright_cam_follower.kinematics.cycle import cycle_of
    from mechwright_cam_follower.parameters import CamParams

    return cycle_of(CamParams.model_validate({**kind, "turning": turning}))


def test_a_lever_turns_what_stands_behind_it() -> None:
    """A third pair of gears swings as the lever does, and the torque comes back by balance of power."""
    design = chain(GEARS, ("cam-follower", LEVER), ("noncircular-gears", {**CIRCLES, "load_torque": 2.0}))
    links = linked(design)
    first = Turning.of(np.linspace(0.0, math.tau, 9), 1.0)
    *_, own = inputs_of(links, first)
    out = last(design, first)
    np.testing.assert_allclose(out.omega, -own.omega, atol=1e-12)
    assert 0 < np.ptp(out.theta) <= math.radians(20.0) + 1e-9
    params = params_of(design)
    families = tuple(link.family for link in links)
    run, torques = finely(params, families), torques_of(params, families)
    for torque, drive in zip(torques[1:2], run.inputs[1:2], strict=True):
        moved = links[1].transmission.power(drive, links[1].transmission.motion(drive, run.time))
        behind = 2.0 * np.abs(links[2].transmission.move(run.inputs[2]).omega)
        moving = np.abs(drive.omega) > 1e-6
        np.testing.assert_allclose((torque * drive.omega)[moving], (moved + behind)[moving], atol=1e-9)


@pytest.mark.parametrize(
    "table",
    [{}, {"contact": "flat"}, {"conjugate": True}, LEVER, {**LEVER, "conjugate": True}],
    ids=["slide", "flat", "pair", "lever", "pair-lever"],
)
def test_shafts_go_through_cams_and_levers(table: dict[str, object]) -> None:
    """The shaft of the gears goes through the cam, both cams of a pair, and stands as high as they do."""
    design = chain(("noncircular-gears", {**D1, "bore": 12}), ("cam-follower", {"bore": 12, **table}))
    params = params_of(design)
    families = tuple(link.family for link in linked(design))
    parts = {part.name: part for part in design.parts()}
    stage = assembly_of(params, families).places[1]
    names = ["2-cam", "2-cam-2"][: 1 + bool(table.get("conjugate"))]
    tops = [stage.level + parts[name].instances[0].z + parts[name].thickness for name in names]
    shaft = parts["shaft-1"]
    assert shaft.turned is not None
    length = sum(step.length for step in shaft.turned.steps)
    assert shaft.instances[0].z + length == pytest.approx(max(tops))
    assert ("shaft-out" in parts) is (table.get("follower") == "oscillating")


ROCKER = ("four-bar", {})
"""A crank and a follower that swings."""


@pytest.mark.parametrize(
    "before", [[("cam-follower", LEVER)], [ROCKER], [("cam-follower", LEVER), GEARS], [GEARS, ROCKER, GEARS]]
)
def test_a_geneva_wheel_behind_what_swings_is_refused_by_name(before) -> None:
    """It took the swing for turns: the wheel went there and back, and was told as if it indexed."""
    design = chain(*before, ("geneva", {}))
    found = [one for one in design.check() if one.code == "chain.swings"]
    assert [one.parameter for one in found] == [f"stage.{len(before) + 1}.family"]
    assert "turns all the way" in found[0].remedy
    assert [one.code for one in design.check() if one.stage is Stage.MOTION] == ["chain.swings"]


def test_what_follows_a_swing_follows_it_in_a_chain() -> None:
    """A Geneva wheel turns on, so that it may drive a lever's cam; cranks behind a lever swing with it."""
    for stages in ([("geneva", {}), ("cam-follower", LEVER)], [("cam-follower", LEVER), ROCKER]):
        assert len(linked(chain(*stages))) == len(stages)
