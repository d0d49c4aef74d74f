"""Each check of the proofs by itself: a program with one fault, and the check that finds it."""

import math
from dataclasses import replace

import pytest
from cut_sheets import beam, plate, sheet_of, toothed, wire
from planning_parts import bore, rounded_box

from mechwright.contracts.part import Part
from mechwright.geometry import Line, Loop, Outline
from mechwright_cut.paths.order import contours
from mechwright_cut.proof.judge import prove
from mechwright_cut.proof.reading import read_beam
from mechwright_cut.proof.wire_judge import prove_wire

PLATE = plate("plate", bore(6), size=(24, 16, 3))


def failing(text, asked):
    return [check.name for check in prove(text, asked).failures]


def test_leads_keep_off_what_works_wherever_there_is_more_room():
    corners = [(0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0)]
    for place in range(4):
        tags = ["flank"] * 4
        tags[place] = "rim"
        ends = zip(corners, corners[1:] + corners[:1], strict=True)
        loop = Loop(tuple(Line(a, b, tag) for (a, b), tag in zip(ends, tags, strict=True)))
        job = sheet_of(Part("tile", Outline(loop), 3, "acrylic"))
        ((path,),) = [one.strokes for one in contours(job)]
        rim = job.pieces[0].outline.outer.segments[place]
        (x0, y0), (x1, y1), cut = rim.start, rim.end, path.cuts[0]
        across = abs((x1 - x0) * (cut.y - y0) - (y1 - y0) * (cut.x - x0)) / 20
        assert across == pytest.approx(job.kerf.width / 2, abs=0.003)


def test_a_rapid_with_the_beam_on_is_found_where_it_harms_no_part():
    text, asked = beam(sheet_of(PLATE), "linuxcnc-beam")
    last = next(m for m in reversed(read_beam(text, asked.control).motions) if not m.rapid)
    x, y = last.end
    middle = asked.pieces[0].outline.centroid
    share = 1 / math.dist(last.end, middle)
    away = f"G0 X{x + share * (x - middle[0]):.4f} Y{y + share * (y - middle[1]):.4f}"
    wrong = text.replace("M5\nG0 X0 Y0\n", f"{away}\nM5\nG0 X0 Y0\n")
    assert wrong != text
    assert failing(wrong, asked) == ["beam off in rapids and at the end"]


def test_an_opening_behind_its_outside_is_cut_into_what_is_loose():
    text, asked = beam(sheet_of(PLATE))
    head, _, rest = text.partition("(plate opening 1)")
    inside, _, outside = rest.partition("(plate outside)")
    outside, _, end = outside.partition("G0 X0 Y0")
    wrong = f"{head}(plate outside){outside}(plate opening 1){inside}G0 X0 Y0{end}"
    assert "nothing is cut that is loose" in failing(wrong, asked)


def test_a_slot_that_the_kerf_leaves_full_is_found():
    """The program cuts a tile; the part has a slot of 0.1 mm in it besides."""
    tile = Loop.polygon([(0, 0), (20, 0), (20, 20), (0, 20)])
    slot = [(0, 0), (20, 0), (20, 9.95), (8, 9.95), (8, 10.05), (20, 10.05), (20, 20), (0, 20)]
    job = sheet_of(Part("tile", Outline(tile), 3, "acrylic"))
    text, asked = beam(job)
    (piece,) = job.pieces
    slotted = Outline(Loop.polygon(slot)).moved(piece.x, piece.y, piece.angle)
    wrong = replace(asked, pieces=(replace(asked.pieces[0], outline=slotted),))
    check = prove(text, wrong).failures[0]
    assert "narrower than the kerf" in check.message


def test_faces_of_a_jet_differ_and_keep_their_walls():
    text, asked = beam(
        sheet_of(toothed(radius=20.0, hole=12.0, material="steel"), process="waterjet"), "linuxcnc-beam"
    )
    assert asked.taper == 0.15
    (good,) = [check for check in prove(text, asked).checks if check.name == "taper"]
    assert good.message == "the faces differ by up to 0.15 mm"
    # as wide a taper as the kerf says nothing of the other face
    (open_,) = [c for c in prove(text, replace(asked, taper=asked.kerf)).checks if c.name == "taper"]
    assert open_.message.startswith("not judged")


def test_a_web_that_the_taper_cuts_through_is_found():
    """Two windows with 0.4 mm between them: whole in the middle, gone at the face of the wide kerf."""
    left = Loop.polygon([(-8, -4), (-8, 4), (-0.2, 4), (-0.2, -4)])
    right = Loop.polygon([(0.2, -4), (0.2, 4), (8, 4), (8, -4)])
    job = sheet_of(Part("p", Outline(rounded_box(30, 20, 3), (left, right)), 3, "steel"), process="waterjet")
    text, asked = beam(job, "linuxcnc-beam")
    assert prove(text, asked).ok
    assert failing(text, replace(asked, taper=0.3)) == []
    assert failing(text, replace(asked, taper=0.42)) == ["taper"]
    finger = Loop.polygon([(0, 0), (20, 0), (20, 20), (12, 20), (12, 34), (11.7, 34), (11.7, 20), (0, 20)])
    text, asked = beam(sheet_of(Part("p", Outline(finger), 3, "steel"), process="waterjet"), "linuxcnc-beam")
    assert failing(text, asked) == []
    (check,) = prove(text, replace(asked, taper=0.35)).failures
    assert "a finger below the taper of 0.35 mm" in check.message


def test_micro_joints_are_wider_than_the_taper():
    text, asked = beam(sheet_of(PLATE, joints=2, joint_width=0.3))
    assert prove(text, replace(asked, taper=0.1)).ok
    assert failing(text, replace(asked, taper=0.15, joint_width=0.15))[-1] == "taper"


def wire_faults(text, asked):
    return "; ".join(check.message for check in prove_wire(text, asked).failures)


@pytest.fixture(scope="module")
def eroded():
    window = rounded_box(12, 8, 1.0, clockwise=True)
    part = Part("plate", Outline(rounded_box(30, 24, 3), (window,)), 5, "steel")
    return wire(sheet_of(part, process="wire", kerf=0.28, passes=2))


def test_the_wire_on_the_other_side_everywhere_is_found(eroded):
    text, asked = eroded
    swapped = text.replace("G41", "G4x").replace("G42", "G41").replace("G4x", "G42")
    assert "the wire is on the part's side" in wire_faults(swapped, asked)


def test_a_corner_that_is_too_narrow_for_d_is_found(eroded):
    text, asked = eroded
    assert prove_wire(text, asked).ok
    assert "too short or too round for an offset of 1.2 mm" in wire_faults(
        text, replace(asked, registers=(1.2, 0.14))
    )
