"""Drawings read: layers, mending and refusals, and any plate out of any order of its pieces."""

import io
import math
from dataclasses import replace

import ezdxf
import numpy as np
import pytest
import shapely
from by_night import examples
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright import Bore, Loop, Outline, Part, Pocket, Profile
from mechwright.contracts.details import Chamfer, Engraving, Thread
from mechwright.drawings import edged, plate, shown
from mechwright.drawings.asked import Asked
from mechwright.drawings.fault import Told
from mechwright.drawings.plate import Cut, part_of
from mechwright.drawings.reading import read

PLAIN = Asked()


def part_in(data: bytes, asked: Asked = PLAIN, thickness: float = 10.0) -> tuple[Part | None, Told]:
    found = read(data, asked)
    return part_of(found, asked, Cut("plate", thickness, "steel")), found.told


def saved(draw, *, unit: int = 4, version: str = "R2010") -> bytes:
    document = ezdxf.new(version, units=unit)
    draw(document.modelspace())
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue().encode(document.output_encoding)


def box(space, x0, y0, x1, y1, layer="0", **more):
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    space.add_lwpolyline(corners, close=True, dxfattribs={"layer": layer, **more})


def everything(space):
    box(space, 0, 0, 100, 60, "OUTLINE")
    box(space, 0, 0, 100, 60, "CHAMFER_0.5")
    box(space, 20, 10, 60, 50, "POCKET_3")
    box(space, 30, 20, 40, 30, "POCKET_3")  # an island
    box(space, 45, 20, 55, 40, "POCKET_5.5")  # a step in it
    box(space, 80, -5, 90, 20, "pocket_2")  # open at the rim
    space.add_circle((10, 10), 3, dxfattribs={"layer": "BORE_H7"})
    space.add_circle((10, 50), 2.5, dxfattribs={"layer": "M5_6"})
    space.add_circle((25, 45), 2, dxfattribs={"layer": "THROUGH"})  # from the floor of the pocket on
    space.add_circle((95, 55), 2, dxfattribs={"layer": "POCKET_4"})
    space.add_line((65, 50), (75, 55), dxfattribs={"layer": "ENGRAVE_0.3_W0.5"})


def test_layers_say_what_is_cut_and_how_deep():
    part, told = part_in(saved(everything))
    assert told.faults == []
    by_name = {feature.name: feature for feature in part.features}
    fitted, step, threaded, blind = (
        by_name["bore-1"],
        by_name["bore-3"],
        by_name["bore-2"],
        by_name["recess-3"],
    )
    assert (fitted.fit.text, fitted.diameter) == ("6 H7 (0/+0.012)", 6.006)
    assert (threaded.diameter, threaded.depth) == (pytest.approx(5 - 1.0825 * 0.8), pytest.approx(6.8))
    assert (step.top, step.depth, blind.depth) == (3.0, 7.0, 4.0)
    pockets = [feature for feature in part.features if isinstance(feature, Pocket)]
    assert [(p.top, p.depth, len(p.islands)) for p in pockets] == [(0, 3, 1), (0, 2, 0), (3, 2.5, 0)]
    kinds = {type(detail): detail for detail in part.details}
    assert (kinds[Thread].designation, kinds[Thread].depth) == ("M5x0.8", 6.0)
    assert (kinds[Chamfer].width, kinds[Chamfer].side) == (0.5, "outside")
    assert (kinds[Engraving].depth, kinds[Engraving].width) == (0.3, 0.5)


@pytest.mark.parametrize(
    ("layers", "holes", "expected"),
    [
        ((("A", "outline"), ("B", "pocket 4")), (), ("recess-1", 4.0)),
        ((("A", "outline"), ("colour 3", "pocket 0.1in")), (), ("recess-1", 2.54)),
        ((("A", "outline"), ("B", "through")), ((6.0, "M6"),), ("bore-1", 10.0)),
    ],
)
def test_a_design_says_what_layers_colours_and_sizes_mean(layers, holes, expected):
    def draw(space):
        box(space, 0, 0, 40, 40, "A")
        space.add_circle((20, 20), 3, dxfattribs={"layer": "B", "color": 3})

    part, told = part_in(saved(draw), replace(PLAIN, layers=layers, holes=holes))
    assert told.faults == []
    bore = part.features[0]
    assert isinstance(bore, Bore)
    assert (bore.name, bore.depth) == (expected[0], pytest.approx(expected[1]))
    assert len(part.details) == len(holes)


@pytest.mark.parametrize(
    ("origin", "bounds"),
    [("drawing", (10, 20, 50, 40)), ("corner", (0, 0, 40, 20)), ("centre", (-20, -10, 20, 10))],
)
def test_the_origin_is_where_it_is_asked_for(origin, bounds):
    part, _ = part_in(saved(lambda space: box(space, 10, 20, 50, 40)), replace(PLAIN, origin=origin))
    assert part.outline.bounds == pytest.approx(bounds)
    part, _ = part_in(saved(lambda space: box(space, 1, 2, 5, 4)), replace(PLAIN, scale=10.0))
    assert part.outline.bounds == pytest.approx((10, 20, 50, 40))


def crossed(space):
    box(space, 0, 0, 40, 40)
    space.add_circle((40, 20), 5)


def nested(space):
    box(space, 0, 0, 40, 40)
    box(space, 5, 5, 30, 30)
    box(space, 10, 10, 20, 20)


def in_space(space):
    box(space, 0, 0, 40, 40)
    space.add_line((0, 0, 0), (0, 0, 9))


def tilted(space):
    box(space, 0, 0, 40, 40)
    space.add_circle((5, 5), 2, dxfattribs={"extrusion": (0, 1, 1)})


def solid(space):
    box(space, 0, 0, 40, 40)
    space.add_3dface([(0, 0), (1, 0), (1, 1)])


def far(space):
    box(space, 2e6, 0, 2e6 + 40, 40)


def bomb(space):
    blocks = space.doc.blocks
    blocks.new("B0").add_circle((0, 0), 1)
    for number in range(1, 12):
        block = blocks.new(f"B{number}")
        for _ in range(10):
            block.add_blockref(f"B{number - 1}", (0, 0))
    space.add_blockref("B11", (0, 0))


def endless(space):
    space.doc.blocks.new("EMPTY")
    space.add_blockref("EMPTY", (0, 0), dxfattribs={"row_count": 300, "column_count": 300, "row_spacing": 1})


def tee(space):
    box(space, 0, 0, 40, 40)
    space.add_line((40, 40), (60, 60))


def deep(space):
    box(space, 0, 0, 40, 40, "OUTLINE")
    box(space, 5, 5, 30, 30, "POCKET_12")


def square_bore(space):
    box(space, 0, 0, 40, 40, "OUTLINE")
    box(space, 5, 5, 30, 30, "BORE_H7")


def crossing_pockets(space):
    box(space, 0, 0, 40, 40, "OUTLINE")
    box(space, 5, 5, 20, 20, "POCKET_3")
    box(space, 10, 10, 30, 30, "POCKET_5")


def on_paper(space):
    space.doc.layout("Layout1").add_circle((0, 0), 9)


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (crossed, "crosses the outline at X40.000 Y15.000"),
        (nested, "lies in the opening of LWPOLYLINE 30 on layer 0 at X5.000 Y5.000: it would fall out"),
        (in_space, "LINE 30 on layer 0 reaches from Z0.000 to Z9.000"),
        (tilted, "CIRCLE 30 on layer 0 is drawn on a tilted plane"),
        (solid, "3DFACE 30 on layer 0 is no curve of a plane"),
        (far, "stands 2e+06 mm from the drawing's origin"),
        (tee, "3 curves meet at X40.000 Y40.000"),
        (deep, "is 12 mm deep, in a plate of 10 mm"),
        (square_bore, "is no circle, and bores H7 all through are round"),
        (crossing_pockets, "cross each other at X10.000 Y20.000"),
        (on_paper, "the paper space has 1 entities"),
        (lambda space: box(space, 0, 0, 40, 40, "POCKET"), "pocket without its depth"),
        (lambda space: box(space, 0, 0, 40, 40, "POCKET_x_3"), "'X' is not understood"),
        (
            lambda space: (box(space, 0, 0, 9, 9, "A"), box(space, 1, 1, 8, 8, "B")),
            "layer A has",
        ),
        (lambda space: space.add_line((0, 0), (9, 0)), "the contour is open at X9.000 Y0.000, where LINE 2F"),
    ],
)
def test_what_is_unclear_is_refused_with_its_place(draw, said):
    part, told = part_in(saved(draw))
    assert part is None
    assert said in told.faults[0].message
    assert told.faults[0].remedy


@pytest.mark.parametrize("hidden", [False, True])
def test_an_entity_of_a_kind_that_nobody_knows_is_told_with_its_layer(hidden):
    """It has no attributes, and asking for them ended the program."""

    def draw(space):
        box(space, 0, 0, 40, 40, "OUTLINE")
        space.add_circle((9, 9), 3, {"layer": "HOLES", "invisible": int(hidden)})

    data = saved(draw)
    assert data.count(b"\nCIRCLE") == 1
    part, told = part_in(data.replace(b"\nCIRCLE", b"\nGADGET"))
    if hidden:
        assert part is not None
        assert any("invisible" in note for note in told.notes)
    else:
        assert part is None
        assert "on layer HOLES is no curve of a plane" in told.faults[0].message
        assert 'layers = {"HOLES" = "ignore"}' in told.faults[0].remedy


@pytest.mark.parametrize("draw", [bomb, endless])
def test_blocks_within_blocks_end(draw, monkeypatch):
    monkeypatch.setattr(shown, "MOST", 300)
    part, told = part_in(saved(draw))
    assert part is None
    assert told.faults[0].message == "more than 300 entities are drawn"


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"", "is empty"),
        (b"hello", "is no whole DXF drawing"),
        (b"  0\nSECTION\n", "is no whole DXF drawing"),
        (b"hello\nEOF", "is no DXF drawing that can be read"),
        (b"\x00\xff" * 500, "is no whole DXF drawing"),
        (b"AC1027\x00\x00", "is a DWG file"),
        (b"%PDF-1.7", "is a PDF"),
        (b"ISO-10303-21;", "is a STEP file"),
        (b"AutoCAD Binary DXF\r\n\x1a\x00", "is no DXF drawing that can be read"),
        (b" " * 20_000_001, "has 20,000,001 bytes"),
    ],
)
def test_other_files_are_said_to_be_what_they_are(data, said):
    part, told = part_in(data)
    assert part is None
    assert said in told.faults[0].message


def test_a_drawing_that_ends_early_is_refused():
    data = saved(everything)
    for share in (0.3, 0.6, 0.9, 0.99):
        part, told = part_in(data[: int(len(data) * share)])
        assert part is None
        assert told.faults[0].code == "file"


def test_a_binary_drawing_is_read():
    document = ezdxf.new("R2010", units=4)
    everything(document.modelspace())
    stream = io.BytesIO()
    document.write(stream, fmt="bin")
    assert part_in(stream.getvalue())[0] == part_in(saved(everything))[0]


# -- any plate, in any order ---------------------------------------------------------------------------------


@st.composite
def stars(draw):
    """Corners and bulges of a loop round the origin: straight sides and arcs."""
    count = draw(st.integers(3, 9))
    radii = draw(st.lists(st.floats(20, 60), min_size=count, max_size=count))
    flags = draw(st.lists(st.floats(-0.25, 0.25), min_size=count, max_size=count))
    turn = [math.tau * (k + 0.1) / count for k in range(count)]
    return [
        (r * math.cos(t), r * math.sin(t), b if abs(b) > 0.02 else 0.0)
        for r, t, b in zip(radii, turn, flags, strict=True)
    ]


@settings(max_examples=examples(8, 300), deadline=None)
@given(stars(), st.randoms(use_true_random=False), st.floats(0, 0.009))
def test_any_plate_comes_out_of_any_order_of_its_pieces(corners, random, gap):
    whole, told = part_in(saved(lambda space: space.add_lwpolyline(corners, format="xyb", close=True)))
    if whole is None:
        assert "crosses itself" in told.faults[0].message
        return

    def scattered(space):
        pieces = []
        for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
            off = [random.uniform(-gap, gap) / 3 for _ in range(4)]
            one, two = (a[0] + off[0], a[1] + off[1]), (b[0] + off[2], b[1] + off[3])
            piece = [(*one, a[2]), (*two, 0)]
            pieces.append(piece if random.random() < 0.5 else [(*two, -a[2]), (*one, 0)])
        pieces += [piece[::1] for piece in pieces if random.random() < 0.3]  # twice
        random.shuffle(pieces)
        for piece in pieces:
            space.add_lwpolyline(piece, format="xyb")

    again, told = part_in(saved(scattered))
    assert told.faults == []
    off = shapely.hausdorff_distance(whole.outline.polygon(), again.outline.polygon())
    assert off <= 2 * gap + 2e-3
    assert np.isclose(
        again.outline.area, whole.outline.area, atol=gap * whole.outline.polygon().length + 1e-3
    )


def test_what_is_drawn_shows_its_own_look_that_of_its_layer_or_that_of_its_block():
    document = ezdxf.new(setup=True)
    document.layers.add("cut", color=3, linetype="HIDDEN")
    document.layers.add("off", color=5).off()  # which its colour says, below 0
    space = document.modelspace()
    outer = shown._Look("cut", 4, "dashdot", "7F")

    def look(outer, **said):
        found = shown._look(document, space.add_line((0, 0), (1, 0), dxfattribs=said), outer)
        return found.layer, found.colour, found.linetype

    own = {"layer": "cut", "color": 1, "linetype": "DASHED"}
    by_layer, by_block = {"color": 256, "linetype": "BYLAYER"}, {"color": 0, "linetype": "BYBLOCK"}
    for around in (None, outer):
        assert look(around, **own) == ("cut", 1, "dashed")
        assert look(around, layer="cut", **by_layer) == look(around, layer="cut") == ("cut", 3, "hidden")
        assert look(around, layer="off", **by_layer) == ("off", 5, "continuous")
        assert look(around, layer="nowhere", **by_layer) == ("nowhere", 7, "continuous")
    assert look(None, layer="cut", **by_block) == ("cut", 7, "continuous")
    assert look(outer, layer="off", **by_block) == ("off", 4, "dashdot")
    assert look(None, layer="0", **by_layer) == ("0", 7, "continuous")
    assert look(outer, layer="0", **by_layer) == (
        "cut",
        3,
        "hidden",
    )  # layer 0 is that of the block's reference


def test_a_bore_is_shifted_with_the_plate_that_it_is_drawn_in():
    assert plate._moved(Bore("hole", (3.0, 4.0), 6.0, 1.0, 2.0), 10.0, 20.0) == Bore(
        "hole", (13.0, 24.0), 6.0, 1.0, 2.0
    )


def test_edges_that_a_chamfer_may_have_are_those_of_the_top_face():
    rim, box = (Loop.polygon([(-h, -h), (h, -h), (h, h), (-h, h)]) for h in (30.0, 5.0))
    features = (
        Pocket("recess", box.moved(-15, 0, 0), (Loop.polygon([(-16, -1), (-14, -1), (-15, 1)]),), 0.0, 2.0),
        Pocket("deeper", box.moved(-15, 0, 0), (), 2.0, 2.0),
        Bore("hole", (15.0, 15.0), 6.0, 0.0, 8.0),
        Profile("window", box.moved(15, -15, 0), "inside", 0.0, 8.0),
        Profile("rim", rim, "outside", 0.0, 8.0),
    )
    found = list(edged._edges(Part("plate", Outline(rim), 8.0, "steel", machined=features)))
    assert [(name, rim) for name, _, rim in found] == [
        ("outside", True), ("recess", False), ("recess-island-1", True), ("hole", False), ("window", False),
    ]  # fmt: skip
    assert found[3][1].bounds == pytest.approx((12.0, 12.0, 18.0, 18.0), abs=1e-3)
