"""Materials of a shop: figures of their own over those of the built-in one that they are like."""

import copy
import pickle

import pytest

from mechwright.contracts.materials import MATERIALS, material
from mechwright.contracts.own_materials import OwnMaterial, add_materials
from mechwright.errors import DesignError
from mechwright.mechanics.strength.allowed import allowed
from mechwright.standards.screws import least_engaged, needs_washer
from mechwright.standards.stock import plate_stock


@pytest.fixture(autouse=True)
def _clean():
    yield
    add_materials({})


def test_own_figures_lie_over_those_of_the_other() -> None:
    add_materials(
        {"bamboo": OwnMaterial(like="plywood", density=0.7, greatest_speed=400, order="bamboo, 3 ply")}
    )
    found, like = material("bamboo"), material("plywood")
    assert (found.density, found.modulus, found.speed) == (0.7, like.modulus, (like.speed[0], 400))
    assert (found.kind, found.soft, found.grades.plate) == ("wood", True, "bamboo, 3 ply")
    assert allowed("bamboo") == allowed("plywood")
    assert least_engaged("bamboo") == least_engaged("plywood")
    assert needs_washer(5, 5.5, "bamboo")
    assert plate_stock("bamboo") == plate_stock("plywood")


def test_those_of_another_shop_take_their_place() -> None:
    add_materials({"bamboo": OwnMaterial(like="plywood")})
    add_materials({"slate": OwnMaterial(like="mdf")})
    assert "bamboo" not in MATERIALS
    assert material("slate").name == "slate"


@pytest.mark.parametrize(
    ("name", "table", "said"),
    [
        ("steel", {"like": "brass"}, "is built in"),
        ("PVC", {"like": "pom"}, "hydrogen chloride"),
        ("odd", {"like": "pom", "least_speed": 900}, "least_speed 900 is above greatest_speed 500"),
    ],
)
def test_a_mistake_is_told_by_its_name_and_adds_nothing(name, table, said) -> None:
    with pytest.raises(DesignError, match=said):
        add_materials({"good": OwnMaterial(like="pom"), name: OwnMaterial(**table)})
    assert "good" not in MATERIALS


@pytest.mark.parametrize("name", ["pvc", "PVC", "vinyl"])
def test_what_nobody_should_cut_is_refused_for_its_fumes(name) -> None:
    with pytest.raises(DesignError, match="hydrogen chloride"):
        material(name)


def test_a_shop_takes_its_materials_into_another_process(tmp_path) -> None:
    from mechwright_cam.shop.workshop_file import read_shop

    path = tmp_path / "shop.toml"
    path.write_text(
        '[material.bamboo]\nlike = "plywood"\n[[tool]]\nname = "m"\nnumber = 1\nkind = "end-mill"\n'
        "diameter = 3\nflute_length = 12\n[tool.cutting]\nbamboo = { cutting_speed = 300, chip_load = 0.03 }\n"
    )
    shop = read_shop(path)
    assert "bamboo" in shop.library.tools[0].cutting
    packed = pickle.dumps(shop)
    add_materials({})
    pickle.loads(packed)  # noqa: S301 - packed here
    assert material("bamboo").group == "plywood"
    assert copy.copy(material("bamboo")) == material("bamboo")
