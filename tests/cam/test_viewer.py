"""What pages hold of bodies in space: forms against closed forms, poses against the motion, groups and names."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mechwright.contracts.bought import Bought
from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Channel, Motion, Poses, Trace
from mechwright.contracts.part import Instance, Part
from mechwright.contracts.shape import Shape, box, hexagon, ring, slot
from mechwright.geometry import Loop, Outline, circle
from mechwright_cad.animation.scene import scene
from mechwright_cad.assembly_guide import in_space
from mechwright_cad.viewer import forms
from mechwright_cad.viewer.groups import FASTENERS, FRAME, groups_of, is_fastener
from mechwright_cad.viewer.packed import corners, form, indices, packed, unpacked
from mechwright_cad.viewer.script import script_data

ANGLE = np.linspace(0, math.tau, 121)
SQUARE = Loop.polygon([(-20, -10), (20, -10), (20, 10), (-20, 10)])


def volume(points, triangles):
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def bought(name, shape, standard="", instances=()):
    return Part(
        name, None, 0.0, "steel", instances, bought=Bought(f"{name} as ordered", standard, shape=shape)
    )


def plate(name, *instances, thickness=8.0):
    return Part(name, Outline(SQUARE), thickness, "steel", instances)


def test_numbers_come_back_and_none_that_does_not_fit_is_held():
    values = np.array([-40_000, 0, 7, 2**31 - 1])
    assert unpacked(packed(values, "i4"), "i4").tolist() == values.tolist()
    with pytest.raises(OverflowError, match="do not fit into i2"):
        packed(values, "i2")


def test_a_form_is_within_a_step_of_its_mesh():
    points = np.random.default_rng(3).uniform(-80, 240, (500, 3))
    triangles = np.arange(498).reshape(-1, 3)
    one = form(points, triangles)
    assert one["step"] <= 0.006
    np.testing.assert_allclose(corners(one), points, atol=one["step"] / 2 + 1e-9)
    assert (indices(one) == triangles).all()


@pytest.mark.parametrize(
    ("shape", "wanted"),
    [
        (Shape((ring(4, 10, 6),)), math.pi * (25 - 4) * 6),
        (Shape((ring(0, 20, 3), hexagon(8, 3, 9))), math.pi * 300 + 6 * 64 * math.sqrt(3) / 2),
        (
            Shape((box((0, 30), (-6, 6), (0, 20)),), (slot((24, 31), 4, (2, 14)),)),
            7200 - 6 * (8 * 4 + math.pi * 4),
        ),
    ],
)
def test_the_volume_of_a_form_is_that_of_its_shape(shape, wanted):
    points, triangles = forms.form_of(bought("one", shape))
    assert volume(points, triangles) == pytest.approx(wanted, rel=0.03)


def test_a_slot_is_as_long_and_wide_as_it_is_and_round_where_it_is_said():
    for ends, area in (
        ((True, True), 32 + math.pi * 4),
        ((False, True), 40 + math.pi * 2),
        ((False, False), 48),
    ):
        points, triangles = forms.form_of(bought("key", Shape((slot((3, 8), 4, (1, 13), ends),))))
        assert points.min(axis=0) == pytest.approx((3, -2, 1))
        assert points.max(axis=0) == pytest.approx((8, 2, 13))
        assert volume(points, triangles) == pytest.approx(5 * area, rel=0.02)


def test_a_plate_is_as_thick_as_it_is_and_layers_of_one_rim_have_no_step():
    hole = Loop((circle((5, 2), 4, clockwise=True),))
    points, triangles = forms.form_of(Part("one", Outline(SQUARE, (hole,)), 8.0, "steel"))
    assert volume(points, triangles) == pytest.approx(8 * (800 - math.pi * 16), rel=2e-3)
    assert (points[:, 2].min(), points[:, 2].max()) == (0, 8)


def test_all_bodies_together_have_no_more_triangles_than_a_computer_moves():
    wheel = bought("wheel", Shape(tuple(ring(0, 400 - k, 1, k) for k in range(20))))
    few = [forms.form_of(wheel)]
    assert 4 * len(few[0][1]) < forms.MOST
    many = Part(**{**vars_of(wheel), "instances": tuple(Instance(f"b{k}") for k in range(20))})
    (found,) = forms.forms_of([many])
    assert len(found[1]) < len(few[0][1])


def vars_of(part):
    return {
        "name": part.name,
        "outline": None,
        "thickness": 0.0,
        "material": part.material,
        "bought": part.bought,
    }


def test_fasteners_are_a_group_and_so_is_what_moves_as_one():
    shape = Shape((ring(0, 5, 10),))
    assert is_fastener(bought("screw-m5x20", shape, "ISO 4762"))
    assert is_fastener(bought("circlip-12", shape, "DIN 471"))
    assert not is_fastener(bought("bearing-608", shape, "ISO 15"))
    assert not is_fastener(bought("motor", shape))
    assert not is_fastener(plate("screw-plate"))
    still = Poses.planar(0.0, 0.0, 0 * ANGLE)
    turned = Poses.planar(0.0, 0.0, ANGLE)
    from mechwright.contracts.joint import Joint

    motion = Motion(
        "phi",
        {"phi": Channel(ANGLE, "rad")},
        {"base": still, "wheel": turned, "spindle-wheel": turned},
        joints={
            "stands": Joint("fixed", GROUND, "base", (0.0, 0.0, 0.0)),
            "keyed": Joint("fixed", "wheel", "spindle-wheel", (0.0, 0.0, 0.0)),
        },
    )
    bodies = [
        SimpleNamespace(part=part, instance=Instance(body))
        for part, body in (
            (plate("a"), "base"),
            (bought("c", shape), "spindle-wheel"),
            (plate("b"), "wheel"),
            (bought("screw-m5x20", shape, "ISO 4762"), "base"),
        )
    ]
    assert groups_of(bodies, motion) == [FRAME, "wheel", "wheel", FASTENERS]


def machine_scene(**more):
    """A plate that lies, one that swings face down, and a pin on it."""
    shape = Shape((ring(0, 6, 20),))
    face_down = np.einsum(
        "nij,jk->nik", Rotation.from_euler("z", ANGLE[:, None]).as_matrix(), np.diag((1.0, -1.0, -1.0))
    )
    swing = Poses(np.column_stack((30 * np.cos(ANGLE), 30 * np.sin(ANGLE), 0 * ANGLE + 15.0)), face_down)
    motion = Motion(
        "phi",
        {"phi": Channel(ANGLE, "rad")},
        {"base": Poses.planar(0.0, 0.0, 0 * ANGLE), "arm": swing},
        traces={"P": Trace("arm", (20.0, 0.0, 0.0))},
    )
    parts = [
        plate("base", Instance("base", -3.0)),
        plate("arm", Instance("arm", 2.0)),
        bought("pin-6", shape, "ISO 2338", (Instance("arm", 4.0),)),
    ]
    return scene(parts, motion, solids=False, space=True, **more), motion


def test_a_machine_in_the_plane_is_shown_in_space_where_its_motion_has_it():
    found, motion = machine_scene()
    assert found["layers"], "the plan stays"
    assert found["missing"] == []
    assert [(mesh["name"], mesh.get("group"), mesh.get("off")) for mesh in found["meshes"]] == [
        ("base", "base", None),
        ("arm", "arm", None),
        ("pin-6", FASTENERS, True),
    ]
    for mesh in found["meshes"]:
        own = corners(found["forms"][mesh["form"]]) + np.array((0.0, 0.0, mesh.get("z", 0.0)))
        pose = found["poses"][mesh["body"]]
        x, y, angle = (np.broadcast_to(column, ANGLE.shape) for column in pose["columns"])
        flip = np.diag((1.0, -1.0, -1.0) if pose.get("down") else (1.0, 1.0, 1.0))
        turn = Rotation.from_euler("z", angle[:, None]).as_matrix() @ flip
        place = np.column_stack((x, y, np.full(len(ANGLE), pose.get("z", 0.0))))
        for time in (0, 17, 60, 101):
            wanted = motion.poses[mesh["body"]].transform(own)[time]
            np.testing.assert_allclose(own @ turn[time].T + place[time], wanted, atol=2.5e-3)
            away = np.linalg.norm(wanted - found["ball"]["centre"], axis=1)
            assert away.max() <= found["ball"]["radius"] + 0.02
    np.testing.assert_allclose(found["traces"]["P"], motion.path("P"), atol=1e-3)
    assert found["up"] == [0, 0, 1]


def test_a_mechanism_of_too_many_triangles_is_not_drawn_and_said_so(monkeypatch):
    monkeypatch.setattr("mechwright_cad.animation.space.LARGEST", 10)
    found, _ = machine_scene()
    assert found["large"] > 10
    assert (found["forms"], found["meshes"]) == ([], [])
    assert found["layers"], "the plan stays"


def test_without_a_plan_plates_alone_are_in_space_as_well():
    found, _ = machine_scene(plan=False)
    assert "layers" not in found
    assert len(found["meshes"]) == 3


def test_a_file_belongs_to_the_part_with_the_longest_name(monkeypatch):
    names = [
        "crank.step",
        "crank-pin.step",
        "crank-pin-drawing.pdf",
        "crank.nc",
        "setup.html",
        "crankcase.step",
    ]
    monkeypatch.setattr(
        in_space, "files_of", lambda build, wanted: [SimpleNamespace(name=name) for name in names]
    )
    build = SimpleNamespace(parts=[plate("crank"), plate("crank-pin")], wanted=None)
    assert in_space.names_of(build) == {
        "crank": ["crank.step", "crank.nc"],
        "crank-pin": ["crank-pin.step", "crank-pin-drawing.pdf"],
    }
    shown = in_space.parts_of(build.parts, {"crank": 12.3456}, in_space.names_of(build))
    assert shown[0] == {"name": "crank", "what": "steel", "mass": 12.35, "files": ["crank.step", "crank.nc"]}
    assert "mass" not in shown[1]


def test_no_name_ends_the_script_element():
    assert "<" not in script_data({"a</script><script>alert(1)</script>": ["<!--"]})
