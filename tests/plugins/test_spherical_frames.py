"""Spherical four-bars between two arcs of the ground: double cranks, double rockers, and what stays outside."""

import json
import math
import warnings
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright.contracts.finding import errors
from mechwright_spherical.as_made.bores import as_made
from mechwright_spherical.family import Spherical
from mechwright_spherical.kinematics.bodies import link_frames
from mechwright_spherical.kinematics.clearances import links_apart, pin_apart, point_to_arc
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.flat import strip
from mechwright_spherical.parts.frame import AIR, frame_of, ground_arcs, shells_of

EXAMPLE = Path(__file__).parents[2] / "examples" / "spherical-double-crank.toml"
ARCS = ("ground", "input", "coupler", "output")

REFERENCE = (
    (
        (20, 60, 50, 70),
        80.0,
        {"o_coupler": 49.2542, "c_coupler": 40.0, "a_output": 29.9318, "b_input": 42.0785},
    ),
    (
        (15, 80, 60, 75),
        87.5,
        {"o_coupler": 60.0, "c_coupler": 64.7756, "a_output": 54.2019, "b_input": 49.2542},
    ),
    (
        (25, 45, 40, 50),
        62.5,
        {"o_coupler": 24.9702, "c_coupler": 20.0, "a_output": 15.5918, "b_input": 22.5660},
    ),
)
"""Arcs, the half angle of the cap that the links sweep, and the least angles between axes and links, degrees."""


def design(arcs, radius=80.0, **changes):
    hardware = {"frame": changes.pop("frame", "auto")}
    table = dict(zip(ARCS, arcs, strict=True)) | changes
    return SphericalParams(kind="four-bar", radius=radius, four_bar=table, hardware=hardware)


@pytest.mark.parametrize(("arcs", "cap", "least"), REFERENCE)
def test_least_angles_between_axes_and_links(arcs, cap, least):
    """Each fixed axis passes through the other link, so that one side is impossible; o and c clear the coupler."""
    phase = linkage_of(design(arcs)).shown
    state = phase.state(1441)
    a, b = state.a[0], state.c[0]
    o, c = (np.broadcast_to(axis[:, None], a.shape) for axis in (phase.loop.a0, phase.loop.b0))
    found = {
        "o_coupler": point_to_arc(o, (a, b)),
        "c_coupler": point_to_arc(c, (a, b)),
        "a_output": point_to_arc(a, (c, b)),
        "b_input": point_to_arc(b, (o, a)),
    }
    for name, expected in least.items():
        assert np.degrees(found[name].min()) == pytest.approx(expected, abs=0.03), name
    assert np.degrees(point_to_arc(c, (o, a)).min()) < 0.3
    assert np.degrees(point_to_arc(o, (c, b)).min()) < 0.3


@pytest.mark.parametrize(("arcs", "cap", "least"), REFERENCE)
@pytest.mark.parametrize("branch", [1, -1])
def test_a_double_crank_stands_on_both_sides(arcs, cap, least, branch):
    params = design(arcs, branch=branch, point_azimuth=25.0, point_elevation=0.0)
    assert errors(Spherical().check(params)) == []
    frame = frame_of(params)
    spans = sorted((span, name) for name, span in frame.shells.links.items())
    assert [name for _, name in spans] == ["ground-2", "crank", "coupler", "rocker", "ground"]
    assert all(high[0][0] - low[0][1] >= 1.5 - 1e-9 for low, high in pairwise(spans))
    # The path point, which lies on the coupler between the pins, is on the sphere; the bridge outside the cap.
    assert frame.shells.links["crank"][1] < params.radius < frame.shells.links["coupler"][0]
    half = math.degrees(math.atan2(params.hardware.boss_diameter, frame.shells.links["crank"][0]))
    beyond = math.degrees(frame.bridge) + arcs[0] / 2
    assert cap < beyond < cap + 2 * half


def test_the_bridge_and_no_pin_meet_a_link_at_any_angle():
    params = design((20, 60, 50, 70), radius=60.0)
    linkage, frame = linkage_of(params), frame_of(params)
    phase = linkage.shown
    state = phase.state(2881)
    a, b, p = state.a[0], state.c[0], state.p[0]
    ground = link_frames(linkage, phase, state)["ground"]
    at = np.einsum("ijn,j->in", ground, [math.cos(frame.bridge), -math.sin(frame.bridge), 0.0])
    o, c = (np.broadcast_to(axis[:, None], a.shape) for axis in (phase.loop.a0, phase.loop.b0))
    halves = (
        params.hardware.boss_diameter / 2,
        params.hardware.link_width / 2,
        params.hardware.boss_diameter / 2,
    )
    for name, arcs in {"crank": [(o, a)], "rocker": [(c, b)], "coupler": [(a, b), (a, p), (b, p)]}.items():
        for arc in arcs:
            assert pin_apart(at, arc, *halves, frame.shells.links[name][0]).min() >= AIR
    # On one side crank and rocker would run into each other.
    assert links_apart((o, a), (c, b), 4.0, 6.0, params.radius).min() < 0


def test_one_side_stays_where_it_goes_and_can_be_asked_for():
    assert frame_of(SphericalParams(kind="four-bar", radius=60)).bridge is None
    assert frame_of(SphericalParams()).bridge is None
    both = SphericalParams(kind="four-bar", radius=60, hardware={"frame": "two"})
    assert errors(Spherical().check(both)) == []
    assert frame_of(both).bridge is not None
    codes = {one.code for one in errors(Spherical().check(design((20, 60, 50, 70), frame="one")))}
    assert codes == {"spherical.clearance"}
    with pytest.raises(ValueError, match="for a four-bar"):
        SphericalParams(hardware={"frame": "two"})


def test_a_sphere_too_small_for_the_inner_arc_is_refused_with_one_that_is_not():
    def faults(radius):
        flat = {"flat": design((20, 60, 50, 70)).flat.model_copy(update={"make": False})}
        return errors(Spherical().check(design((20, 60, 50, 70), radius=radius).model_copy(update=flat)))

    fault, *_ = faults(25.0)
    assert (fault.code, fault.parameter) == ("spherical.centre", "radius")
    assert faults(fault.limit - 0.2) != []
    assert faults(fault.limit) == []
    # Motion asks for no parts.
    assert Spherical().solve(design((20, 60, 50, 70), radius=10.0), 13).poses


ROCKERS = (
    ((50.1, 61.1, 71.6, 86.9), 20.9, 318.1),
    ((82.4, 61.0, 53.0, 74.1), 8.0, 124.3),
    ((58.3, 84.5, 59.4, 72.1), 8.0, 131.3),
)


@pytest.mark.parametrize(("arcs", "start", "travel"), ROCKERS)
def test_double_rockers_whose_links_pass_each_other_have_parts(arcs, start, travel):
    params = design(arcs, start=start, travel=travel)
    assert errors(
        Spherical().check(params.model_copy(update={"hardware": design(arcs, frame="one").hardware}))
    )
    assert errors(Spherical().check(params)) == []
    assert frame_of(params).bridge is not None
    assert set(ground_arcs(params)) == {"ground", "ground-2"}


@dataclass
class Bored:
    """A strip as made whose second bore is off along it by so much."""

    length: float
    off: float = 0.0
    corridor: float = 0.0

    def hole_at(self, x, y, diameter):
        dx = self.off if abs(x - self.length) < 1e-6 else 0.0
        return type("Hole", (), {"x": x + dx, "y": y, "least": diameter, "radius": diameter / 2})()


def test_both_strips_of_the_ground_count_as_made():
    params = design((20, 60, 50, 70))
    shells, loop = shells_of(params), linkage_of(params).shown.loop
    arcs = {"crank": 60, "rocker": 70}
    lengths = {
        name: strip(math.radians(arc), shells.arc(name)[0], params.flat).length for name, arc in arcs.items()
    }
    lengths["coupler"] = strip(math.acos(float(loop.ca)), shells.arc("coupler")[0], params.flat).length
    for name, arc in ground_arcs(params).items():
        lengths[name] = strip(arc, shells.arc(name)[0], params.flat).length

    def error(**off):
        made = {f"flat-{name}": [Bored(length, off.get(name, 0.0))] for name, length in lengths.items()}
        (figure,) = [one for one in as_made(params, made).figures if one.name == "output.error"]
        return figure.low

    assert error() == pytest.approx(0.0, abs=1e-9)

    def slope(name, step=1e-4):
        """mm/rad of a strip with its arc."""
        arc, radius = ground_arcs(params)[name], shells.arc(name)[0]
        ends = [strip(arc + sign * step, radius, params.flat).length for sign in (1, -1)]
        return (ends[0] - ends[1]) / (2 * step)

    longer = error(ground=slope("ground") * 1e-4)
    assert longer > 10
    # The inner strip carries the input axis towards the output axis: longer, it makes the ground shorter.
    assert error(**{"ground-2": slope("ground-2") * -1e-4}) == pytest.approx(longer, rel=1e-3)
    both = {name: slope(name) * 1e-4 for name in ("ground", "ground-2")}
    assert error(**both) == pytest.approx(0.0, abs=0.01)


@by_night
def test_the_example_builds_without_a_warning(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        done = CliRunner().invoke(make_app(), ["build", str(EXAMPLE), "-o", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    assert "warning" not in done.output
    made = {file.name for file in (tmp_path / "out").iterdir()}
    assert {"assembly.step", "ground.step", "flat-ground.nc", "flat-ground-2.nc"} <= made
    assert json.loads((tmp_path / "out" / "proof.json").read_text(encoding="utf-8"))


@given(st.floats(0.3, 1.2), st.floats(0.1, 1.2), st.floats(-1.0, 1.0))
def test_a_pin_beside_the_middle_of_an_arc_is_as_far_as_its_latitude(latitude, half, turn):
    def at(azimuth, elevation):
        return np.array([
            [math.cos(elevation) * math.cos(azimuth)], [math.cos(elevation) * math.sin(azimuth)], [math.sin(elevation)]
        ])  # fmt: skip

    radius, pin, arc, disc = 50.0, 3.0, 4.0, 6.0
    link = at(turn - half, 0.0), at(turn + half, 0.0)
    beside = latitude - math.atan(pin / radius) - math.atan(arc / radius)
    end = math.acos(math.cos(latitude) * math.cos(half)) - math.atan(pin / radius) - math.atan(disc / radius)
    found = pin_apart(at(turn, latitude), link, pin, arc, disc, radius)
    assert found == pytest.approx(radius * min(beside, end))
    # Beyond an end of the arc it is that end's disc which is near.
    far = turn + half + latitude
    found = pin_apart(at(far, 0.0), link, pin, arc, disc, radius)
    assert found == pytest.approx(radius * (latitude - math.atan(pin / radius) - math.atan(disc / radius)))
