"""Drawings for services, by a checker of their rules; and drawings that no service would take."""

import io

import ezdxf
import pytest
from cut_sheets import plate, toothed
from planning_parts import bore, keyed_bore, rounded_box

from mechwright.contracts.details import Engraving
from mechwright.contracts.part import Part
from mechwright.geometry import Outline
from mechwright_cut.jobs import cut_part
from mechwright_cut.rules.part_rules import part_findings
from mechwright_cut.rules.service_rules import service_findings
from mechwright_cut.service.checker import Drawn, faults
from mechwright_cut.service.drawing import service_drawing
from mechwright_cut.settings.cut_settings import CutSettings
from mechwright_cut.settings.services import services

MARK = Engraving("mark", (((-5.0, 6.0), (5.0, 6.0)),), 0.1)
PARTS = {
    "plate": plate("plate", bore(6), bore(5, (8, 0)), size=(40, 30, 4), details=(MARK,)),
    "wheel": toothed(radius=20.0, hole=8.0),
    "keyed": plate("keyed", keyed_bore(10, 3, 6.4), size=(40, 30, 4)),
    "steel": Part("steel", Outline(rounded_box(50, 30, 5), (bore(10),)), 3, "steel"),
}


def cut_of(part):
    return cut_part(part, CutSettings().kind("service", part.material), CutSettings())


def drawn(cut, rules):
    return Drawn(cut.outline, cut.part.thickness, rules.offset(cut.part.material))


@pytest.mark.parametrize("service", services())
@pytest.mark.parametrize("name", PARTS)
def test_drawings_pass_the_rules_of_every_service(service, name):
    rules, cut = services()[service], cut_of(PARTS[name])
    content = service_drawing(cut, rules)
    assert faults(content, drawn(cut, rules), rules) == []
    assert content == service_drawing(cut, rules), "the same bytes"


def test_a_drawing_holds_closed_contours_alone():
    rules = services()["sendcutsend"]
    document = ezdxf.read(io.StringIO(service_drawing(cut_of(PARTS["plate"]), rules).decode()))
    kinds = sorted(entity.dxftype() for entity in document.modelspace())
    assert kinds == ["CIRCLE", "CIRCLE", "LWPOLYLINE"]
    assert {entity.dxf.layer for entity in document.modelspace()} == {"CUT"}
    assert document.header["$INSUNITS"] == 4


def test_the_designer_allows_for_the_kerf_where_the_service_does_not():
    rules, cut = services()["ponoko"], cut_of(PARTS["plate"])
    document = ezdxf.read(io.StringIO(service_drawing(cut, rules).decode()))
    radii = sorted(entity.dxf.radius for entity in document.modelspace().query("CIRCLE"))
    assert radii == pytest.approx([2.4, 2.9])
    metal = ezdxf.read(io.StringIO(service_drawing(cut_of(PARTS["steel"]), rules).decode()))
    assert metal.modelspace().query("CIRCLE").first.dxf.radius == 5.0
    # The checker sees a drawing that forgot it.
    wrong = service_drawing(cut, services()["sendcutsend"])
    assert any("no contour is within 5 µm" in one for one in faults(wrong, drawn(cut, rules), rules))


def changed(change):
    """The drawing of the plate with something done to it."""
    rules, cut = services()["snapcut"], cut_of(PARTS["plate"])
    document = ezdxf.read(io.StringIO(service_drawing(cut, rules).decode()))
    change(document, document.modelspace())
    stream = io.StringIO()
    document.write(stream)
    return faults(stream.getvalue().encode(), drawn(cut, rules), rules)


def _open(document, space):
    space.query("LWPOLYLINE").first.close(False)


def _text(document, space):
    space.add_text("plate")


def _line(document, space):
    space.add_line((0, 0), (5, 0), dxfattribs={"layer": "CUT"})


def _twice(document, space):
    space.add_circle(
        space.query("CIRCLE").first.dxf.center, space.query("CIRCLE").first.dxf.radius, {"layer": "CUT"}
    )


def _overlap(document, space):
    space.add_circle((2, 0), 3, {"layer": "CUT"})


def _stray(document, space):
    space.add_circle((200, 0), 3, {"layer": "CUT"})


def _inches(document, space):
    document.header["$INSUNITS"] = 1


def _small(document, space):
    space.add_circle((0, 10), 1, {"layer": "CUT"})


def _moved(document, space):
    space.query("CIRCLE").first.dxf.center = (0.1, 0)


def _grown(document, space):
    space.query("CIRCLE").first.dxf.radius += 0.01


def _gone(document, space):
    space.delete_entity(space.query("CIRCLE").first)


def _bulged(document, space):
    line = space.query("LWPOLYLINE").first
    line[0] = (*line[0][:4], line[0][4] + 0.02)


def _crossed(document, space):
    line = space.query("LWPOLYLINE").first
    line.set_points([(-20, -15), (20, 15), (20, -15), (-20, 5)], format="xy")


def _centre(document, space):
    document.layers.add("CENTRE")
    space.add_circle((0, 0), 2, {"layer": "CENTRE"})


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (_open, "is open"),
        (_text, "must not be there"),
        (_line, "a LINE on layer CUT"),
        (_twice, "there twice"),
        (_overlap, "overlap"),
        (_stray, "outside the part"),
        (_inches, "not millimetres"),
        (_small, "below the least"),
        (_moved, "no contour is within"),
        (_grown, "no contour is within"),
        (_gone, "1 contours are drawn|2 contours are drawn"),
        (_bulged, "no contour is within"),
        (_centre, "layer CENTRE must not be there"),
        (_crossed, "cross themselves"),
    ],
)
def test_no_service_would_take_it(change, said):
    import re

    found = changed(change)
    assert any(re.search(said, one) for one in found), found


def test_a_service_names_what_it_refuses():
    rules = services()["snapcut"]  # 1.5 thicknesses, and 1 mm between two contours
    part = plate("p", bore(4), bore(6, (10, 0)), size=(40, 30, 4))
    cut = cut_of(part)
    (said,) = faults(service_drawing(cut, rules), drawn(cut, rules), rules)
    assert "the hole of 4.00 mm" in said
    small = cut_of(plate("p", size=(12, 8, 2)))
    assert (
        "15 mm and more"
        in faults(
            service_drawing(small, services()["acute-laser"]),
            drawn(small, services()["acute-laser"]),
            services()["acute-laser"],
        )[0]
    )


@pytest.mark.parametrize(
    ("service", "part", "said", "other"),
    [
        (
            "acute-laser",
            plate("p", bore(5, (-9, 0)), size=(24, 16, 3)),
            "0.50 mm stay between two cuts",
            "sendcutsend",
        ),
        (
            "acute-laser",
            plate("p", size=(12, 9, 2)),
            "parts of 15 mm and more, and it has 12.00",
            "sendcutsend",
        ),
        (
            "snapcut",
            plate("p", rounded_box(3.2, 3, 1.5, clockwise=True)),
            "is a hole of 3.12 mm",
            "sendcutsend",
        ),
        ("snapcut", plate("p", bore(8, (-7.2, 0)), size=(24, 16, 3)), "0.80 mm stay", "sendcutsend"),
    ],
)
def test_what_a_service_does_not_take_names_one_that_does(service, part, said, other):
    settings = CutSettings(service=service)
    cut = cut_part(part, settings.kind("service", "acrylic"), settings)
    (told,) = service_findings(cut, services()[service], jet=False)
    assert said in told.message
    assert told.proposed == ({"cut.service": other},)
    assert list(service_findings(cut, services()[other], jet=False)) == []
    drawn = Drawn(cut.outline, 3.0, services()[service].offset("acrylic"))
    assert faults(service_drawing(cut, services()[service]), drawn, services()[service]), (
        "nor does the checker"
    )


@pytest.mark.parametrize(
    ("service", "by", "least"),
    [
        ("snapcut", "laser", 4.5),
        ("acute-laser", "laser", 2.1),
        ("sendcutsend", "laser", 1.5),
        ("sendcutsend", "waterjet", 3.0),
    ],
)
def test_the_least_hole_is_that_of_the_service_and_of_its_process(service, by, least):
    settings = CutSettings(service=service, by=by)
    kind = settings.kind("service", "steel")
    assert kind.least_hole(3.0) == pytest.approx(least)
    assert services()[service].words in kind.words
    for diameter, small in ((least + 0.1, 0), (least - 0.1, 1)):
        cut = cut_part(plate("p", bore(diameter), material="steel"), kind, settings)
        found = [one for one in part_findings(cut, kind, 0.2, settings) if one.code == "cut.hole"]
        assert len(found) == small
