"""Families that derive from the linkages: what their parameters have, and what they have not."""

from collections.abc import Sequence
from typing import ClassVar, Literal

import pytest
from pydantic import Field, ValidationError

from mechwright import DesignError, Stage
from mechwright.contracts.finding import errors
from mechwright.mechanics.planar.machine import Drive, Prismatic
from mechwright_linkage.catalogue.entry import GROUND, Entry, Length, bar
from mechwright_linkage.catalogue.six_bars import WattTwo
from mechwright_linkage.drafts import draft_of
from mechwright_linkage.family import Linkages
from mechwright_linkage.parameters import DRAWING, LinkageParams, dimensions


class Cylinder(Entry):
    """A cylinder that turns a rocker."""

    title = "Cylinder"
    output = "rocker"
    pin_links: ClassVar = {"A0": (GROUND, "barrel"), "B0": (GROUND, "rocker"), "B": ("rocker", "rod")}

    base: Length = Field(100.0, description="From A0 to B0.")
    rocker: Length = Field(70.0, description="From B0 to B.")

    def points(self):
        return {
            GROUND: bar("A0", "B0", self.base),
            "barrel": {"A0": 0j},
            "rocker": bar("B0", "B", self.rocker),
            "rod": {"B": 0j},
        }

    def slides(self) -> Sequence[Prismatic]:
        return (Prismatic("piston", "barrel", "rod", 0j, 0j),)

    def drive(self):
        return Drive("rod", "barrel")


class Pushed(LinkageParams):
    linkage: Literal["cylinder"] = Field("cylinder", description="One.")
    cylinder: Cylinder = dimensions(Cylinder(), "cylinder")


class Watt(LinkageParams):
    linkage: Literal["watt-2"] = Field("watt-2", description="One.")


class Drawn(LinkageParams):
    linkage: Literal["drawn", "watt-2"] = Field("watt-2", description="Two.")


def test_a_derived_class_has_the_tables_of_its_own_linkages_alone():
    tables = {name for name, one in LinkageParams.model_fields.items() if isinstance(one.default, Entry)}
    assert len(tables) == 20
    assert tables & Watt.model_fields.keys() == {"watt_2"}
    assert tables & Pushed.model_fields.keys() == set()
    assert list(Watt.entries()) == ["watt-2"]
    assert Pushed.entries() == {"cylinder": Cylinder}
    assert len(LinkageParams.entries()) == 20


def test_drawings_go_with_the_name_drawn():
    assert not DRAWING & Watt.model_fields.keys()
    assert Drawn.model_fields.keys() >= DRAWING
    with pytest.raises(ValidationError, match="points"):
        Watt.model_validate({"points": {"A": {"x": 1}}})
    assert "jansen" not in Watt.model_json_schema()["properties"]


def test_a_stroke_goes_with_a_driver_that_slides():
    assert {"stroke_from", "stroke_to"} <= Pushed.model_fields.keys()
    assert not {"stroke_from", "stroke_to"} & Watt.model_fields.keys()
    assert Watt().stroke_from is None


def test_a_derived_class_is_the_same_design_as_one_of_the_catalogue():
    class Watts(Linkages):
        name = "watts"
        Params = Watt

    own, of_catalogue = Watts().solve(Watt(), 9), Linkages().solve(LinkageParams(linkage="watt-2"), 9)
    assert own.scalars == of_catalogue.scalars
    assert Watts().draft("", "") == Watt()
    assert Watt().entry == WattTwo()


def test_what_a_design_begins_with_is_of_the_class():
    assert draft_of("", "", Watt) == Watt()
    with pytest.raises(DesignError, match="jansen"):
        draft_of("jansen", "", Watt)
    with pytest.raises(DesignError, match="reads no drawings; give one of watt-2"):
        draft_of("p.csv", "point,x,y,links", Watt)
    assert draft_of("", "").linkage == "jansen"


def test_a_linkage_without_room_for_its_layers_moves():
    params = LinkageParams(linkage="hoecken", pin_diameter=60)
    found = Linkages().check(params)
    assert [one.code for one in errors(found)] == ["linkage.layers"]
    assert errors(found, Stage.MOTION) == []
    assert Linkages().solve(params, 9).scalars["input_range"].value == pytest.approx(6.283185307)
