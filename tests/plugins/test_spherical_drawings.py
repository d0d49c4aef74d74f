"""Links and frame of spherical machines: what their drawings state, and how pins sit in them."""

import math
from pathlib import Path

import numpy as np
import pytest

from mechwright.contracts.free_form import AngleSize, RadiusSize
from mechwright.designs.design import load
from mechwright.plugins.host import host
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import shells_of
from mechwright_spherical.parts.mount import FACE
from mechwright_spherical.parts.parts import parts_of as made_of

EXAMPLES = Path(__file__).parents[2] / "examples"
MACHINES = ("spherical-machine", "spherical-double-crank-machine", "spherical-five-bar-machine")


@pytest.fixture(scope="module")
def designs():
    return {name: load(EXAMPLES / f"{name}.toml", host()) for name in MACHINES}


def parts_of(design):
    return {part.name: part for part in design.parts()}


def bores(part):
    return {one.name: one for one in part.free_form.bores}


@pytest.mark.parametrize("name", MACHINES)
def test_every_part_is_bought_or_has_a_drawing_or_a_program(designs, name):
    for part in designs[name].parts():
        if part.kind == "solid":
            assert part.free_form is not None, f"{part.name} is neither bought, drawn nor programmed"
            assert part.free_form.process
            assert part.free_form.sizes
            assert part.free_form.bores


def test_angles_of_the_drawings_are_the_arcs_of_the_design(designs):
    parts = parts_of(designs["spherical-machine"])
    for name, degrees in {"ground": 80, "crank": 30, "coupler": 70, "rocker": 60}.items():
        first = next(one for one in parts[name].free_form.sizes if isinstance(one, AngleSize))
        assert first.degrees == pytest.approx(degrees, abs=1e-9)
    shells = shells_of(designs["spherical-machine"].params)
    radii = [one.radius for one in parts["crank"].free_form.sizes if isinstance(one, RadiusSize)]
    assert radii == list(shells.arc("crank"))


@pytest.mark.parametrize("link", ["crank", "rocker"])
def test_bores_of_the_chart_are_those_of_the_solid(designs, link):
    """Cylinders that the CAD kernel finds in the solid, against the bores that are declared."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType

    part = parts_of(designs["spherical-machine"])[link]
    found = []
    for face in part.build().Faces():
        surface = BRepAdaptor_Surface(face.wrapped)
        if surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder and surface.Cylinder().Radius() < 4:
            axis, at = surface.Cylinder().Axis().Direction(), surface.Cylinder().Location()
            way, place = np.array((axis.X(), axis.Y(), axis.Z())), np.array((at.X(), at.Y(), at.Z()))
            assert np.linalg.norm(np.cross(place, way)) < 1e-9, "it passes the centre"
            found.append((2 * surface.Cylinder().Radius(), way))
    assert len(found) == len(part.free_form.bores) == 2
    for bore in part.free_form.bores:
        assert any(
            math.isclose(diameter, bore.diameter, abs_tol=1e-9) and abs(way @ np.array(bore.axis)) > 1 - 1e-12
            for diameter, way in found
        )


def test_pins_are_pressed_into_one_link_and_turn_in_the_other(designs):
    for name in MACHINES[:2]:
        parts = parts_of(designs[name])
        assert bores(parts["crank"])["a"].fit.short == "6 P7"
        assert bores(parts["rocker"])["c"].fit.short == "6 P7"
        assert bores(parts["crank"])["a0"].fit.short == bores(parts["rocker"])["b0"].fit.short == "6 H7"
        assert bores(parts["coupler"])["a"].fit.limits == pytest.approx((6.04, 6.052))
        assert bores(parts["coupler"])["tool"].fit.short == "6 P7"
    five = parts_of(designs["spherical-five-bar-machine"])
    assert bores(five["arm"])["b"].fit.short == "6 P7"
    assert bores(five["rocker"])["b"].fit.lower > 0
    assert bores(five["ground"])["a0"].fit.short == "10 H7"


def test_the_idler_turns_on_a_stud_that_is_pressed_and_has_a_ring(designs):
    parts = parts_of(designs["spherical-five-bar-machine"])
    assert bores(parts["ground"])["idler"].fit.short == "6 P7"
    assert bores(parts["idler"])["shaft"].fit.lower > 0
    stud, ring = parts["shaft-idler"], parts["circlip-idler"]
    groove = stud.turned.grooves[0]
    assert ring.instances[0].z == pytest.approx(stud.instances[0].z + groove.at)
    assert not {"spacer-a0", "spacer-idler"} & set(parts)


@pytest.mark.parametrize("name", MACHINES[:2])
def test_floats_of_the_shafts_close(designs, name):
    stacks = designs[name].stacks
    assert [one.name for one in stacks] == ["float of shaft-a0", "float of shaft-b0"]
    for one in stacks:
        low, high = one.play
        assert one.least <= low < high <= one.greatest
        assert {part.half for part in one.lengths if "faces" in part.name} == {2 * FACE}
        shaft = parts_of(designs[name])[one.name.removeprefix("float of ")]
        assert shaft.turned.lengths[0].nominal == one.lengths[0].nominal


def test_places_of_a_pin_that_is_set_have_limits_whether_it_is_there_or_not():
    four_bar = {"ground": 70, "input": 25, "coupler": 65, "output": 60, "branch": -1, "setting_angle": 50}
    four_bar["phases"] = [{"crank_turn": 40, "follower_turn": -20}]
    params = SphericalParams.model_validate({"kind": "four-bar", "four_bar": four_bar})
    coupler = next(part for part in made_of(params) if part.name == "coupler")
    places = [one for one in coupler.free_form.bores if one.name[:2] in {"a-", "c-"}]
    assert len(places) == 4
    assert all(one.fit.limits == pytest.approx((6.04, 6.052)) for one in places)
    assert set(coupler.vacant) == {one.name for one in places}
