"""Limits of the depth of a seat stand in its drawing, on its setup sheet and in its program."""

import io

import ezdxf
import pytest
from by_control import steps

from mechwright.contracts.part import Bore, Part, Profile
from mechwright.geometry import Loop, Outline, circle
from mechwright_cad.exporters import dxf
from mechwright_cam.pages.setup_sheet.inspection import inspection
from mechwright_cam.planning.notes import lengths_of, notes
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool

MILL = Tool(name="em6", number=7, kind="end-mill", diameter=6, flutes=3, flute_length=20)
SEAT = Bore("seat", (0.0, 0.0), 26.0, 0.0, 8.0, None, (-0.025, 0.025))
DEEPER = Bore("seat", (0.0, 0.0), 26.0, 0.0, 8.0, None, (0.0, 0.05))


def plate(seat):
    outside = Loop((circle((0.0, 0.0), 30.0, tag="outside"),))
    rim = Profile("outside", outside, "outside", 0, 12.0)
    plain = Bore("register", (20.0, 0.0), 8.0, 0.0, 4.0)
    return Part("plate", Outline(outside, ()), 12.0, "aluminium", machined=(seat, plain, rim))


@pytest.mark.parametrize(
    ("seat", "text", "limits"),
    [(SEAT, "8 ±0.025", ("7.975", "8.025")), (DEEPER, "8 (+0.05/0)", ("8.000", "8.050"))],
)
def test_a_depth_with_limits_is_noted_wherever_the_part_is_made_or_measured(seat, text, limits):
    part = plate(seat)
    job = make_job(part, CamSettings(), (MILL,))
    words = dxf.part(part).decode()
    assert f"seat: {text.replace('±', '%%p')} mm deep" in words
    assert "register: 4 mm deep" in words
    assert ezdxf.read(io.StringIO(words)).modelspace()
    rows = {one.what: one for one in inspection(job, lengths_of(job))}
    assert (rows["seat, depth"].least, rows["seat, depth"].greatest) == limits
    assert (rows["register, depth"].least, rows["register, depth"].greatest) == ("3.90", "4.10")
    procedure = steps(job, [7], file_names=["plate.nc"], deepest=-8.0)
    assert any(f"seat {text} mm" in line for step in procedure for line in step.lines)
    assert any(line == f"seat: {text.replace('±', '+-')} deep" for line in notes(job, ()))
