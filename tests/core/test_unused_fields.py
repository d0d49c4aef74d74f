"""Fields that mean nothing with the values of the others: new files and remedies omit them."""

import tomllib
from collections.abc import Collection
from pathlib import Path

import pytest
from pydantic import Field

from mechwright.contracts.family import Family
from mechwright.contracts.parameters import Parameters
from mechwright.designs.design import design_of
from mechwright.designs.text import design_text, table_lines, template
from mechwright.plugins.host import host
from mechwright.remedies.keys import keys_of


class Round(Parameters):
    radius: float = Field(5.0, description="Of the circle.")


class Square(Parameters):
    side: float = Field(9.0, description="Of the square.")


class Shape(Parameters):
    kind: str = Field("round", description="round or square.")
    round: Round = Field(Round(), description="Of a circle.")
    square: Square = Field(Square(), description="Of a square.")

    def unused_fields(self) -> Collection[str]:
        return {"round", "square"} - {self.kind}


def test_a_table_that_is_not_chosen_is_not_written() -> None:
    assert [one for one in table_lines(Shape, "shape", Shape(kind="square")) if one.startswith("[")] == [
        "[shape]",
        "[shape.square]",
    ]
    assert Parameters().unused_fields() == ()


def of_linkage(text: str):
    return design_of(tomllib.loads(text), Path("new.toml"), "", host())


@pytest.mark.parametrize("name", ["jansen", "chebyshev"])
@pytest.mark.parametrize("short", [True, False])
def test_a_new_linkage_has_its_own_table_alone(name: str, short: bool) -> None:
    family = host().of(Family)["linkage"].item
    draft = family.draft(name, "")
    text = template(family, "new", [], short=short, draft=draft)
    content = tomllib.loads(text)["parameters"]
    assert [key for key, value in content.items() if isinstance(value, dict)] == [name]
    assert not {"points", "links", "driver"} & content.keys()
    design = of_linkage(text)
    assert design.params == draft
    assert {
        key.split(".")[1] for key in keys_of(design) if key.startswith("parameters.") and key.count(".") > 1
    } == {name}
    again = design_text(family, "new", design.params)
    assert of_linkage(again).params == design.params
