"""How near links and joints come to each other's axes, and in what orders they can be stacked: the numbers of
an independent sweep."""

import numpy as np
import pytest
import shapely
from synthesis_reference import facts
from test_double_cranks import free_orders

from mechwright.mechanics.planar import Turning
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_spherical.kinematics.clearances import point_to_arc
from mechwright_spherical.kinematics.four_bar import FourBar as SphericalFourBar

TURN = np.linspace(0, 2 * np.pi, 3601)


def named(start):
    found = facts(start)
    return pytest.mark.parametrize("given", found, ids=[one["name"] for one in found])


def bar_of(given):
    sizes = given["inputs"]
    return FourBar(
        *(sizes[key] for key in ("crank", "coupler", "follower", "ground")), branch=sizes["branch"]
    )


LINKAGES = [one for one in facts("layers.") if one["name"].endswith("free_orders")]


@pytest.mark.parametrize("given", LINKAGES, ids=[one["name"] for one in LINKAGES])
def test_free_orders_on_one_frame_and_between_two(given):
    """The sweep counted each order from below and from above, and with two frames those that one is enough for."""
    one, two = (2 * len(free_orders(bar_of(given), sides)) for sides in (1, 2))
    assert given["expected"] == {"one_frame": one, "two_frames": one + two}


ANGLES = [one for one in facts("layers.") if one["name"].endswith("_deg") and "drag" in one["name"]]


@pytest.mark.parametrize("given", ANGLES, ids=[one["name"] for one in ANGLES])
def test_angles_in_the_coupler_s_joints(given):
    """Of the coupler with crank and follower; each is extreme where another pair of links lies in line."""
    bar = bar_of(given)
    at_b = np.sort(np.degrees(np.arccos(bar.transmission_cosines())))
    assert at_b == pytest.approx(given["expected"]["B"], abs=given["tolerance"])
    loop = close(bar, np.append(TURN, crank_angles(bar)))
    to_b, to_a0 = (loop.joint_b - loop.joint_a), -loop.joint_a
    at_a = np.degrees(np.abs(np.angle(to_b / to_a0)))
    assert [at_a.min(), at_a.max()] == pytest.approx(given["expected"]["A"], abs=given["tolerance"])


def crank_angles(bar):
    """Where follower and ground lie in line, A on both sides of it: the angle in A is extreme there."""
    found = []
    for b in (bar.ground - bar.follower, bar.ground + bar.follower):
        away = np.arccos((bar.crank**2 + b**2 - bar.coupler**2) / (2 * bar.crank * abs(b)))
        found += [np.angle(b) + away, np.angle(b) - away]
    return found


NEAR = [one for one in facts("layers.") if "least_distance" in one["name"]]


@pytest.mark.parametrize("given", NEAR, ids=[one["name"] for one in NEAR])
def test_least_distances_of_joints_from_links(given):
    bar = bar_of(given)
    loop = close(bar, TURN)
    a0, b0 = np.zeros(TURN.size, complex), np.full(TURN.size, bar.ground, complex)
    joints = {"A0": a0, "B0": b0, "A": loop.joint_a, "B": loop.joint_b}
    links = {
        "crank": (a0, loop.joint_a),
        "coupler": (loop.joint_a, loop.joint_b),
        "follower": (b0, loop.joint_b),
    }
    joint, link = given["name"].split(".")[-1].split("-")
    ends = np.stack([np.stack([one.real, one.imag], axis=1) for one in links[link]], axis=1)
    points = shapely.points(joints[joint].real, joints[joint].imag)
    least = shapely.distance(shapely.linestrings(ends), points).min()
    assert least == pytest.approx(given["expected"], abs=given["tolerance"])


@named("layers.spherical.")
def test_least_angles_of_spherical_joints_from_links(given):
    arcs = np.radians(given["inputs"]["ground_input_coupler_output_deg"])
    bar = SphericalFourBar(*arcs, side=float(given["inputs"]["sigma"]))
    state = bar.at(Turning.of(TURN), 0)
    a, b = state.a[0], state.c[0]
    o = np.broadcast_to(np.array([0.0, 0.0, 1.0])[:, None], a.shape)
    c = np.broadcast_to(bar.output_axis[:, None], a.shape)
    near = {
        "c_axis_to_input": (c, (o, a)),
        "o_axis_to_output": (o, (c, b)),
        "o_axis_to_coupler": (o, (a, b)),
        "c_axis_to_coupler": (c, (a, b)),
        "a_to_output": (a, (c, b)),
        "b_to_input": (b, (o, a)),
    }
    found = {key: float(np.degrees(point_to_arc(*one).min())) for key, one in near.items()}
    assert found == pytest.approx(given["expected"], abs=given["tolerance"])
