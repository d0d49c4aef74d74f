"""Parts as the text of a program leaves them, and mechanisms of such parts."""

from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from cut_sheets import beam, copies, plate, sheet_of, toothed, wire
from planning_parts import bore

from mechwright_cut.as_cut import parts_as_cut, parts_ordered
from mechwright_cut.jobs import cut_part
from mechwright_cut.service.drawing import service_drawing
from mechwright_cut.settings.cut_settings import CutSettings
from mechwright_cut.settings.services import services


def made(job, control="grbl-laser", change=lambda text: text):
    text, _ = beam(job, control)
    suffix = ".nc" if control == "grbl-laser" else ".ngc"
    return list(parts_as_cut(SimpleNamespace(job=job, text=change(text), suffix=suffix)))


@pytest.mark.parametrize("control", ["grbl-laser", "linuxcnc-beam"])
def test_walls_stand_where_they_are_drawn(control):
    job = sheet_of(toothed(), copies(plate("plate", bore(5), bore(3, (8, 0)), size=(20, 16, 3)), 2))
    found = made(job, control)
    assert sorted(one.label for one in found) == ["plate no 1", "plate no 2", "wheel"]
    for one in found:
        part = next(piece.cut.part for piece in job.pieces if piece.label == one.label)
        assert np.abs(one.off).max() < 0.005
        drawn = part.outline.polygon()
        assert shapely.symmetric_difference(one.outline.shape(), drawn).area < 0.005 * drawn.length
    hole = next(one for one in found if one.name == "plate").hole_at(8.0, 0.0, 3.0)
    assert (hole.x, hole.y, hole.diameter) == pytest.approx((8, 0, 3), abs=0.005)


def test_walls_of_a_wire_stand_on_its_contour_with_the_last_register():
    part = toothed(material="steel", hole=5.0)
    job = sheet_of(part, process="wire", start_hole=0.5)
    text, _ = wire(job)
    (one,) = parts_as_cut(SimpleNamespace(job=job, text=text, suffix=".iso"))
    assert np.abs(one.off).max() < 0.005
    # 0.03 mm more than half of the kerf in D stay on every wall, in the bore as well
    wide = sheet_of(part, process="wire", start_hole=0.5, offsets=[job.kerf.width / 2 + 0.03])
    (left,) = parts_as_cut(SimpleNamespace(job=wide, text=text, suffix=".iso"))
    assert left.off == pytest.approx(0.03, abs=0.005)
    assert left.hole_at(0.0, 0.0, 5.0).diameter == pytest.approx(4.94, abs=0.005)
    # inside corners stay as round as the wire with its gap
    assert any(ring.corner.any() for section in one.sections for ring in section.rings)


@pytest.mark.parametrize(("process", "taper"), [("waterjet", 0.15), ("wire", 0.005)])
def test_the_taper_is_part_of_the_corridor(process, taper):
    job = sheet_of(toothed(material="steel", radius=20.0, hole=8.0), process=process)
    text, _ = wire(job) if process == "wire" else beam(job, "linuxcnc-beam")
    suffix = ".iso" if process == "wire" else ".ngc"
    (one,) = parts_as_cut(SimpleNamespace(job=job, text=text, suffix=suffix))
    assert one.corridor == pytest.approx(0.005 + taper / 2)


def test_a_wall_that_the_text_leaves_elsewhere_is_seen():
    """A hole whose circle is run 0.02 mm too large in its radius."""
    job = sheet_of(plate("plate", bore(8), size=(24, 18, 3)), kerf=0.2)
    wide = sheet_of(plate("plate", bore(8.04), size=(24, 18, 3)), kerf=0.2)
    text, _ = beam(wide)
    (one,) = parts_as_cut(SimpleNamespace(job=job, text=text, suffix=".nc"))
    hole = one.hole_at(0.0, 0.0, 8.0)
    assert hole.diameter == pytest.approx(8.04, abs=0.003)


@pytest.mark.parametrize("service", ["sendcutsend", "ponoko"])
@pytest.mark.parametrize("wide", [8.0, 8.04])
def test_walls_of_a_service_stand_where_its_drawing_has_them(service, wide):
    """Ponoko's paths are the middle of its kerf, those of the others the wall itself."""
    settings = CutSettings(service=service)
    process, rules = settings.kind("service", "acrylic"), services()[service]
    parts = [plate("plate", bore(hole), size=(24, 18, 3)) for hole in (8.0, wide)]
    wanted, drawn = (cut_part(one, process, settings) for one in parts)
    cutting = SimpleNamespace(
        ordered=[wanted],
        settings=settings,
        drawings={"plate-cut.dxf": service_drawing(drawn, rules)},
    )
    (one,) = parts_ordered(cutting)
    assert one.hole_at(0.0, 0.0, 8.0).diameter == pytest.approx(wide, abs=0.003)
    assert one.corridor == pytest.approx(0.005 + process.taper / 2)
    drawn_shape = parts[1].outline.polygon()
    assert shapely.symmetric_difference(one.outline.shape(), drawn_shape).area < 0.003 * drawn_shape.length
