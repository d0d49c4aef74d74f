"""What planning cannot make it refuses, with the reason and the remedy."""

import math

import pytest
import shapely
from by_control import posted, prove
from by_night import thinned
from planning_parts import LIBRARY, rounded_box

from mechwright.contracts.details import Chamfer, Engraving
from mechwright.contracts.part import OpenProfile, Part, Pocket, Profile
from mechwright.errors import DesignError, GeometryError, ToolError
from mechwright.geometry import Line, Loop, Outline, circle
from mechwright.geometry.lettering import lettering
from mechwright_cam.planning import choose_tools, plan
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings

RIM = rounded_box(60, 40, 4)


def laid(*features, rim=RIM, thickness=8.0, details=(), tools=(), **settings):
    """A plate whose cutters the library offers, or some of them."""
    machined = (*features, Profile("outside", rim, "outside", 0.0, thickness))
    whole = Part("plate", Outline(rim, ()), thickness, "aluminium", machined=machined, details=details)
    cam = CamSettings.model_validate({"tools": tools, **settings})
    return make_job(whole, cam, choose_tools(whole, cam, LIBRARY))


def proven(of):
    program = plan(of)
    proof = prove(posted(of, program), of)
    assert proof.ok, [check.message for check in proof.failures]
    return program


def used(program, name):
    return {s.tool.name for s in program.sections for o in s.operations if o.name.startswith(name)}


class TestFloorsWithFillets:
    @pytest.mark.parametrize("turned", [0.0, 0.5])
    @pytest.mark.parametrize("width", [4.2, 5.0, 5.9])
    def test_an_open_slot_narrower_than_the_mill_of_its_fillet(self, width, turned):
        """At its mouths the mill gets a little way in, which makes no slot."""
        slot = Pocket("slot", rounded_box(120, width, 0.5).moved(0, 0, turned), (), 0.0, 2.1, 1.0)
        with pytest.raises(ToolError, match=r"bull-6-r1 makes the floor of slot .* narrower mill"):
            plan(laid(slot))

    def test_a_passage_that_only_finer_mills_pass(self):
        arms = shapely.union_all(
            [shapely.box(-22, -8, -8, 8), shapely.box(8, -8, 22, 8), shapely.box(-10, -2.4, 10, 2.4)]
        )
        loop = Loop.polygon(list(arms.exterior.coords)[:-1])
        bar = Pocket("bar", loop, (), 0.0, 3.0, 1.0)
        with pytest.raises(ToolError, match=r"makes the floor of bar .* parts of it are narrower"):
            plan(laid(bar, tools=("bull-6-r1", "mill-3")))
        proven(laid(bar, tools=("bull-6-r1",)))

    @pytest.mark.parametrize(
        ("side", "size"), thinned(2, ["on", "left"], [(6.0, 1.0), (6.0, 3.0), (12.0, 3.0), (8.0, 1.0)])
    )
    def test_grooves_on_a_path_have_them_too(self, side, size):
        width, radius = size
        path = (Line((-15.0, 0.0), (15.0, 0.0)),)
        strip = OpenProfile("strip", 0.0, 4.0, path=path, side=side, width=width, floor_radius=radius)
        program = proven(laid(strip))
        assert {"bull-6-r1" if radius == 1.0 else "ball-6"} <= used(program, "strip")

    @pytest.mark.parametrize("radius", [3.0, -1.0])
    def test_a_fillet_higher_than_the_groove(self, radius):
        with pytest.raises(GeometryError, match=r"the floor_radius is .* not 0 to its depth of 1 mm"):
            OpenProfile(
                "strip", 0.0, 1.0, path=(Line((0, 0), (9, 0)),), side="on", width=6.0, floor_radius=radius
            )


class TestDetails:
    @pytest.mark.parametrize("depth", [0.2, 1.0])
    def test_an_engraving_over_a_recess(self, depth):
        recess = Pocket("recess", rounded_box(30, 20, 3), (), 0.0, depth)
        mark = Engraving("mark", lettering("AB", 5, (-5.0, 0.0), 0.0), 0.2, 0.6)
        with pytest.raises(DesignError, match="the engraving mark runs over recess"):
            plan(laid(recess, details=(mark,)))
        beside = Engraving("mark", lettering("AB", 5, (-5.0, 15.0), 0.0), 0.2, 0.6)
        proven(laid(recess, details=(beside,)))

    def test_a_chamfer_as_deep_as_the_recess(self):
        loop = rounded_box(24, 16, 3)
        for depth, width, good in ((0.5, 0.2, True), (0.5, 0.5, False), (1.0, 1.0, False), (1.0, 0.9, True)):
            recess = Pocket("recess", loop, (), 0.0, depth)
            edge = Chamfer("edge", loop, "inside", width)
            if good:
                proven(laid(recess, details=(edge,)))
            else:
                with pytest.raises(DesignError, match=f"would cut the floor {depth:g} mm below its edge"):
                    plan(laid(recess, details=(edge,)))


class TestOpenRecesses:
    @pytest.mark.parametrize(("edge", "turned"), thinned(3, [0.0, 5.0, 9.0], [0.0, 10.0, 28.0, 45.0, 70.0]))
    def test_over_a_straight_edge_at_any_angle(self, edge, turned):
        """Of plate and recess a skin may stay across the mouth that is no wall, as thin as rounding."""
        rim = Loop.polygon([(-25, -edge), (25, -edge), (25, 30), (-25, 30)]).moved(0, 0, math.radians(turned))
        for recess in (Loop((circle((0, 0), 10),)), rounded_box(20, 20, 4).moved(0, 0, math.radians(turned))):
            proven(laid(Pocket("recess", recess, (), 0.0, 1.0), rim=rim, thickness=6.0, tools=("mill-6",)))

    @pytest.mark.parametrize("edge", [9.5, 9.0, 8.5])
    def test_with_cutter_compensation(self, edge):
        """No scrap of an arc at the end of the wall, which would run all the way round when it is printed."""
        rim = Loop.polygon([(-25, -edge), (25, -edge), (25, 30), (-25, 30)])
        recess = Pocket("recess", Loop((circle((0, 0), 10),)), (), 0.0, 1.0)
        proven(laid(recess, rim=rim, thickness=6.0, tools=("mill-4",), compensation="control"))


def test_an_outline_that_cuts_itself():
    bow = Loop.polygon([(-20, -10), (20, 10), (20, -10), (-20, 10)])
    with pytest.raises(GeometryError, match="cuts itself"):
        laid(rim=bow)


def test_a_ball_cuts_what_nothing_else_enters():
    """Else it is for floors with its own radius: where mills of other kinds get in, it is not asked."""
    narrow = Pocket("narrow", rounded_box(9, 9, 3.2), (), 0.0, 4.0)
    assert used(proven(laid(narrow, tools=("mill-10", "ball-6"))), "narrow") == {"ball-6"}
    dish = Pocket("dish", Loop((circle((15, 0), 8),)), (), 0.0, 4.0, 3.0)
    sharp = Pocket("sharp", Loop.polygon([(-25, -8), (-5, -8), (-5, 8), (-25, 8)]), (), 0.0, 2.0)
    program = proven(laid(dish, sharp, tools=("mill-10", "ball-6")))
    assert used(program, "sharp") == {"mill-10"}
    assert "ball-6" in used(program, "dish")
