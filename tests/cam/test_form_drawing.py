"""Drawings of parts of free form: what they state, against the solid, and their files."""

import io
import math
from functools import partial

import cadquery as cq
import ezdxf
import numpy as np
import pytest

from mechwright.contracts.fits import hole_fit
from mechwright.contracts.free_form import AngleSize, FormBore, FreeForm, LengthSize, RadiusSize
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError
from mechwright_cad.form_drawing.chart import direction_of, is_radial, rows_of
from mechwright_cad.form_drawing.dimensions import shown_in
from mechwright_cad.form_drawing.drawing import form_sheet
from mechwright_cad.form_drawing.projection import FRONT, LEFT, RIGHT, TOP, projected
from mechwright_cad.sheet.frame import MARGIN
from mechwright_cad.sheet.settings import DrawingSettings
from mechwright_cad.sheet.sheet import Dimension, Fill, Stroke, Text, width_of
from mechwright_cad.sheet.title import TitleBlock
from mechwright_cad.sheet.to_dxf import dxf
from mechwright_cad.sheet.to_pdf import pdf

CENTRE, X = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)
LEANING = (math.cos(0.5), math.sin(0.5), 0.0)


def ring_piece():
    """A ring of 40 to 50 mm radius, 12 mm wide, 60° of it."""
    profile = cq.Workplane("XZ").moveTo(40, -6).lineTo(50, -6).lineTo(50, 6).lineTo(40, 6).close()
    return profile.revolve(60, (0, 0, 0), (0, 1, 0)).val().rotate((0, 0, 0), (0, 0, 1), -15)


def arm():
    bores = (
        FormBore("a", (40.0, 0.0, 0.0), X, 10.0, 5.986, hole_fit(6, "P7")),
        FormBore("b", tuple(40 * a for a in LEANING), LEANING, 10.0, 5.986, hole_fit(6, "P7")),
    )
    sizes = (
        AngleSize(CENTRE, X, LEANING),
        RadiusSize(CENTRE, 40.0, LEANING),
        RadiusSize(CENTRE, 50.0, LEANING),
        LengthSize((45.0, 0.0, -6.0), (45.0, 0.0, 6.0)),
    )
    form = FreeForm(
        partial(ring_piece), "five-axis milling", bores, sizes, centre=True, notes=("Mind the burr",)
    )
    return Part("arm", None, 0.0, "aluminium", free_form=form)


BLOCK = TitleBlock("design", DrawingSettings())


@pytest.fixture(scope="module")
def sheet():
    return form_sheet(arm(), BLOCK)


def texts(sheet):
    return [
        item.text if isinstance(item, Text) else item.text.text
        for item in sheet.items
        if isinstance(item, Text | Dimension)
    ]


def test_it_states_angle_radii_width_and_the_limits_of_bores(sheet):
    shown = texts(sheet)
    assert f"{round(math.degrees(0.5), 4):g}°" in shown
    assert {"R40", "R50", "12", "⌀6 P7 (-0.02/-0.008)", "40 to 50"} <= set(shown)
    assert {
        "Mind the burr",
        "Process: five-axis milling",
        "Form by arm.step; this drawing states sizes and limits",
    } <= {*shown}
    volume = arm().build().Volume()
    assert f"{volume * 2.7 / 1000:.4g} g" in shown


def test_everything_is_on_the_sheet_and_beside_the_title_block(sheet):
    for item in sheet.items:
        match item:
            case Stroke(points=points) | Fill(points=points):
                found = points
            case Text():
                x, y = item.left
                found = [(x, y), (x + width_of(item.text, item.height), y + item.height)]
            case Dimension():
                found = [point for piece in item.strokes for point in piece.points]
        for x, y in found:
            assert MARGIN - 0.01 <= x <= sheet.width - MARGIN + 0.01, item
            assert MARGIN - 0.01 <= y <= sheet.height - MARGIN + 0.01, item


def test_the_chart_states_directions_and_faces():
    one, two = rows_of(arm().free_form)
    assert one == ("a", "⌀6 P7 (-0.02/-0.008)", "0°", "0°", "40 to 50")
    assert two[2:] == (f"{round(math.degrees(0.5), 4):g}°", "0°", "40 to 50")
    up = FormBore("up", (3.0, 4.0, 5.0), (0.0, 0.0, 1.0), 2.0, 4.0)
    assert not is_radial(up)
    assert direction_of(up) == (0.0, 90.0)
    assert rows_of(FreeForm(ring_piece, "casting", (up,)))[0] == (
        "up",
        "⌀4",
        "0°",
        "90°",
        "from (3, 4, 5), 2 long",
    )


def test_views_stand_as_first_angle_projection_has_them():
    """A block with a step on its right, upper, front corner."""
    block = cq.Workplane("XY").box(20, 10, 6, centered=False).val()
    bounds = {}
    for view in (FRONT, TOP, LEFT):
        found = np.array([point for line in projected(block, view).visible for point in line])
        bounds[view.name] = (*found.min(axis=0), *found.max(axis=0))
    assert bounds["front"] == pytest.approx((0, 0, 20, 10), abs=1e-3)
    assert bounds["top"] == pytest.approx((0, -6, 20, 0), abs=1e-3), "what is in front is below"
    assert bounds["left"] == pytest.approx((0, 0, 6, 10), abs=1e-3), "what is in front is on the right"


def test_a_bore_is_hidden_from_the_side_and_seen_end_on():
    holed = cq.Workplane("XY").box(20, 20, 20).faces(">Z").workplane().hole(6).val()
    front, top = projected(holed, FRONT), projected(holed, TOP)
    radius = [np.hypot(*np.array(line).T) for line in front.visible]
    assert any(np.allclose(one, 3.0, atol=0.01) for one in radius)
    assert all(not np.allclose(np.abs(np.array(line)[:, 0]), 3.0, atol=1e-3) for line in top.visible)
    assert sum(np.allclose(np.abs(np.array(line)[:, 0]), 3.0, atol=1e-3) for line in top.hidden) >= 2


def test_a_size_is_drawn_where_it_is_true():
    assert shown_in(AngleSize(CENTRE, X, LEANING)) == FRONT
    assert shown_in(LengthSize((1, 1, 0), (1, 1, 5))) == LEFT
    assert shown_in(LengthSize((0, 0, 0), (3, 4, 0))) is None, "neither level nor upright"
    assert shown_in(RadiusSize(CENTRE, 5.0, (0.0, 0.6, 0.8))) == LEFT


def test_files_are_the_same_twice_and_have_hidden_lines(sheet):
    again = form_sheet(arm(), BLOCK)
    assert dxf(sheet) == dxf(again)
    assert pdf(sheet) == pdf(again)
    document = ezdxf.read(io.StringIO(dxf(sheet).decode()))
    assert not document.audit().errors
    assert document.layers.get("HIDDEN").dxf.linetype == "HIDDEN"
    hidden = document.modelspace().query('*[layer=="HIDDEN"]')
    assert len(hidden) > 3


def test_in_the_third_angle_the_top_view_stands_above_and_the_right_one_beside_the_front_view(sheet):
    third = form_sheet(arm(), TitleBlock("design", DrawingSettings(projection="third")))
    assert sorted(texts(third)) == sorted(texts(sheet))

    def height(drawn, text):
        (found,) = [item.at[1] for item in drawn.items if isinstance(item, Text) and item.text == text]
        return found

    # The chart stands beside the top view, the word where axes meet in the front view.
    assert height(sheet, "Bore") < height(sheet, "centre")
    assert height(third, "Bore") > height(third, "centre")
    assert RIGHT.towards.tolist() == [1.0, 0.0, 0.0]
    assert LEFT.towards.tolist() == [-1.0, 0.0, 0.0]


def test_a_part_of_another_kind_has_no_such_drawing():
    with pytest.raises(GeometryError, match="part block is of no free form"):
        form_sheet(Part("block", None, 0.0, "steel", build=ring_piece), BLOCK)
