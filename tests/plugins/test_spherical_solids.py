"""Bodies, solids and flat strips: closed forms, and geometry computed another way."""

import math
import tomllib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.contracts.finding import Severity, errors
from mechwright_cad.solids.tessellate import mesh_of
from mechwright_spherical.defaults.complete_parameters import CompleteParams
from mechwright_spherical.family import Spherical
from mechwright_spherical.kinematics.bodies import pins_of_phase
from mechwright_spherical.kinematics.drive import external, internal, train_of
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.vectors import arc, direction, dot, rotate, vector
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts import links, solids
from mechwright_spherical.parts.bores import X
from mechwright_spherical.parts.flat import strip, strip_outline
from mechwright_spherical.parts.frame import shells_of
from mechwright_spherical.parts.hardware import FlatTable
from mechwright_spherical.parts.parts import parts_of
from mechwright_spherical.parts.places import (
    coupler_seats,
    gear_cones,
    gear_span,
    link_arcs,
    path_point,
    pin_places,
)
from mechwright_spherical.parts.seats import clamp_of

EXAMPLES = Path(__file__).parents[2] / "examples"
NAMES = ("spherical-five-bar-projected", "spherical-five-bar-refined", "spherical-crank-rocker")
FAMILY = Spherical()


def example(name):
    table = tomllib.loads((EXAMPLES / f"{name}.toml").read_text(encoding="utf-8"))
    return SphericalParams.model_validate(table["parameters"])


def made(params, name):
    """The solid of a part in the frame of its link: pins stand in frames of their own."""
    part = next(part for part in parts_of(params) if part.name == name)
    if part.turned is None:
        return part.build()
    span, _, angle = pin_places(params)[name]
    return solids.cylinder(direction(angle), shells_of(params).pins[span], part.turned.greatest)


def in_phase(params, phase):
    if params.kind == "four-bar":
        return params
    return params.model_copy(update={"five_bar": params.five_bar.model_copy(update={"phase": phase})})


@pytest.mark.parametrize("name", NAMES)
def test_examples_build_without_a_warning(name):
    params = example(name)
    assert {found.severity for found in FAMILY.check(params)} == {Severity.NOTE}
    for part in FAMILY.parts(params):
        if part.build is not None:
            solid = part.build()
            assert solid.isValid(), part.name
            assert len(solid.Solids()) == 1, part.name
            assert solid.Volume() > 0, part.name


def test_the_examples_are_what_they_say():
    projected, refined, rocker = (linkage_of(example(name)) for name in NAMES)
    worst = [max(float(phase.path_errors.max()) for phase in one.phases) for one in (projected, refined)]
    assert worst[0] / worst[1] == pytest.approx(74.57, abs=0.1)
    assert np.degrees(rocker.four_bar.arcs) == pytest.approx((80, 30, 70, 60))


# Bodies


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("phase", [1, 2])
def test_links_meet_in_their_pins(name, phase):
    """Every pin, seen from both bodies that it joins, is in the same place: all through, in both phases."""
    params = in_phase(example(name), phase)
    linkage = linkage_of(params)
    motion = FAMILY.solve(params, 7)
    now = linkage.phases[phase - 1] if linkage.five_bar else linkage.shown
    state = now.state(7)
    arcs = link_arcs(linkage)
    if phase == 2 and linkage.five_bar:
        arcs |= {
            "crank": float(linkage.five_bar.crank_arcs[1]),
            "rocker": float(linkage.five_bar.rocker_arcs[1]),
        }
    frame = pins_of_phase(linkage, 1)
    ends = [seat.places[now.number - 1] for seat in coupler_seats(linkage, frame)]
    where = {
        "a": [("crank", direction(arcs["crank"])), ("coupler", ends[0])],
        "c": [("rocker", direction(arcs["rocker"])), ("coupler", ends[1])],
        "b": [("rocker", X)],
        "p": [("coupler", path_point(linkage, frame))],
        "a0": [("crank", X), ("ground", X)],
        "b0": [("ground", direction(arcs["ground"]))],
    }
    if linkage.five_bar:
        where["b"].append(("arm", direction(arcs["arm"])))
        where["b0"].append(("arm", X))
    for pin, holders in where.items():
        wanted = getattr(state, pin)[0].T if pin in "abcp" else np.tile(getattr(now.loop, pin), (7, 1))
        for body, own in holders:
            seen = motion.poses[body].transform(own[None])[:, 0]
            np.testing.assert_allclose(seen, wanted, atol=1e-12, err_msg=f"pin {pin} on {body}")


@pytest.mark.parametrize("name", NAMES[:2])
def test_the_coupler_stands_still_while_the_machine_is_adjusted(name):
    params = example(name)
    poses = [FAMILY.solve(in_phase(params, phase), 2).poses for phase in (1, 2)]
    for body in ("coupler", "arm", "ground", "pinion", "idler", "base"):
        np.testing.assert_allclose(
            poses[0][body].rotation[0], poses[1][body].rotation[0], atol=1e-12, err_msg=body
        )
    turned = poses[0]["crank"].rotation[0].T @ poses[1]["crank"].rotation[0]
    setting = float(linkage_of(params).five_bar.crank_setting)
    assert math.acos((np.trace(turned) - 1) / 2) == pytest.approx(setting, abs=1e-9)


@pytest.mark.parametrize("ratio", [0.5, -0.5, 0.8])
def test_gears_roll_without_slip(ratio):
    """On the line where two pitch cones touch, both surfaces move alike."""
    params = SphericalParams.model_validate(
        {"radius": 160, "five_bar": {"ratio": ratio, "travel": -20, "travel_n": -20}}
    )
    linkage, motion = linkage_of(params), FAMILY.solve(params, 3)
    train = train_of(linkage, params.drive)
    axes = {"pinion": linkage.five_bar.a0, "wheel": linkage.five_bar.b0, "idler": train.idler_axis}
    cones = gear_cones(train)

    def speed(name):
        body = cones[name][0]
        turn = motion.poses[body].rotation[1] @ motion.poses[body].rotation[0].T
        axial = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
        return math.asin(max(-1.0, min(1.0, float(dot(axial, axes[name])))))

    pairs = [("pinion", "wheel")] if train.idler_axis is None else [("pinion", "idler"), ("idler", "wheel")]
    for one, two in pairs:
        angles = cones[one][1], cones[two][1]
        assert float(arc(axes[one], axes[two])) == pytest.approx(sum(angles), abs=1e-12)
        slip = speed(one) * math.sin(angles[0]) + speed(two) * math.sin(angles[1])
        assert abs(slip) < 1e-12
    assert speed("wheel") / speed("pinion") == pytest.approx(ratio, abs=1e-9)


@given(st.floats(0.05, 1.5), st.floats(0.05, 0.95))
def test_pitch_cones_touch_and_have_the_ratio(shafts, ratio):
    one, two = external(shafts, ratio)
    assert math.sin(one) == pytest.approx(ratio * math.sin(two), rel=1e-12)
    assert one + two == pytest.approx(shafts)
    one, two = internal(shafts, ratio)
    assert math.sin(one) == pytest.approx(ratio * math.sin(two), rel=1e-9)
    assert two - one == pytest.approx(shafts)


# Solids

RADIUS = st.floats(20, 200)
ANGLE = st.floats(0.1, 2.9)


@settings(max_examples=12)
@given(RADIUS, st.floats(1, 15), st.floats(1, 15), ANGLE)
def test_volumes_of_arcs_are_their_closed_forms(inner, thickness, width, angle):
    u, v = np.array([0.6, 0.0, 0.8]), rotate(vector([0.8, 0.5, -0.6]), 0.0, np.array([0.0, 1.0, 0.0]))
    v = rotate(vector(np.cross(u, v)), angle, u)
    outer = inner + thickness
    body = solids.arc_body(u, v, (inner, outer), width)
    assert body.isValid()
    assert body.Volume() == pytest.approx(width * (outer**2 - inner**2) / 2 * angle, rel=1e-6)
    shell = solids.shell_strip(u, v, (inner, outer), width)
    sine = width / (inner + outer)
    assert shell.Volume() == pytest.approx(2 * sine * (outer**3 - inner**3) / 3 * angle, rel=1e-6)
    middle = rotate(vector(np.cross(u, v)), angle / 2, u) * (inner + outer) / 2
    for one in (body, shell):
        assert one.isInside(tuple(middle.tolist())), "the arc goes the other way round"


def test_arcs_of_a_design_have_their_closed_forms():
    """Links less their bosses, for all links of the examples."""
    for name in NAMES:
        params = example(name)
        shells, linkage = shells_of(params), linkage_of(params)
        for link, angle in link_arcs(linkage).items():
            low, high = shells.arc(link)
            body = solids.arc_body(X, direction(angle), (low, high), params.hardware.link_width)
            assert body.Volume() == pytest.approx(
                params.hardware.link_width * (high**2 - low**2) / 2 * angle, rel=1e-6
            )


@pytest.mark.parametrize("name", NAMES[:2])
def test_slots_let_their_pins_through(name):
    """Screws in between the two seats do not touch the coupler; thicker ones do, and studs bear on it."""
    params = example(name)
    linkage = linkage_of(params)
    coupler = made(params, "coupler")
    span = shells_of(params).links["coupler"]
    thread = clamp_of(params).size.size
    for seat in coupler_seats(linkage, pins_of_phase(linkage, 1)):
        for share in (0.0, 0.3, 0.5, 0.8, 1.0):
            at = rotate(seat.axis, share * seat.sweep, seat.ends[0])
            if name == NAMES[1]:
                screw = solids.cylinder(at, span, thread)
                assert screw.intersect(coupler).Volume() < 1e-6
            thick = solids.cylinder(at, span, params.hardware.pin_diameter)
            assert thick.intersect(coupler).Volume() > 1


def test_a_rocker_of_the_second_phase_brings_its_own_pin():
    """Pins that no screw clamps are pressed into their link, and so are exchanged with it."""
    one = CompleteParams(radius=40)
    two = in_phase(one, 2)
    assert clamp_of(one) is None
    shown = [{part.name for part in FAMILY.parts(params) if part.instances} for params in (one, two)]
    assert {"rocker", "pin-c"} <= shown[0]
    assert {"rocker-n", "pin-c-n"} <= shown[1]
    assert not {"rocker-n", "pin-c-n"} & shown[0]
    assert not {"rocker", "pin-c"} & shown[1]
    for own in ("", "-n"):
        pin, rocker = (made(two, f"{name}{own}") for name in ("pin-c", "rocker"))
        assert pin.intersect(rocker).Volume() < 1e-6
    assert made(two, "pin-c").intersect(made(two, "rocker-n")).Volume() > 1e-3


def test_a_face_narrower_than_the_chord_is_divided_more_finely():
    coupler = made(CompleteParams(radius=40), "coupler")
    mesh = mesh_of(coupler, ruled=False, tolerance=0.1)
    corners = mesh.points[mesh.triangles]
    volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert volume == pytest.approx(coupler.Volume(), rel=0.01)


def test_pins_fit_their_bores_and_nothing_else_is_there():
    params = example(NAMES[2])
    shells = shells_of(params)
    for part, (span, body, angle) in pin_places(params).items():
        pin = made(params, part)
        low, high = shells.pins[span]
        assert pin.Volume() == pytest.approx(
            math.pi / 4 * params.hardware.pin_diameter**2 * (high - low), rel=1e-9
        )
        if body in ("crank", "rocker"):
            link = made(params, body)
            assert pin.intersect(link).Volume() < 1e-6
            fat = solids.cylinder(direction(angle), shells.links[body], params.hardware.boss_diameter - 0.1)
            assert fat.intersect(link).Volume() > 100


def test_the_shell_section_changes_the_links():
    one, two = (SphericalParams.model_validate({"hardware": {"section": s}}) for s in ("rectangle", "shell"))
    volumes = [made(params, "arm").Volume() for params in (one, two)]
    assert volumes[0] != pytest.approx(volumes[1], abs=1e-3)
    assert volumes[0] == pytest.approx(volumes[1], rel=5e-3)


@pytest.mark.parametrize(
    ("name", "body"),
    [
        ("spherical-machine", "coupler"),
        ("spherical-double-crank-machine", "coupler"),
        ("spherical-five-bar-machine", "ground"),
    ],
)
def test_no_arc_of_a_link_with_several_is_lost_in_the_shell_section(name, body):
    """The sides of two strips are cones with one tip: the kernel kept one of the strips alone."""
    params = example(name)
    shell = params.model_copy(update={"hardware": params.hardware.model_copy(update={"section": "shell"})})
    flat, true = (made(one, body) for one in (params, shell))
    assert true.isValid()
    assert true.Volume() == pytest.approx(flat.Volume(), rel=3e-3)


def test_gears_end_on_their_cones():
    params = example(NAMES[1])
    train = train_of(linkage_of(params), params.drive)
    low, high = gear_span(params, shells_of(params), train)
    for name, (_, angle) in gear_cones(train).items():
        box = made(params, name).BoundingBox()
        assert box.xmax == pytest.approx(high * math.cos(angle), abs=1e-6)
        assert box.xmin == pytest.approx(low * math.cos(angle), abs=1e-6)
        assert box.ymax == pytest.approx(high * math.sin(angle) - links.PITCH_PLAY, abs=1e-6)


# Flat strips


@given(ANGLE, st.floats(30, 200), st.floats(0.5, 6), st.floats(0.5, 8), st.floats(0.2, 0.5))
def test_a_bent_strip_has_its_bores_on_the_joints(angle, radius, thickness, bend, neutral):
    """Walk along the neutral fibre: straight, bend, straight; the bores' axes then meet in the centre."""
    flat = FlatTable(thickness=thickness, bend_radius=bend, neutral=neutral)
    found = strip(angle, radius, flat)
    fibre = bend + neutral * thickness
    # Start on the first joint, on the neutral fibre of its facet; the centre lies radius below the inner face.
    height = radius + neutral * thickness
    at, heading, walked = complex(0.0, height), 1.0 + 0j, 0.0
    for middle in found.middles:
        straight = middle - fibre * found.angle / 2 - walked
        assert straight > -1e-9
        at += straight * heading
        centre = at - 1j * heading * fibre
        at = centre + (at - centre) * np.exp(-1j * found.angle)
        heading *= np.exp(-1j * found.angle)
        walked = middle + fibre * found.angle / 2
    at += (found.length - walked) * heading
    wanted = height * np.exp(1j * (math.pi / 2 - angle))
    assert abs(at - wanted) < 1e-9 * radius
    assert abs(heading - np.exp(-1j * angle)) < 1e-9
    assert found.angle <= math.radians(60) + 1e-12


def test_a_strip_is_drawn_with_its_bores_and_a_pair_of_notches_for_each_bend():
    found = strip(math.radians(100), 80.0, FlatTable())
    outline = strip_outline(found, 12.0, 6.05)
    assert found.bends == 2
    assert sum(segment.tag == "bend" for segment in outline.outer.segments) == 4
    assert len(outline.inner) == 2
    area = 12 * found.length + math.pi * 36 - 2 * math.pi * 6.05**2 / 4 - 4 * math.pi * 1.5**2 / 2
    assert outline.area == pytest.approx(area, abs=1e-6)
    outline.polygon()


def test_strips_that_cannot_be_bent_are_left_out_and_told_of():
    """Asked for they are an error; a design that says nothing builds without them."""
    small = Spherical().Params(kind="four-bar", radius=10)
    found = Spherical().check(small)
    assert errors(found) == []
    assert [one.severity for one in found if one.code == "spherical.strip"] == [Severity.NOTE]
    assert not [part for part in Spherical().parts(small) if part.name.startswith("flat-")]
    asked = small.model_copy(update={"flat": FlatTable(make=True)})
    assert {one.code for one in errors(Spherical().check(asked))} == {"spherical.strip"}


def test_strips_are_made_where_all_of_them_can_be_bent():
    usual = Spherical().Params(kind="four-bar")
    said = usual.model_copy(update={"flat": FlatTable(make=True)})
    names = [[part.name for part in Spherical().parts(one)] for one in (usual, said)]
    assert names[0] == names[1]
    assert "flat-crank" in names[0]
