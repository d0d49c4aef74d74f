import math

import pytest

from mechwright.contracts.materials import MATERIALS, material
from mechwright.contracts.part import Bore, Part, Profile, check_name
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry import Arc, Loop, Outline, circle

BOX = Loop.polygon([(0, 0), (40, 0), (40, 30), (0, 30)])
SQUARE = Loop.polygon([(20, 10), (30, 10), (30, 20), (20, 20)]).reversed()
ROUND = Loop((circle((8, 8), 3, clockwise=True),))
HALVES = Loop((Arc((8, 20), 2, 0, -math.pi), Arc((8, 20), 2, math.pi, -math.pi)))


def test_features_are_the_loops_openings_first():
    part = Part("plate", Outline(BOX, (ROUND, SQUARE, HALVES)), 6.0, "steel")
    assert part.features == (
        Bore("bore-1", (8, 8), 6.0, 0, 6.0),
        Profile("opening-2", SQUARE, "inside", 0, 6.0),
        Profile("opening-3", HALVES, "inside", 0, 6.0),
        Profile("outside", BOX, "outside", 0, 6.0),
    )


def test_features_of_the_drawing_go_before_those_of_the_outline():
    own = (Profile("rim", BOX, "outside", 0, 6.0),)
    assert Part("plate", Outline(BOX, (ROUND,)), 6.0, "steel", machined=own).features == own
    assert Part("link", None, 0.0, "steel", build=lambda: None).features == ()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((None, 0.0), "either an outline or a solid"),
        ((Outline(BOX), 0.0), r"needs a thickness above 0 mm, not 0\.0"),
        ((Outline(BOX), math.nan), "needs a thickness above 0 mm, not nan"),
    ],
)
def test_parts_that_are_none(arguments, words):
    with pytest.raises(GeometryError, match=words):
        Part("plate", *arguments, "steel")


@pytest.mark.parametrize(
    "name", ["", "-", "a/b", "..", "a.b", "Plate", "a b", "a\n", "a" * 65, "é", "-a", "a-"]
)
def test_names_that_cannot_be_files_anywhere(name):
    with pytest.raises(DesignError, match="cannot be a file name"):
        Part(name, Outline(BOX), 6.0, "steel")


@pytest.mark.parametrize("name", ["con", "nul", "aux", "prn", "com1", "lpt9"])
def test_names_that_are_devices_on_windows(name):
    with pytest.raises(DesignError, match=f"part name '{name}' is that of a device on Windows; use another"):
        Part(name, Outline(BOX), 6.0, "steel")
    Part(f"{name}-1", Outline(BOX), 6.0, "steel")


@pytest.mark.parametrize("name", ["a", "gear-2", "a" * 64, "crank_pin", "0"])
def test_names_that_can(name):
    assert check_name(name) == name


def test_a_plate_says_how_thick_it_is_and_a_solid_of_its_own_does_not():
    assert repr(Part("plate", Outline(BOX), 6.5, "steel")).endswith(", 6.5 mm, steel>")
    assert " mm" not in repr(Part("lump", None, 6.5, "steel", build=lambda: None))


def test_materials_are_looked_up_by_name():
    assert material("steel").density == 7.85
    assert all(name == item.name for name, item in MATERIALS.items())
    with pytest.raises(DesignError, match=r"'wood' is not known; one of: 1\.4301, .*, aluminium, brass"):
        material("wood")
