"""URDF and SDF: MuJoCo and a reader of our own put the links where the motion has the bodies."""

import math
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

from mechwright import GROUND, host
from mechwright.designs.design import load
from mechwright.errors import KinematicsError
from mechwright_cad.exporters.simulation import sdf, urdf
from mechwright_cad.exporters.simulation.rotation import roll_pitch_yaw

mujoco = pytest.importorskip("mujoco", reason="MuJoCo reads URDF independently; pip install mujoco")
ROOT = Path(__file__).parents[2]
SAMPLES = 73
EXACT = 1e-9
"""m and parts of 1."""

EXAMPLES = (
    "crank-rocker-three-poles",
    "double-crank",
    "slider-crank-quick-return",
    "spherical-crank-rocker",
    "spherical-five-bar-refined",
    "rack-and-pinion",
    "spur-gears",
    "planetary-gears",
    "five-bar-published",
)
LOOPS = {"crank-rocker-three-poles": ["B"], "spur-gears": [], "rack-and-pinion": []}


def written(name, exporter, sample=0):
    design = load(ROOT / "examples" / f"{name}.toml", host())
    motion = design.family.solve(design.params, SAMPLES)
    parts = design.family.parts(design.params)
    text = exporter.assembly(name, parts, motion, sample)
    return ET.fromstring(text), motion, parts  # noqa: S314 - our own file


def matrix(xyz, rpy):
    """A frame by the textbook's matrices, not by ours."""
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(a), math.sin(a)) for a in rpy)
    x = np.array([(1, 0, 0), (0, cr, -sr), (0, sr, cr)])
    y = np.array([(cp, 0, sp), (0, 1, 0), (-sp, 0, cp)])
    z = np.array([(cy, -sy, 0), (sy, cy, 0), (0, 0, 1)])
    found = np.eye(4)
    found[:3, :3], found[:3, 3] = z @ y @ x, xyz
    return found


def numbers(text):
    return [float(one) for one in text.split()]


def frames(motion, sample):
    """Frames of the bodies, m."""
    found = {GROUND: np.eye(4)}
    for body, poses in motion.poses.items():
        found[body] = np.eye(4)
        found[body][:3, :3], found[body][:3, 3] = poses.rotation[sample], poses.position[sample] / 1000
    return found


def joint_value(joint, child, motion, sample, begin):
    """Angle or way of a link on its parent from the pose that is written, by the poses of the motion alone."""
    now, first = frames(motion, sample), frames(motion, begin)
    parent = joint.two if child == joint.one else joint.one
    here = np.linalg.inv(now[parent]) @ now[child]
    there = np.linalg.inv(first[parent]) @ first[child]
    turned = here[:3, :3] @ there[:3, :3].T
    axis = first[joint.one][:3, :3] @ joint.axis
    axis = first[parent][:3, :3].T @ axis * (-1 if child == joint.one else 1)
    if joint.kind == "prismatic":
        return float((here[:3, 3] - there[:3, 3]) @ axis)
    sine = (
        np.array([turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]]) / 2
    )
    return math.atan2(float(sine @ axis), (np.trace(turned) - 1) / 2)


def in_mujoco(root):
    """The file in MuJoCo, without looks: every link a body."""
    for link in root.findall("link"):
        for visual in link.findall("visual"):
            link.remove(visual)
    told = ET.SubElement(root, "mujoco")
    ET.SubElement(
        told, "compiler", fusestatic="false", balanceinertia="true", boundmass="1e-9", boundinertia="1e-12"
    )
    model = mujoco.MjModel.from_xml_string(ET.tostring(root).decode())
    return model, mujoco.MjData(model)


@pytest.mark.parametrize("name", EXAMPLES)
@pytest.mark.parametrize("begin", [0, 20])
def test_mujoco_puts_the_links_of_urdf_where_the_motion_has_the_bodies(name, begin):
    root, motion, _ = written(name, urdf, begin)
    marks = [link.attrib["name"] for link in root.findall("link") if "-on-" in link.attrib["name"]]
    child = {one.attrib["name"]: one.find("child").attrib["link"] for one in root.findall("joint")}
    model, data = in_mujoco(root)
    for sample in (0, 7, 31, 64):
        for number in range(model.njnt):
            joint = model.joint(number).name
            data.qpos[number] = joint_value(motion.joints[joint], child[joint], motion, sample, begin)
        mujoco.mj_kinematics(model, data)
        poses = frames(motion, sample)
        for body in motion.poses:
            rotation = data.body(body).xmat.reshape(3, 3)
            assert rotation == pytest.approx(poses[body][:3, :3], abs=EXACT), (body, sample)
            origin = np.linalg.inv(poses[body]) @ [*data.body(body).xpos, 1.0]
            start = np.linalg.inv(frames(motion, begin)[body]) @ [*_origin(root, body), 1.0]
            assert origin == pytest.approx(start, abs=EXACT), (body, sample)
        for loop in {mark.split("-on-")[0] for mark in marks}:
            one, two = (data.body(mark).xpos for mark in marks if mark.startswith(f"{loop}-on-"))
            assert one == pytest.approx(two, abs=EXACT)


def _origin(root, link):
    """Origin of a link in the pose that is written, by the chain of its joints."""
    found = np.eye(4)
    while True:
        joint = next((j for j in root.findall("joint") if j.find("child").attrib["link"] == link), None)
        if joint is None:
            return found[:3, 3]
        at = joint.find("origin").attrib
        found = matrix(numbers(at["xyz"]), numbers(at["rpy"])) @ found
        link = joint.find("parent").attrib["link"]


@pytest.mark.parametrize("name", EXAMPLES)
def test_mass_and_limits_are_those_of_parts_and_motion(name):
    root, motion, parts = written(name, urdf)
    mass = sum(
        float(one.find("inertial/mass").attrib["value"])
        for one in root.findall("link")
        if one.find("inertial")
    )
    counted = sum(len(link.findall("visual")) for link in root.findall("link"))
    assert counted == sum(len(part.instances) for part in parts)
    assert mass > 0
    for joint in root.findall("joint"):
        if joint.attrib["type"] in {"fixed", "continuous"}:
            continue
        limit, made = joint.find("limit").attrib, motion.joints[joint.attrib["name"]]
        child = joint.find("child").attrib["link"]
        ways = np.array([joint_value(made, child, motion, sample, 0) for sample in range(SAMPLES)])
        ways = np.unwrap(ways) if made.kind == "revolute" else ways
        assert float(limit["lower"]) == pytest.approx(min(ways), abs=EXACT)
        assert float(limit["upper"]) == pytest.approx(max(ways), abs=EXACT)


@pytest.mark.parametrize("name", EXAMPLES)
def test_sdf_keeps_the_loops(name):
    root, motion, _ = written(name, sdf, 5)
    model = root.find("model")
    poses = {link.attrib["name"]: _pose(link) for link in model.findall("link")}
    bodies = frames(motion, 5)
    joints = model.findall("joint")
    children = [joint.find("child").text for joint in joints]
    loops = sum(joint.kind == "revolute" for joint in motion.joints.values()) - sum(
        joint.attrib["type"] == "revolute" for joint in joints
    )
    assert loops == 0, "every pin of the motion is a joint"
    assert set(children) >= set(motion.poses)
    for joint in joints:
        told, child = motion.joints.get(joint.attrib["name"]), joint.find("child").text
        if told is None or told.kind == "fixed":
            continue
        at = poses[child] @ (np.eye(4) if joint.find("pose") is None else _pose(joint))
        if told.kind == "revolute":
            where = bodies[told.one] @ [told.point[0] / 1000, told.point[1] / 1000, told.point[2] / 1000, 1.0]
            assert at[:3, 3] == pytest.approx(where[:3], abs=EXACT)
        axis = poses[child][:3, :3] @ numbers(joint.find("axis/xyz").text)
        assert abs(axis @ (bodies[told.one][:3, :3] @ told.axis)) == pytest.approx(1.0, abs=EXACT)
    for body, frame in bodies.items():
        if body:
            assert poses[body][:3, :3] == pytest.approx(frame[:3, :3], abs=EXACT)


def _pose(element):
    pose = element.find("pose")
    return np.eye(4) if pose is None else matrix(numbers(pose.text)[:3], numbers(pose.text)[3:])


@pytest.mark.parametrize(
    ("name", "count"), [("spur-gears", 1), ("rack-and-pinion", 1), ("five-bar-published", 1)]
)
def test_gears_of_a_constant_ratio_are_mimicked(name, count):
    root, motion, _ = written(name, urdf)
    child = {one.attrib["name"]: one.find("child").attrib["link"] for one in root.findall("joint")}
    mimics = [
        (joint.attrib["name"], joint.find("mimic").attrib)
        for joint in root.findall("joint")
        if joint.find("mimic") is not None
    ]
    assert len(mimics) >= count
    for name_, mimic in mimics:
        for sample in (1, 2, 3):
            mine, other = (
                joint_value(motion.joints[one], child[one], motion, sample, 0)
                for one in (name_, mimic["joint"])
            )
            if abs(other) < 1.0 and abs(mine) < 1.0:  # before an angle goes round
                assert mine == pytest.approx(float(mimic["multiplier"]) * other, abs=1e-9)
    tree, _, _ = written(name, sdf)
    assert len(tree.findall(".//mimic")) == len(mimics)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("elliptic-pair", "left out: gear .*: its ratio changes over the turn"),
        ("geneva-straight", "left out: contact .*"),
        ("crank-rocker-three-poles", "loop joint B of follower and coupler: cut, see the links B-on-"),
    ],
)
def test_what_urdf_cannot_hold_is_told_in_it(name, said):
    design = load(ROOT / "examples" / f"{name}.toml", host())
    motion = design.family.solve(design.params, SAMPLES)
    text = urdf.assembly(name, design.family.parts(design.params), motion).decode()
    assert re.search(f"<!-- {said}", text)
    if "left out" in said:
        assert re.search(
            f"<!-- {said}", sdf.assembly(name, design.family.parts(design.params), motion).decode()
        )


def test_a_motion_without_joints_is_refused():
    design = load(ROOT / "examples" / "crank-rocker-three-poles.toml", host())
    motion = design.family.solve(design.params, 5)
    object.__setattr__(motion, "joints", {})
    with pytest.raises(KinematicsError, match="does not say how its bodies are joined"):
        urdf.assembly("still", (), motion)


@pytest.mark.parametrize("pitch", [-math.pi / 2, -0.3, 0.0, 1.1, math.pi / 2])
def test_angles_give_their_rotation_back(pitch):
    rng = np.random.default_rng(5)
    for roll, yaw in rng.uniform(-3, 3, (20, 2)):
        whole = matrix((0, 0, 0), (roll, pitch, yaw))
        assert matrix((0, 0, 0), roll_pitch_yaw(whole[:3, :3])) == pytest.approx(whole, abs=1e-9)


@pytest.mark.parametrize("name", ["crank-rocker-three-poles", "spur-gears", "spherical-crank-rocker"])
def test_yourdfpy_and_urchin_read_it(name, tmp_path):
    yourdfpy = pytest.importorskip("yourdfpy", reason="pip install yourdfpy urchin")
    urchin = pytest.importorskip("urchin", reason="pip install yourdfpy urchin")
    root, motion, _ = written(name, urdf)
    for link in root.findall("link"):
        for visual in link.findall("visual"):
            link.remove(visual)
    file = tmp_path / "assembly.urdf"
    ET.ElementTree(root).write(file)
    theirs, other = yourdfpy.URDF.load(str(file), load_meshes=False), urchin.URDF.load(str(file))
    assert theirs.validate()
    assert {joint.name for joint in other.joints} == set(theirs.joint_map)
    places = other.link_fk(use_names=True)
    for body, frame in frames(motion, 0).items():
        if body:
            assert places[body][:3, :3] == pytest.approx(frame[:3, :3], abs=1e-9)
            assert theirs.get_transform(body)[:3, :3] == pytest.approx(frame[:3, :3], abs=1e-9)
