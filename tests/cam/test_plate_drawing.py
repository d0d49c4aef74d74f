"""Drawings of plates: what they say is enough to make the part, and nothing on them stands in the way."""

import io
import math
import random
import re
from collections import defaultdict
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import ezdxf
import pytest
import shapely
from by_night import by_night

from mechwright import host
from mechwright.contracts.datum import over_pins
from mechwright.contracts.details import Thread
from mechwright.contracts.fits import hole_fit
from mechwright.contracts.part import Bore, Instance, Part, Pocket, Profile
from mechwright.contracts.tolerance_settings import Tolerances, ToleranceSettings
from mechwright.designs.design import design_of, load
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry import Loop, Outline
from mechwright.pipeline.tolerances import TolerancesTable
from mechwright_cad.plate_drawing.drawing import PlateDrawing, plate_sheet
from mechwright_cad.sheet.fonts import default_font
from mechwright_cad.sheet.frame import MARGIN
from mechwright_cad.sheet.settings import DrawingSettings, DrawingTable
from mechwright_cad.sheet.sheet import Dimension, Text, width_of
from mechwright_cad.sheet.title import TitleBlock
from mechwright_cad.sheet.to_dxf import dxf
from mechwright_cad.sheet.to_pdf import pdf

EXAMPLES = Path(__file__).parents[2] / "examples"
BLOCK = TitleBlock("design", DrawingSettings())

FEW = ("four-bar-machine", "geneva-straight")
NIGHT = (
    "elliptic-pair-machine", "slider-crank-machine", "spherical-machine", "five-bar-machine", "cam-lever",
    "cam-conjugate", "figure-eight-machine", "geneva-machine", "spur-gears-machine", "nema-17-plate",
    "noncircular-window", "linkages/jansen", "linkages/klann", "inch-bracket", "geneva-cycloidal",
)  # fmt: skip
EACH = [*FEW, *(pytest.param(name, marks=by_night) for name in NIGHT)]


def plates(name):
    design = load(EXAMPLES / f"{name}.toml", host())
    tolerances = design.table(TolerancesTable)
    return [PlateDrawing(part, tolerances) for part in design.parts() if part.kind == "plate"]


def texts(sheet):
    found = [one for one in sheet.items if isinstance(one, Text)]
    return found + [one.text for one in sheet.items if isinstance(one, Dimension)]


def box(text):
    x, y = text.left
    return shapely.box(x, y, x + width_of(text.text, text.height), y + text.height)


HEADS = {"Hole", "Corner", "Contours", "Data", "To be measured", "Geometrical tolerances"}


def rows(sheet):
    """The rows of the tables as somebody reads them in a DXF of true size, table by table, left to right."""
    document = ezdxf.read(io.StringIO(dxf(sheet).decode()))
    found = []
    for text in document.modelspace().query("TEXT[layer=='TEXT']"):
        x, y, _ = (text.dxf.align_point if text.dxf.halign else text.dxf.insert) * sheet.scale
        found.append((round(x, 3), round(y, 3), text.dxf.text.replace("%%c", "⌀")))
    lefts = sorted({x for x, _, text in found if text in HEADS}) or [math.inf]
    lines = defaultdict(list)
    for x, y, text in found:
        column = max((left for left in lefts if left <= x + 1e-6), default=-1.0)
        lines[column, -y].append((x, text))
    return [[text for _, text in sorted(line)] for _, line in sorted(lines.items())]


NUMBER = r"-?\d+(?:\.\d+)?"


def rebuilt(sheet):
    """Rim and round holes of the part, from the rows of the tables alone."""
    rims, holes, words, contour = defaultdict(list), [], "", ""
    for row in rows(sheet):
        line = " | ".join(row)
        if found := re.fullmatch(r"(\d+) \| ([a-z].*)", line):
            contour = found[2]
        elif found := re.search(rf"\d+\.\d+ \| ({NUMBER}) \| ({NUMBER}) \| (straight|R.*)", line):
            rims[contour].append((float(found[1]), float(found[2]), found[3]))
        elif found := re.fullmatch(r"[C-Z]+  \d+ x \| (⌀.*|M.*)", line):
            words = found[1]
        elif found := re.fullmatch(rf"[C-Z]+\d* \| ({NUMBER}) \| ({NUMBER})(?: \| (.*))?", line):
            holes.append((float(found[1]), float(found[2]), found[3] or words))
    return rims, holes


def polygon(corners):
    """The area inside corners joined by lines and arcs."""
    points = []
    for (x, y, how), (u, v, _) in zip(corners, corners[1:] + corners[:1], strict=True):
        points.append((x, y))
        if found := re.fullmatch(rf"R({NUMBER}) (left|right), centre ({NUMBER}), ({NUMBER})", how):
            cx, cy = float(found[3]), float(found[4])
            assert math.hypot(x - cx, y - cy) == pytest.approx(float(found[1]), abs=2e-3)
            start, turn = math.atan2(y - cy, x - cx), math.atan2(v - cy, u - cx) - math.atan2(y - cy, x - cx)
            turn = turn % math.tau if found[2] == "left" else -((-turn) % math.tau)
            steps = 200
            radius = float(found[1])
            points += [
                (
                    cx + radius * math.cos(start + turn * k / steps),
                    cy + radius * math.sin(start + turn * k / steps),
                )
                for k in range(1, steps)
            ]
    return shapely.Polygon(points)


@pytest.mark.parametrize("name", EACH)
def test_the_part_can_be_made_again_from_the_tables_alone(name):
    told = plates(name)
    assert told
    for one in told:
        sheet = plate_sheet(one, BLOCK)
        rims, holes = rebuilt(sheet)
        dx, dy = one.datum
        bores = [feature for feature in one.part.features if isinstance(feature, Bore)]
        axes = {(round(bore.centre[0] - dx, 3) + 0.0, round(bore.centre[1] - dy, 3) + 0.0) for bore in bores}
        assert {(x, y) for x, y, _ in holes} == axes
        for bore in bores:
            (words,) = [
                text
                for x, y, text in holes
                if math.hypot(x - bore.centre[0] + dx, y - bore.centre[1] + dy) < 2e-3
            ]
            assert f"⌀{bore.fit.text if bore.fit else f'{round(bore.diameter, 3):g}'}" in words
        if rims.get("outline"):
            (rim,) = [f.loop for f in one.part.features if isinstance(f, Profile) and f.side == "outside"]
            wanted = shapely.affinity.translate(shapely.Polygon(rim.flatten(1e-4)), -dx, -dy)
            off = polygon(rims["outline"]).symmetric_difference(wanted).area
            assert off < 2e-3 * wanted.length


@pytest.mark.parametrize("name", EACH)
def test_texts_stand_in_the_frame_and_on_no_other_text(name):
    for one in plates(name):
        sheet = plate_sheet(one, BLOCK)
        boxes = [box(text) for text in texts(sheet)]
        frame = shapely.box(MARGIN, MARGIN, sheet.width - MARGIN, sheet.height - MARGIN)
        assert all(frame.contains(found) for found in boxes)
        for first, second in combinations(boxes, 2):
            assert first.intersection(second).area == 0.0


SQUARE = Outline(
    Loop.polygon([(0, 0), (80, 0), (80, 50), (0, 50)]),
    (),
)


def plate(**changes):
    machined = (
        Bore("dowel", (20.0, 15.0), 6.006, 0.0, 10.0, hole_fit(6, "H7")),
        Bore("core", (60.0, 15.0), 4.2, 0.0, 8.0),
        Pocket("recess", Loop.polygon([(30, 20), (50, 20), (50, 40), (30, 40)]), (), 0.0, 3.0),
        Profile("outside", SQUARE.outer, "outside", 0.0, 10.0),
    )
    details = (Thread("hole", (60.0, 15.0), 5.0, 0.8, 6.0),)
    return Part(
        "plate", SQUARE, 10.0, "steel", (Instance("ground"),), machined=machined, details=details, **changes
    )


def said(sheet):
    return [" | ".join(row) for row in rows(sheet)]


def test_threads_depths_recesses_and_datums_are_told():
    one = PlateDrawing(plate(), Tolerances())
    lines = "\n".join(said(plate_sheet(one, BLOCK)))
    assert one.datum == (20.0, 15.0), "the hole with a fit"
    assert "M5-6H, 6 deep / ⌀4.2, 8 deep" in lines
    assert "⌀6 H7 (0/+0.012) Ra 1.6 through" in lines
    assert "recess, 3 deep" in lines
    assert "60 | 35" in lines, "a corner of the rim, from the dowel"


@pytest.mark.parametrize(
    ("thread", "core", "words"),
    [
        (Thread("t", (60.0, 15.0), 6.0, 1.0, 10.0), 5.0, "M6-6H, through / ⌀5 through"),
        (Thread("t", (60.0, 15.0), 6.0, 0.75, 6.0), 5.2, "M6x0.75-6H, 6 deep / ⌀5.2 through"),
        (Thread("t", (60.0, 15.0), 6.0, 1.0, 6.0, left=True), 5.0, "M6 LH-6H, 6 deep / ⌀5 through"),
        (
            Thread("t", (60.0, 15.0), 6.35, 1.27, 6.0, inch="1/4-20 UNC"),
            5.1,
            "1/4-20 UNC-2B, 6 deep / ⌀5.1 through",
        ),
    ],
)
def test_a_thread_has_its_class_and_its_drill(thread, core, words):
    holes = (
        Bore("core", (60.0, 15.0), core, 0.0, 10.0),
        Profile("outside", SQUARE.outer, "outside", 0.0, 10.0),
    )
    one = replace(plate(), machined=holes, details=(thread,))
    assert words in "\n".join(said(plate_sheet(PlateDrawing(one, Tolerances()), BLOCK)))


def test_curves_have_a_frame_and_teeth_a_table():
    wavy = Outline(
        Loop.polygon(
            [
                (
                    (30 + math.sin(9 * k / 30)) * math.cos(k / 30),
                    (30 + math.sin(9 * k / 30)) * math.sin(k / 30),
                )
                for k in range(188)
            ]
        ),
        (),
    )
    one = Part("wheel", wavy, 10.0, "steel", data=(("module", "2"), ("number of teeth", "30")))
    sheet = plate_sheet(PlateDrawing(one, Tolerances()), BLOCK)
    lines = "\n".join(said(sheet))
    assert "module | 2" in lines
    assert "number of teeth | 30" in lines
    words = [text.text for text in texts(sheet)]
    assert "0.015 UZ+0.0025" in words, "5 µm into the wall, 10 µm off it"
    square = plate_sheet(PlateDrawing(plate(), Tolerances()), BLOCK)
    assert not any("UZ" in text.text for text in texts(square)), "a table has its corners"


def test_zones_follow_the_tolerances_of_the_design():
    (hole,) = [hole for hole in _holes(plate()) if hole.fitted]
    wide = PlateDrawing(plate(), Tolerances(ToleranceSettings(length=0.1)))
    assert wide.zone(hole) == 0.2
    assert "⌀0.2" in [text.text for text in texts(plate_sheet(wide, BLOCK))]


def _holes(part):
    from mechwright_cad.plate_drawing.holes import kinds

    return [hole for kind in kinds(part, (0.0, 0.0)) for hole in kind.holes]


def test_without_a_hole_the_lower_left_corner_is_the_datum():
    bare = Part("bare", SQUARE, 5.0, "steel")
    one = PlateDrawing(bare, Tolerances())
    assert one.datum == (0.0, 0.0)
    assert "X and Y from the lower left corner" in said(plate_sheet(one, BLOCK))


def test_the_title_block_says_what_the_design_file_says(tmp_path):
    table = {
        "owner": "Works", "title": "Press", "number": "4711", "revision": "B", "date": "2026-11-30",
        "author": "N. N.", "approved": "M. M.", "projection": "third",
    }  # fmt: skip
    block = TitleBlock("design", DrawingSettings(**table))
    first, third = (plate_sheet(PlateDrawing(plate(), Tolerances()), one) for one in (BLOCK, block))
    shown = [text.text for text in texts(third)]
    for word in ("Works", "Press", "4711 / plate", "B", "2026-11-30", "N. N.", "M. M."):
        assert word in shown
    assert "design" in [text.text for text in texts(first)]
    hidden = [
        [x for one in sheet.items if getattr(one, "layer", "") == "HIDDEN" for x, _ in one.points]
        for sheet in (first, third)
    ]
    assert min(hidden[0]) > min(hidden[1]), "the upper face stands on the other side"


def test_a_title_of_500_letters_is_refused_by_its_key():
    content = {
        "format": 1,
        "family": "plate",
        "name": "p",
        "parameters": {},
        "drawings": {"title": "x" * 500},
    }
    with pytest.raises(DesignError, match=r"drawings\.title: .*60"):
        design_of(content, Path("p.toml"), "", host())


def test_what_is_no_plate_has_no_such_drawing():
    with pytest.raises(GeometryError, match="part block is no plate"):
        PlateDrawing(Part("block", None, 0.0, "steel", build=lambda: None), Tolerances())


def test_both_files_are_sound_and_the_same_each_time():
    sheet = plate_sheet(PlateDrawing(plate(), Tolerances()), BLOCK)
    assert dxf(sheet) == dxf(plate_sheet(PlateDrawing(plate(), Tolerances()), BLOCK))
    assert pdf(sheet).startswith(b"%PDF-1.4")
    audit = ezdxf.read(io.StringIO(dxf(sheet).decode())).audit()
    assert (audit.errors, audit.fixes) == ([], [])


def test_letters_of_other_alphabets_are_written_in_a_font_that_the_file_brings_along():
    words = {"title": "Мальтийский крест", "owner": "Ἀθῆναι Works", "author": "Šimková"}
    table = DrawingTable().read(words, Path("p.toml"))
    data = pdf(plate_sheet(PlateDrawing(plate(), Tolerances()), TitleBlock("design", table)), "Крест")
    assert data == pdf(plate_sheet(PlateDrawing(plate(), Tolerances()), TitleBlock("design", table)), "Крест")
    assert b"/FontFile2" in data
    meant = {
        int(code, 16): bytes.fromhex(letter.decode()).decode("utf-16-be")
        for code, letter in re.findall(rb"<([0-9A-F]{4})> <([0-9A-F]{4,8})>\n", data)
    }
    shown = [
        "".join(meant[int(text[k : k + 4], 16)] for k in range(0, len(text), 4))
        for text in re.findall(rb"<([0-9A-F]+)> Tj", data)
    ]
    assert {"Мальтийский крест", "Ἀθῆναι Works"} <= set(shown)
    assert b"(?" not in data


def test_letters_that_no_font_at_hand_has_are_refused_by_their_key(tmp_path, monkeypatch):
    with pytest.raises(
        DesignError, match=r"drawings\.title: the font at hand has no letter '轮'; set drawings.font"
    ):
        DrawingTable().read({"title": "齿轮"}, Path("p.toml"))
    (tmp_path / "own.ttf").write_bytes(b"no font")
    with pytest.raises(DesignError, match=r"drawings\.title: own\.ttf is no TrueType font"):
        DrawingTable().read({"title": "Ж", "font": "own.ttf"}, tmp_path / "p.toml")


@pytest.mark.parametrize(("many", "size"), [(12, 3.0), (20, 2.0), (30, 1.0)])
def test_a_plate_of_very_many_holes_has_a_drawing_whose_texts_are_on_the_sheet(many, size):
    side = 8.0 * many
    holes = tuple(
        Bore(
            f"h-{i}-{k}", (8.0 * i + 4, 8.0 * k + 4), size, 0.0, 10.0, hole_fit(size, "H7") if i % 2 else None
        )
        for i in range(many)
        for k in range(many)
    )
    rim = Outline(Loop.polygon([(0, 0), (side, 0), (side, side), (0, side)]))
    part = Part(
        "sieve", rim, 10.0, "steel", machined=(*holes, Profile("outside", rim.outer, "outside", 0.0, 10.0))
    )
    part = replace(part, measures=over_pins(part, Tolerances()))
    sheet = plate_sheet(PlateDrawing(part, Tolerances()), BLOCK)
    frame = shapely.box(MARGIN, MARGIN, sheet.width - MARGIN, sheet.height - MARGIN)
    boxes = [box(text) for text in texts(sheet)]
    assert all(frame.contains(found) for found in boxes)
    tree = shapely.STRtree(boxes)
    one, two = tree.query(boxes, predicate="overlaps")
    assert not one.size, [texts(sheet)[k].text for k in (*one[:2], *two[:2])]
    assert f"{many * many // 2} x" in "\n".join(said(sheet))
    assert "sieve.dxf has their places" in said(sheet)


def test_random_damage_of_a_font_is_refused_by_its_key(tmp_path):
    draw, whole, refused = random.Random(4), default_font(), []  # noqa: S311 - bytes, no secrets
    for _ in range(30):
        data = bytearray(whole[: draw.randrange(len(whole))] if draw.random() < 0.4 else whole)
        for _ in range(draw.choice([1, 50, 500])):
            data[draw.randrange(len(data))] = draw.randrange(256)
        (tmp_path / "own.ttf").write_bytes(bytes(data))
        try:
            DrawingTable().read({"title": "Ж", "font": "own.ttf"}, tmp_path / "p.toml")
        except DesignError as error:
            refused.append(str(error))
    assert len(refused) > 10
    assert all("drawings.title: own.ttf" in words for words in refused)
