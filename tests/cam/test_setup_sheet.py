"""The setup sheet says what a machinist needs, with the numbers of the job, and trusts no text."""

import math
import re
from dataclasses import replace
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest
from by_control import setup_html, steps
from plate_shapes import slotted_plate, wavy_plate

from mechwright.contracts.part import Instance, Part
from mechwright.output import svg
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.pages.picture import plan_view
from mechwright_cam.pages.trace import trace
from mechwright_cam.program.moves import Drill, Feed, FeedArc, Operation, Pause, Program, Rapid, ToolSection
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool

SVG = "{http://www.w3.org/2000/svg}"
DRILL = Tool(name="d8", number=4, kind="drill", diameter=8, flutes=2, flute_length=40)
MILL = Tool(name="em6", number=7, kind="end-mill", diameter=6, flutes=3, flute_length=9)

PROOF = {
    "ok": True,
    "gouge_max_mm": 0.0012,
    "leftover_reachable_max_mm": 0.0034,
    "unreachable_area_mm2": 0.127,
    "rapids_in_stock": 0,
    "unreachable": [{"x": 12.5, "y": -3.25, "depth": 0.0221, "area": 0.0635}],
    "checks": {
        "gouge": {"passed": True, "message": "no cut into the part"},
        "length-offset": {"passed": True, "message": "G43 after every tool change"},
    },
    "time_estimate_s": 754.0,
    "tool_times_s": {"4": 20.0, "7": 700.0},
    "operations": [
        {"name": "holes", "tool": 4, "time_s": 20.0, "cutting_mm": 11.0},
        {"name": "outside", "tool": 7, "time_s": 700.0, "cutting_mm": 5000.0},
    ],
}


def job(outline=None, **settings):
    part = Part("wheel", outline or wavy_plate(), 10.0, "steel")
    return make_job(part, CamSettings(**settings), (DRILL, MILL))


def program(offset="G54", stop=None):
    holes = Operation("holes", (Rapid(0, 20), Drill(0, 20, -12.4, 2, 120, 2.0), Drill(0, 0, -12.4, 2, 120)))
    outside = (
        Rapid(40, 0, 5), Rapid(z=1), Feed(None, None, -5.0, 200), FeedArc(-40, 0, None, -40, 0, True, 800),
        FeedArc(40, 0, -10.3, 40, 0, True, 800), FeedArc(40, 0, None, -40, 0, True, 600), Rapid(z=5),
    )  # fmt: skip
    first = [holes] if stop is None else [holes, Operation("clamp", (Pause(stop),))]
    sections = (
        ToolSection(DRILL, 1200, "flood", tuple(first)),
        ToolSection(MILL, 6000, "mist", (Operation("outside", outside),)),
    )
    return Program("wheel", offset, 5.0, sections, ("stock 10 mm steel",))


def ending(suffix):
    """A control whose programs end so."""
    return type("Ending", (LinuxCnc,), {"suffix": suffix})()


def sheet(job, program, proof, **files):
    return setup_html(job, program, proof, **files)


class Text(HTMLParser):
    """The words of a page, the tags it opens, and whether they all close."""

    VOID = ("meta", "br", "input")

    def __init__(self, page):
        super().__init__()
        self.words, self.open, self.tags = [], [], []
        self.feed(page)
        self.text = re.sub(r"\s+", " ", " ".join(self.words))

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] != "style":
            self.words.append(data)


def read(page):
    found = Text(page)
    assert not found.open
    return found


def test_page_stands_alone():
    page = sheet(job(), program(), PROOF)
    found = read(page)
    assert not {tag for tag, _ in found.tags} & {"script", "link", "img", "iframe", "object"}
    assert set(re.findall(r"https?://[^\"' )]*", page)) == {"http://www.w3.org/2000/svg"}
    assert "@import" not in page
    assert "url(" not in page
    assert page == sheet(job(), program(), PROOF)


def test_numbers_of_the_job_are_on_the_page():
    text = read(sheet(job(), program(), PROOF, tool_table="tool.tbl")).text
    for words in (
        "Setup sheet for wheel.nc",
        "PROVEN",
        "steel",
        "the axis of the part",
        "12 min 34 s",
        "T4", "H4", "drill ⌀8, 118° point",
        "T7", "H7", "end mill ⌀6, 3 flutes",
        "200 … 800",
        "−12.40",
        "≥ 15.4",
        "4 tabs of 2 × 1 mm",
        "9 too short",
        "G54 Z = N − h",
        "H7 = Z7 − N",
        "0.0012 mm deepest cut into the part",
        "0.127 mm² area no cutter reaches",
        "length offset ✓ pass G43 after every tool change",
        "+12.50 −3.25 0.0221 0.0635",
        "stock 10 mm steel",
        "tool.tbl",
    ):  # fmt: skip
        assert words in text
    x0, y0, x1, y1 = job().stock
    assert f"{x1 - x0:.1f} × {y1 - y0:.1f} × 10 mm" in text
    assert f"left edge is X {svg.signed(x0)}, its front edge is Y {svg.signed(y0)}" in text


def test_operations_stand_in_order_with_their_times():
    text = read(sheet(job(), program(), PROOF)).text
    rows = text[text.index("Operations") : text.index("What the proof found")]
    assert re.search(r"1 holes T4 −12.40 11 20 s 2 outside T7 −10.30 5000 11 min 40 s", rows)
    without = read(sheet(job(), program(), {"ok": True})).text
    assert "1 holes T4 −12.40 – – 2 outside" in without


@pytest.mark.parametrize(
    ("proof", "words"),
    [
        (None, "NOT PROVEN"),
        ({}, "was not simulated"),
        ({"ok": False}, "PROOF FAILED: DO NOT RUN"),
        ({"checks": {"gouge": {"passed": False, "message": "0.02 mm into the part"}}}, "DO NOT RUN"),
        ({"checks": {"gouge": {"passed": False, "message": "0.02 mm"}}}, "gouge ✗ FAIL 0.02 mm"),
        ({"checks": {"gouge": {"passed": True}}}, "PROVEN"),
    ],
)
def test_verdict(proof, words):
    text = read(sheet(job(), program(), proof)).text
    assert words in text
    if words == "DO NOT RUN":
        assert " PROVEN " not in text


def test_text_of_a_design_file_is_only_text():
    evil = '<script>alert("x")</script>&'
    proof = {
        "checks": {evil: {"passed": False, "message": evil}},
        "operations": [{"name": evil, "tool": 4, "time_s": 1.0}],
    }
    machine = {"name": evil}
    made = program(stop=evil)
    page = sheet(job(machine=machine), made, proof, control=ending(evil), tool_table=evil, design=evil)
    found = read(page)
    assert "script" not in {tag for tag, _ in found.tags}
    assert "<script" not in page
    assert found.text.count(evil) == 8


def test_as_many_as_the_mechanism_needs():
    instances = (Instance("driver"), Instance("driven"))
    pair = replace(job(), part=replace(job().part, instances=instances))
    text = read(sheet(pair, program(), PROOF)).text
    assert "Make 2 Tools" in text
    assert "Make 2. A further plate against the same stops keeps G54 X and Y; set G54 Z again if" in text
    assert "The length offsets stay." in text
    assert "Make 1 Tools" in read(sheet(job(), program(), PROOF)).text
    by_hand = replace(pair, settings=pair.settings.model_copy(update={"control": "grbl"}))
    text = read(sheet(by_hand, program(), PROOF)).text
    assert "keeps G54 X and Y; touch off every tool again." in text
    assert "The length offsets stay." not in text


def test_clamp_and_its_stop():
    held = job(hold={"method": "bore", "clamp_diameter": 12, "clamp_height": 18})
    text = read(sheet(held, program(stop="fit the clamp"), PROOF)).text
    assert "STOP fit the clamp" in text
    assert "clamp through the bore" in text
    assert "at most ⌀12 and 18 mm high" in text
    # Only what is cut after the stop has to clear the clamp.
    assert "≥ 15.4" in text
    assert "≥ 31.3 clears clamp" in text
    assert "Z +18.00 top of clamp" in text


@pytest.mark.parametrize(("offset", "number"), [("G54", 1), ("G57", 4), ("G59", 6), ("G59.3", 9)])
def test_work_offset_is_set_once_and_every_tool_measured(offset, number):
    made = steps(job(work_offset=offset), [4, 7, 9], file_names=["wheel.nc"], deepest=-12.4)
    titles = [step.title for step in made]
    assert titles == [
        "Look at the machine and its control",
        "Clamp the stock",
        f"Set {offset} X and Y",
        f"Set {offset} Z once, with the Z setter",
        "Measure each tool's length offset",
        "Check before the first cut",
        "Run",
    ]
    lines = [" ".join(step.lines) for step in made]
    assert f"G10 L2 P{number} Z[N − h]" in lines[3]
    assert "Do not touch it again" in lines[3]
    assert "For each of T4, T7, T9" in lines[4]
    assert "Hn = Zn − N" in lines[4]
    assert f"T4 M6, {offset}, G43 H4" in lines[5]
    assert "Z −12.40, 2.40 mm below the plate" in lines[1]


def test_length_offsets_of_the_procedure_are_right():
    """With H = Zn - N and work offset Z = N - h, G43 brings every tip to the programmed height."""
    surface, h = -310.0, 50.0
    nose_to_tip = {1: 80.0, 2: 121.5}
    n = surface + h
    for length in nose_to_tip.values():
        zn = surface + h + length
        programmed = 7.25
        machine = programmed + (n - h) + (zn - n)
        assert machine - length == pytest.approx(surface + programmed)


def test_origin_words():
    for origin, words in (("corner", "lower left corner"), ("centre", "centre of the stock")):
        text = read(sheet(job(origin=origin), program(), PROOF)).text
        assert f"X0 Y0 the {words}" in text
    corner = " ".join(steps(job(origin="corner"), [4], file_names=[""], deepest=0.0)[2].lines)
    assert "X reads −r" in corner


def test_plan_view_is_to_scale():
    placed = job(slotted_plate(), origin="corner", stock={"length": 90, "width": 66})
    root = ElementTree.fromstring(plan_view(placed, program(), trace(program()), [(3.0, 4.0)]))  # noqa: S314 - our own
    rect = root.find(f"{SVG}rect")
    assert [float(rect.get(key)) for key in ("x", "y", "width", "height")] == [0, -66, 90, 66]
    words = [text.text for text in root.iter(f"{SVG}text")]
    assert {"stock 90.0", "stock 66.0", "part 60.00", "part 40.00", "tab 1", "tab 4", "X", "Y"} <= set(words)
    spot = [c for c in root.iter(f"{SVG}circle") if c.get("stroke") == "#d4001a"]
    assert [(c.get("cx"), c.get("cy")) for c in spot] == [("3", "-4")]
    uses = list(root.iter(f"{SVG}use"))
    assert uses[0].get("stroke-width") == "6"
    assert {use.get("href") for use in uses} == {"#wheel-t7"}
    holes = [c for c in root.iter(f"{SVG}circle") if c.get("r") == "4" and c.get("fill") == "none"]
    assert [(c.get("cx"), c.get("cy")) for c in holes] == [("0", "-20"), ("0", "0")]


def test_passes_over_one_another_are_drawn_once():
    once = (Rapid(0, 0, 5), Feed(10, 0, -1, 100), Feed(10, 10, None, 100))
    again = (*once, Rapid(0, 0, 5), Feed(10, 0, -2, 100), Feed(10, 10, None, 100))
    views = []
    for moves in (once, again):
        made = Program("wheel", "G54", 5.0, (ToolSection(MILL, 1, "off", (Operation("o", moves),)),))
        root = ElementTree.fromstring(plan_view(job(), made, trace(made)))  # noqa: S314 - our own
        views.append(root.find(f"{SVG}defs/{SVG}path").get("d"))
    assert views[0] == views[1] == "M0,0L10,0L10,-10"


@pytest.mark.parametrize("ccw", [True, False])
@pytest.mark.parametrize("end", [10, 100, 170, 190, 260, 350])
def test_svg_arc_bends_the_right_way(end, ccw):
    """The centre that SVG's rules give (SVG 2, B.2.4, circle, y down) is the arc's own."""
    centre, radius = (3.0, -2.0), 5.0
    a, b = (
        (centre[0] + radius * math.cos(math.radians(t)), centre[1] + radius * math.sin(math.radians(t)))
        for t in (0, end)
    )
    data = svg.arc_to(a, b, centre, ccw=ccw)
    r, large, sweep, x, y = re.fullmatch(r"A([\d.]+) [\d.]+ 0 (\d) (\d) (.+),(.+)", data).groups()
    (x1, y1), (x2, y2) = (a[0], -a[1]), (float(x), float(y))
    dx, dy = (x1 - x2) / 2, (y1 - y2) / 2
    root = math.sqrt(max(0.0, float(r) ** 2 / (dx * dx + dy * dy) - 1))
    sign = 1 if large != sweep else -1
    found = ((x1 + x2) / 2 + sign * root * dy, (y1 + y2) / 2 - sign * root * dx)
    assert found == pytest.approx((centre[0], -centre[1]), abs=0.1)


def test_full_turn_is_two_arcs():
    data = svg.arc_to((5.0, 0.0), (5.0, 0.0), (0.0, 0.0), ccw=True)
    assert data == "A5 5 0 0 0 -5,0A5 5 0 0 0 5,0"


def test_trace_follows_every_kind_of_move():
    holes, stop, outside = trace(program(stop="wait"))
    assert [s.drilled for s in holes.strokes] == [False, False, True, False, True]
    assert (holes.bottom, outside.bottom) == (-12.4, -10.3)
    assert (stop.stops, stop.bottom) == (("wait",), None)
    arc = outside.strokes[4]
    assert (arc.start, arc.end, arc.centre) == ((-40, 0, -5), (40, 0, -10.3), (0, 0))
    assert outside.strokes[-1].end == (40, 0, 5)
    assert outside.strokes[-1].feed == 0
