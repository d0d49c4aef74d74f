"""The skeleton that the page of a motion shows where there are no parts."""

import re

import numpy as np
import pytest

from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import Channel, Curve, Motion, Poses, Trace
from mechwright.designs.design import load
from mechwright.plugins.host import host
from mechwright_cad.animation import motion_html, skeleton
from mechwright_cad.animation.scene import scene
from mechwright_cad.animation.skeleton import ARC, COLOURS, FRAME, lines_of, links_of

EXAMPLES = ("elliptic-pair", "figure-eight-train", "four-bar-double-rocker", "geneva-cycloidal")
IN_SPACE = ("spherical-crank-rocker", "spherical-five-bar-projected")


def motion_of(name, samples=37):
    from pathlib import Path

    design = load(Path(__file__).parents[2] / "examples" / f"{name}.toml", host())
    return design.family.solve(design.params, samples)


def moved(motion, body, points):
    if body == GROUND:
        return np.broadcast_to(points, (motion.samples, *points.shape))
    return motion.poses[body].transform(points)


@pytest.mark.parametrize("name", [*EXAMPLES, *IN_SPACE, "slider-crank-quick-return"])
def test_joints_of_two_links_stay_together_while_it_moves(name):
    motion = motion_of(name)
    links, size = links_of(motion)
    places = {link.body: moved(motion, link.body, np.array(link.joints)) for link in links if link.joints}
    found = 0
    for joint in motion.joints.values():
        if joint.kind != "revolute":
            continue
        here = moved(motion, joint.one, np.array([joint.point]))[:, 0]
        holders = [
            body
            for body, points in places.items()
            if np.linalg.norm(points - here[:, None], axis=2).max(axis=0).min() < 1e-6 * size
        ]
        assert len(holders) >= 2, f"{joint} is in {holders}"
        found += 1
    assert found >= 2


def test_a_link_joins_its_joints_and_the_point_that_is_drawn():
    motion = motion_of("four-bar-double-rocker")
    links, size = links_of(motion)
    coupler = next(link for link in links if link.body == "coupler")
    ends = {tuple(np.round(point, 9)) for line in lines_of(coupler, size) for point in line[[0, -1]]}
    assert ends == {(0, 0, 0), (60, 0, 0), (30, 30, 0)}
    assert [link.body for link in links if link.joints] == [GROUND, "crank", "coupler", "follower"]


def test_a_slide_is_a_line_as_long_as_the_way_and_a_block():
    angle = np.linspace(0, 2 * np.pi, 25)
    poses = {"slider": Poses.planar(50 + 20 * np.cos(angle), 7.0, np.zeros(25))}
    guide = {"guide": Joint("prismatic", GROUND, "slider", (0, 7, 0), (1, 0, 0), drives=True)}
    crank = {"pin": Joint("revolute", GROUND, "slider", (70.0, 7.0, 0.0))}
    motion = Motion("x", {"x": Channel(angle, "")}, poses, joints=guide | crank)
    links, _ = links_of(motion)
    ground = next(link for link in links if link.body == GROUND)
    (line,) = ground.strokes
    assert line[:, 1] == pytest.approx([7, 7])
    assert line[0, 0] < 30 < 70 < line[1, 0]
    slider = next(link for link in links if link.body == "slider")
    assert slider.strokes[0].shape == (5, 3)


def test_a_body_with_one_joint_has_a_hand_or_its_curve():
    angle = np.linspace(0, 2 * np.pi, 9)
    shaft = {"shaft": Joint("revolute", GROUND, "wheel", (5.0, 0.0, 0.0))}
    rim = 3 * np.exp(1j * np.linspace(0, 2 * np.pi, 13))
    for curves, lengths in (({}, [2]), ({"rim": Curve.planar("wheel", rim)}, [13])):
        motion = Motion(
            "x",
            {"x": Channel(angle, "rad")},
            {"wheel": Poses.planar(5.0, 0.0, angle)},
            joints=shaft,
            curves=curves,
        )
        links, size = links_of(motion)
        wheel = next(link for link in links if link.body == "wheel")
        assert [len(line) for line in lines_of(wheel, size)] == lengths


def test_on_a_sphere_links_are_arcs():
    motion = motion_of("spherical-crank-rocker")
    links, size = links_of(motion)
    for link in links:
        for line in lines_of(link, size):
            assert len(line) == ARC + 1
            radii = np.linalg.norm(line, axis=1)
            assert radii == pytest.approx([radii[0]] * (ARC + 1))


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_picture_in_the_plane_holds_all_of_it(name):
    motion = motion_of(name)
    found = scene((), motion, solids=False)
    x, y, width, height = found["window"]
    assert found["bare"]
    assert found["poses"][GROUND] == {"columns": [[0], [0], [0]]}  # x, y and angle
    assert all(layer["bones"] for layer in found["layers"])
    assert {layer["body"] for layer in found["layers"]} <= found["poses"].keys()
    for path in found["traces"].values():
        points = np.array(path)
        assert (points >= (x, y)).all()
        assert (points <= (x + width, y + height)).all()


@pytest.mark.parametrize("name", IN_SPACE)
def test_the_picture_in_space_has_lines(name):
    found = scene((), motion_of(name), solids=False)
    assert found["meshes"]
    assert found["poses"][GROUND] == {"columns": [[0], [0], [0], [1], [0], [0], [0]]}  # place and quaternion
    for mesh in found["meshes"]:
        assert mesh["triangles"] == []
        assert len(mesh["lines"]) % 6 == 0
        assert mesh["body"] in found["poses"]
    assert found["ball"]["radius"] > 10


def test_a_motion_that_says_nothing_of_its_joints_shows_its_points():
    motion = Motion(
        "x",
        {"x": Channel(np.arange(3.0), "")},
        {"a": Poses.planar(np.arange(3.0), 0.0, np.zeros(3)), "b": Poses.planar(0.0, 0.0, np.zeros(3))},
        traces={"P": Trace("a", (1.0, 0.0, 0.0))},
    )
    found = scene((), motion, solids=False)
    assert (found["layers"], list(found["poses"])) == ([], ["a"])


def test_the_page_of_a_lever_is_drawn_over_time():
    text = motion_html("d", "D", (), motion_of("four-bar-double-rocker"), solids=False)
    assert '"over":"time"' in text
    assert re.search(r"there and back", text)
    turning = motion_html("d", "D", (), motion_of("elliptic-pair"), solids=False)
    assert '"over":"theta2"' in turning


def test_neighbours_have_colours_of_their_own_and_the_ground_that_of_a_frame():
    links, _ = links_of(motion_of("four-bar-double-rocker"))
    coloured = [(link.body, colour) for link, colour in skeleton._coloured(links)]
    assert coloured[0] == (GROUND, FRAME)
    assert [colour for _, colour in coloured[1:]] == list(COLOURS[: len(coloured) - 1])


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.6, 0.0, 0.8)])
def test_a_block_on_a_slide_is_as_wide_whichever_way_the_slide_goes(axis):
    angle = np.linspace(0, 2 * np.pi, 25)
    way = 20 * np.cos(angle)[:, None] * np.array(axis)
    poses = {"slider": Poses(way, np.broadcast_to(np.eye(3), (25, 3, 3)).copy())}
    guide = {"guide": Joint("prismatic", GROUND, "slider", axis=axis, drives=True)}
    links, size = links_of(Motion("x", {"x": Channel(angle, "")}, poses, joints=guide))
    (block,) = next(link for link in links if link.body == "slider").strokes
    long, wide = (np.linalg.norm(block[b] - block[a]) for a, b in ((0, 1), (1, 2)))
    assert long == pytest.approx(skeleton.BLOCK * size)
    assert wide == pytest.approx(0.6 * long)
    assert (block[1] - block[0]) @ (block[2] - block[1]) == pytest.approx(0, abs=1e-9)
