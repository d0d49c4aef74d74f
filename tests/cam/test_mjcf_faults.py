"""What MJCF cannot hold is refused in one line; what it holds is the same bytes always."""

import math
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from by_night import by_night

from mechwright import GROUND, Channel, Instance, Joint, Loop, Motion, Outline, Part, Poses, circle
from mechwright.contracts import materials
from mechwright.contracts.joint import fixed
from mechwright.errors import GeometryError, KinematicsError
from mechwright_cad.exporters import MjcfExporter
from mechwright_cad.exporters.simulation import mjcf
from mechwright_cad.exporters.simulation.tree import tree_of
from mechwright_cad.solids.inertia import Inertia, mass_moments

ROOT = Path(__file__).parents[2]
ANGLE = np.linspace(0, 1, 5)


def disc(name="disc", body="disc", radius=5.0, material="steel"):
    outline = Outline(Loop((circle((0.0, 0.0), radius),)))
    return Part(name, outline, 2.0, material, (Instance(body),))


def motion(joints, *bodies):
    poses = {body: Poses.planar(0.0, 0.0, ANGLE) for body in bodies}
    return Motion("phi", {"phi": Channel(ANGLE, "rad")}, poses, joints=joints)


SHAFT = {"shaft": Joint("revolute", GROUND, "disc", drives=True)}


def test_the_least_mechanism():
    root = ElementTree.fromstring(mjcf.assembly("least", [disc()], motion(SHAFT, "disc")))  # noqa: S314 - our own
    (body,) = root.findall("worldbody/body")
    assert body.get("name") == "disc"
    inertial = body.find("inertial")
    mass = math.pi * 25 * 2 * 7.85e-6
    assert float(inertial.get("mass")) == pytest.approx(mass, rel=1e-12)
    polar, across = mass * 25e-6 / 2, mass * (3 * 25e-6 + 4e-6) / 12
    wanted = [across, across, polar, 0, 0, 0]
    assert [float(x) for x in inertial.get("fullinertia").split()] == pytest.approx(
        wanted, rel=1e-9, abs=1e-20
    )
    assert [float(x) for x in inertial.get("pos").split()] == pytest.approx([0, 0, 1e-3], abs=1e-15)
    assert root.find("actuator/motor").get("joint") == "shaft"
    assert root.find("option/flag").get("contact") == "disable"


@pytest.mark.parametrize(
    ("joints", "bodies", "parts", "words"),
    [
        ({}, ("disc",), [disc()], "does not say how its bodies are joined"),
        (SHAFT, ("disc", "arm", "rod"), [disc()], "no joint holds the bodies arm, rod"),
        (SHAFT | fixed("disc", "a") | {"b": Joint("fixed", GROUND, "a")}, ("disc", "a"), [disc()], None),
        (
            {**SHAFT, **fixed("disc", "a"), "b": Joint("fixed", "disc", "a")},
            ("disc", "a"),
            [disc()],
            "closes a loop",
        ),
        (SHAFT, ("disc",), [], "body disc moves and has no mass"),
        (
            SHAFT | {"other": Joint("revolute", "disc", "arm"), "mesh": Joint("gear", "disc", "arm")},
            ("disc", "arm"),
            [disc(), disc("arm", "arm")],
            "ratio of disc and arm .mesh. changes over the turn",
        ),
        (
            SHAFT | fixed("disc", "arm") | {"mesh": Joint("gear", "disc", "arm", ratio=2.0)},
            ("disc", "arm"),
            [disc(), disc("arm", "arm")],
            "the gear mesh turns arm",
        ),
        (
            SHAFT | fixed(GROUND, "post") | {"rub": Joint("contact", "disc", "post")},
            ("disc", "post"),
            [disc()],
            "post shall touch other bodies and has no plate",
        ),
        (SHAFT, ("disc",), [disc(body="gone")], "instance of body 'gone'"),
    ],
)
def test_what_cannot_be_said_is_refused(joints, bodies, parts, words):
    if words is None:  # two ways to the ground: the disc does not turn
        assert len(tree_of(joints, dict.fromkeys(bodies)).loops) == 1
        return
    with pytest.raises((GeometryError, KinematicsError), match=words) as caught:
        mjcf.assembly("x", parts, motion(joints, *bodies))
    assert "\n" not in str(caught.value)


def test_there_is_no_such_sample():
    with pytest.raises(GeometryError, match="there is no sample 5"):
        mjcf.assembly("x", [disc()], motion(SHAFT, "disc"), 5)


def test_a_material_without_density_has_no_mass(monkeypatch):
    from dataclasses import replace

    monkeypatch.setitem(materials.MATERIALS, "steel", replace(materials.MATERIALS["steel"], density=0.0))
    with pytest.raises(GeometryError, match="part disc is of steel, whose density is 0"):
        mjcf.assembly("x", [disc()], motion(SHAFT, "disc"))


def test_slides_hang_on_the_ground_and_pins_close():
    joints = {
        "shaft": Joint("revolute", GROUND, "crank"),
        "a": Joint("revolute", "crank", "rod"),
        "b": Joint("revolute", "rod", "slider"),
        "guide": Joint("prismatic", GROUND, "slider"),
    }
    tree = tree_of(joints, dict.fromkeys(("crank", "rod", "slider")))
    assert {branch.body: branch.parent for branch in tree.branches} == {
        "slider": GROUND,
        "crank": GROUND,
        "rod": "crank",
    }
    assert list(tree.loops) == ["b"]


def test_a_joint_that_is_said_backwards_counts_backwards():
    joints = {"shaft": Joint("revolute", GROUND, "arm"), "pin": Joint("revolute", "disc", "arm")}
    text = mjcf.assembly("x", [disc(), disc("arm", "arm")], motion(joints, "disc", "arm"))
    root = ElementTree.fromstring(text)  # noqa: S314 - our own
    assert root.find("worldbody/body[@name='arm']/body/joint").get("axis") == "0 0 -1"


def test_solids_weigh_what_closed_forms_say():
    import cadquery as cq

    part = Part("pin", None, 0.0, "brass", build=lambda: cq.Solid.makeCylinder(3, 10, cq.Vector(1, 2, 5)))
    found = Inertia.of(mass_moments(part))
    mass = math.pi * 90 * 8.5e-6
    assert found.mass == pytest.approx(mass, rel=1e-9)
    np.testing.assert_allclose(found.centre, (1, 2, 10), atol=1e-9)
    across = mass * (3 * 9 + 100) / 12
    np.testing.assert_allclose(found.tensor, np.diag([across, across, mass * 4.5]), atol=1e-9 * across)


def test_plates_weigh_the_same_as_their_solids():
    """The outline's moments by Green's theorem against the CAD kernel's, a plate with recesses and splines."""
    from mechwright_cad.solids.solid import part_solid
    from mechwright_geneva.family import Geneva

    params = Geneva.Params.model_validate({"counterbore_diameter": 30, "thickness": 13.5})
    wheel = next(part for part in Geneva().parts(params) if part.name == "wheel")
    solid = Part("solid", None, 0.0, wheel.material, build=lambda: part_solid(wheel))
    one, two = mass_moments(wheel), mass_moments(solid)
    np.testing.assert_allclose(one, two, rtol=0, atol=3e-5 * np.abs(two).max())


def test_a_part_by_itself_is_no_file():
    assert MjcfExporter().part(disc()) is None


def test_the_command_refuses_gears_of_changing_ratio(tmp_path, command_line):
    code, _, said = command_line(
        "model", ROOT / "examples/elliptic-pair.toml", "-o", tmp_path / "out", "--also", "mjcf"
    )
    assert code == 2
    assert "mjcf cannot hold a mechanism of the family elliptic-gears: the ratio of gear-2 and gear-4" in said
    assert len(said.strip().splitlines()) == 1
    assert not (tmp_path / "out").exists()


CHILD = """
import sys
from pathlib import Path
from mechwright import host
from mechwright.designs.design import load
from mechwright_cad.exporters.simulation import mjcf
design = load(Path(sys.argv[1]), host())
motion = design.family.solve(design.params, 37)
sys.stdout.buffer.write(mjcf.assembly(design.name, design.parts(), motion, 3))
"""


@by_night
def test_the_same_design_gives_the_same_bytes():
    call = [sys.executable, "-c", CHILD, str(ROOT / "examples/geneva-straight.toml")]
    one, two = (subprocess.run(call, capture_output=True, check=True).stdout for _ in range(2))
    assert one == two
    assert one.startswith(b"<mujoco model=")


def test_parts_without_a_place_make_no_mechanism():
    from types import SimpleNamespace

    from mechwright_cad.solid_models import Work

    alone = Part("alone", disc().outline, 2.0, "steel")
    design = SimpleNamespace(name="d", tables={}, family=SimpleNamespace(name="f", moves=False))
    work = Work(design, [MjcfExporter()], motion(SHAFT, "disc"), 0, [alone])
    with pytest.raises(GeometryError, match="mjcf holds whole mechanisms, and no part of this design"):
        work.files()
    silent = Work(design, [MjcfExporter()], motion({}, "disc"), 0, [disc()])
    with pytest.raises(GeometryError, match="mechanism of the family f: it does not say how its bodies"):
        silent.files()
