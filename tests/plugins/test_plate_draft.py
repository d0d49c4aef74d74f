"""A plate that begins from a drawing of another program: each layer gets a meaning, and the design builds."""

import io
from pathlib import Path

import ezdxf
import pytest

from mechwright import DesignError
from mechwright.contracts.finding import errors
from mechwright.contracts.inputs import InputFile
from mechwright.drawings.reading import layers_of
from mechwright_plate.family import Plate
from mechwright_plate.params import PlateParams

EXAMPLE = Path(__file__).parents[2] / "examples" / "nema-17-plate.dxf"


def drawing(*, outline: str = "Plate Outline") -> bytes:
    document = ezdxf.new(units=4)
    space = document.modelspace()
    space.add_lwpolyline([(0, 0), (60, 0), (60, 40), (0, 40)], close=True, dxfattribs={"layer": outline})
    space.add_circle((15, 20), 3, dxfattribs={"layer": "Bohrungen"})
    space.add_lwpolyline(
        [(30, 10), (40, 10), (40, 30), (30, 30)], close=True, dxfattribs={"layer": "windows"}
    )
    space.add_line((0, -5), (5, -5), dxfattribs={"layer": "0"})
    out = io.StringIO()
    document.write(out)
    return out.getvalue().encode()


def test_layers_are_told_by_their_curves() -> None:
    assert layers_of(drawing()) == {
        "Plate Outline": "outline",
        "Bohrungen": "bore",
        "windows": "through",
        "0": "ignore",
    }


def test_with_an_outline_the_largest_other_contour_goes_through() -> None:
    assert layers_of(drawing(outline="OUTLINE"))["windows"] == "through"


def test_the_draft_is_a_plate_and_names_its_drawing() -> None:
    params = Plate().draft("foreign.dxf", drawing().decode())
    assert params.drawing.name == "foreign.dxf"
    assert not errors(Plate().check(params))
    (part,) = Plate().parts(params)
    assert part.outline is not None
    assert len(part.outline.inner) == 2


def test_layers_of_our_own_keep_their_meaning() -> None:
    text = EXAMPLE.read_text()
    params = Plate().draft("plate.dxf", text)
    plain = PlateParams(drawing=InputFile("plate.dxf", text.encode()))
    assert Plate().parts(params)[0].outline == Plate().parts(plain)[0].outline


def test_a_layer_without_a_meaning_is_refused_with_what_it_is_likely_to_be() -> None:
    params = PlateParams(drawing=InputFile("a.dxf", drawing()))
    found = errors(Plate().check(params))
    assert {one.code for one in found} == {"plate.layer"}
    change = {"parameters.layers": layers_of(drawing())}
    assert all(one.proposed == (change,) for one in found)


@pytest.mark.parametrize(("source", "text"), [("wheel", ""), ("a.dxf", "no drawing")])
def test_what_is_no_drawing_is_refused(source, text) -> None:
    with pytest.raises(DesignError):
        Plate().draft(source, text)
