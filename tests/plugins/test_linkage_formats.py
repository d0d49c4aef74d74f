"""Drawings of other programs as linkages: points, links, slides and the driver, and files that are broken."""

import json

import pytest

from mechwright import DesignError
from mechwright_linkage.formats.reading import parameters_from
from mechwright_linkage.parameters import LinkageParams

TABLE = """point,x,y,links,angle
A0,0,0,ground crank,
A,20,25,crank coupler,
B,90,60,coupler rocker,
B0,80,0,ground rocker,
P,60,90,coupler,
"""
SLIDER = """point,x,y,links,angle
A0,0,0,ground crank,
A,30,0,crank rod,
B,100,0,rod slider,
B,100,0,ground slider,0
"""
PYLINKAGE = {
    "name": "four-bar",
    "ground": {"id": "g", "joints": ["a", "d"]},
    "joints": [
        {"id": "a", "type": "ground", "position": [0, 0], "name": "A"},
        {"id": "b", "type": "revolute", "position": [20, 25], "name": "B"},
        {"id": "c", "type": "revolute", "position": [90, 60], "name": "C"},
        {"id": "d", "type": "ground", "position": [80, 0], "name": "D"},
        {
            "id": "t",
            "type": "tracker",
            "name": "T",
            "ref_joint1_id": "b",
            "ref_joint2_id": "c",
            "distance": 10.0,
            "angle": 0.0,
        },
    ],
    "links": [
        {"id": "l1", "type": "driver", "joints": ["a", "b"], "motor_joint": "a", "name": "crank"},
        {"id": "l2", "type": "link", "joints": ["b", "c"], "name": "coupler"},
        {"id": "l3", "type": "link", "joints": ["c", "d"], "name": "rocker"},
    ],
}
PMKS = """ground,input,R,0,0,tfft
input,coupler,R,20,25
coupler,output,R,90,60
ground,output,R,80,0
coupler,R,60,90
"""


def read(text: str) -> LinkageParams:
    return LinkageParams.model_validate(parameters_from(text, "drawing"))


@pytest.mark.parametrize("text", [TABLE, json.dumps(PYLINKAGE), PMKS], ids=["csv", "pylinkage", "pmks"])
def test_a_four_bar_is_the_same_from_every_format(text: str) -> None:
    params = read(text)
    places = sorted((one.x, one.y) for one in params.points.values())
    assert {(0.0, 0.0), (20.0, 25.0), (90.0, 60.0), (80.0, 0.0)} <= set(places)
    assert len(params.links) == 4
    assert set(params.links[params.driver_links[0]]) & set(params.links["ground"])
    sizes = sorted(len(own) for own in params.links.values())
    assert sizes == [2, 2, 2, 3]


def test_a_tracker_stands_on_the_line_of_its_joints() -> None:
    point = read(json.dumps(PYLINKAGE)).points["T"]
    assert abs(complex(point.x - 20, point.y - 25)) == pytest.approx(10.0, abs=1e-9)
    assert complex(point.x - 20, point.y - 25) / complex(70, 35) == pytest.approx(10 / abs(70 + 35j))


def test_a_slide_of_a_table() -> None:
    params = read(SLIDER)
    (slide,) = params.slides
    assert (slide.block, slide.guide, slide.point, slide.angle) == ("slider", "ground", "B", 0.0)
    assert params.links["slider"] == ("B",)


def test_a_slide_of_pmks() -> None:
    params = read("ground crank R 0 0\ncrank rod R 30 0\nrod slider R 100 0\nground slider P 100 0 0\n")
    assert [(one.block, one.guide, one.angle) for one in params.slides] == [("slider", "ground", 0.0)]


def test_a_pin_in_a_slot_of_the_ground_gets_a_block() -> None:
    params = read("ground crank R 0 0\ncrank rod R 30 0\nground rod RP 100 0 15\n")
    (slide,) = params.slides
    assert slide.angle == 15.0
    assert slide.block in params.links
    assert slide.point in params.links["rod"]


def pmks_address(flags: str) -> str:
    """A four-bar: three decimals in 64 digits, 0 in front for minus; 20 is Jw, 25 is 6Q, 90 is L_G."""
    digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"

    def number(value: float) -> str:
        whole, text = abs(round(value * 1000)), ""
        while whole:
            whole, digit = divmod(whole, 64)
            text = digits[digit] + text
        return ("0" if value < 0 else "") + (text or "0")

    places = [(0, 0), (20, 25), (90, -60), (80, 0)]
    joints = [
        f"{flag}{key},{name},{number(x)},{number(y)},0"
        for flag, key, name, (x, y) in zip(flags, "abcd", "ABCD", places, strict=True)
    ]
    links = [
        f"YR{name},{name},1,1,0,0,c,{ends[0]},{ends[1]},,"
        for name, ends in (("1", "ab"), ("2", "bc"), ("3", "cd"))
    ]
    return "https://example.org/?" + ".".join(["1", "1", "1", "1", *joints, "", *links, "", "", "x"])


def test_an_address_of_pmks_plus() -> None:
    params = read(pmks_address("MGGK"))
    assert {(one.x, one.y) for one in params.points.values()} == {(0, 0), (20, 25), (90, -60), (80, 0)}
    assert params.links["ground"] == ("A", "D")
    assert params.driver_links[0] == "1"


BROKEN = {
    "point,x,y,links\nA,1,zwei,ground crank\n": "line 2: y is 'zwei', which is no number",
    "point,x,y,links\nA,1,2,\n": "line 2: it needs a point and its links",
    "point,x\n": "it has to be point,x,y,links",
    "point,x,y,links\nA,0,0,ground crank\nA,1,0,crank rod\n": "line 3: A stands elsewhere",
    "point,x,y,links,angle\nA,0,0,ground crank rod,0\n": "a slide has two links",
    "point,x,y,links\nA,0,0,crank rod\n": 'no point stands on a link called "ground"',
    '{"joints": 3}': "it is no mechanism of pylinkage",
    "ground crank G 0 0\n": "gears in contact (G) are not read",
    "ground crank R 0\n": "a line is: links, R, P or RP",
    "crank rod RP 1 2 3\n": "does not say which has the slot",
    "https://x/?a.b": "it is no address of PMKS+",
}


@pytest.mark.parametrize("text", BROKEN, ids=range(len(BROKEN)))
def test_a_broken_file_is_refused_with_its_place(text: str) -> None:
    with pytest.raises(DesignError, match="drawing: ") as caught:
        parameters_from(text, "drawing")
    assert BROKEN[text] in str(caught.value)


def test_a_welded_joint_is_refused() -> None:
    with pytest.raises(DesignError, match="is welded"):
        parameters_from(pmks_address("MOGK"), "drawing")
