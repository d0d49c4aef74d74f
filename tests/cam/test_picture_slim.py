"""Dimensions in the picture of a setup do not run into each other, however slim the plate is."""

import itertools
import re

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.contracts.part import Part, Profile
from mechwright.geometry import Loop, Outline
from mechwright_cam.pages.picture import plan_view
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.settings import CamSettings

TOOL = (load_library().get("mill-6"),)
TEXT = re.compile(
    r'<text x="([-\d.]+)" y="([-\d.]+)" font-size="([-\d.]+)"([^>]*)>((?:stock|part) [\d.]+|[\d.]+)</text>'
)


def slim(width: float, height: float, origin: str) -> Job:
    x, y = width / 2, height / 2
    loop = Loop.polygon([(-x, -y), (x, -y), (x, y), (-x, y)])
    part = Part("link", Outline(loop), 4, "steel", machined=(Profile("outside", loop, "outside", 0, 4),))
    return make_job(
        part,
        CamSettings.model_validate({"origin": origin, "hold": {"tabs": 2}, "stock": {"margin": 9}}),
        TOOL,
    )


def words(picture: str) -> list[tuple[str, shapely.Polygon]]:
    """The dimensions' words and the rectangles that they take, 0.55 of their height a letter."""
    found = []
    for x, y, size, rest, text in TEXT.findall(picture):
        left, base, high = float(x), float(y), float(size)
        half = 0.275 * high * len(text)
        box = shapely.box(left - half, base - 0.75 * high, left + half, base)
        if "rotate(-90" in rest:
            box = shapely.affinity.rotate(box, -90, origin=(left, base))
        found.append((text, box))
    return found


def test_dimensions_stand_beside_the_stock_in_two_rows() -> None:
    """Stock and the way to the origin on the left and below; the part, nearer, on the right and above."""
    picture = plan_view(slim(60, 40, "axis"))
    assert re.search(r'<rect x="-39" y="-29" width="78" height="58"[^>]*stroke-width="0.17"', picture)
    lines = re.findall(r'M([-\d.]+),([-\d.]+)L([-\d.]+),([-\d.]+)" fill="none" stroke="(#\w+)"', picture)
    rows = [tuple(map(float, line[:4])) for line in lines]
    size = float(re.search(r'font-size="([\d.]+)" text-anchor="middle" fill="#333333"', picture)[1])
    near, far = 1.7 * size, 2 * 1.7 * size
    ends = [
        (-39, 29 + far, 39, 29 + far), (-39 - far, 29, -39 - far, -29),  # the stock
        (-30, -29 - near, 30, -29 - near), (39 + near, 20, 39 + near, -20),  # the part
        (-39, 29 + near, 0, 29 + near), (-39 - near, 29, -39 - near, 0),  # the origin
    ]  # fmt: skip
    assert rows == [pytest.approx(one, abs=0.02) for one in ends]
    # The heads of the two axes begin before their lines end.
    for line, base, tip in re.findall(
        r'M0,0H([\d.]+)M.*?<path d="M([\d.]+),0L([\d.]+),', picture
    ) + re.findall(r'M0,0V-([\d.]+)".*?<path d="M0,-([\d.]+)L[-\d.]+,-([\d.]+)L', picture):
        assert float(tip) < float(line) < float(base)
    assert [line[4] for line in lines] == ["#333333"] * 4 + ["#b00020"] * 2


@settings(max_examples=40)
@given(
    width=st.floats(5, 300), height=st.floats(5, 300), origin=st.sampled_from(["axis", "corner", "centre"])
)
def test_no_words_cover_each_other(width: float, height: float, origin: str) -> None:
    picture = plan_view(slim(width, height, origin))
    boxes = words(picture)
    assert len(boxes) == (4 if origin == "corner" else 6)
    for (one, first), (other, second) in itertools.combinations(boxes, 2):
        assert first.intersection(second).area < 1e-6, (one, other)
    x, y, wide, high = map(float, re.search(r'viewBox="([^"]*)"', picture)[1].split())
    frame = shapely.box(x, y, x + wide, y + high)
    for text, box in boxes:
        assert frame.contains(box), text


@pytest.mark.parametrize(("width", "height"), [(200, 6), (6, 200)])
def test_words_of_a_short_dimension_stand_beside_it(width: float, height: float) -> None:
    job = slim(width, height, "axis")
    box = dict(words(plan_view(job)))[f"part {min(width, height):.2f}"]
    plate = shapely.transform(job.target, lambda p: p * (1, -1))
    x0, y0, x1, y1 = plate.bounds
    along = (x0, x1) if width < height else (y0, y1)
    taken = (box.bounds[0], box.bounds[2]) if width < height else (box.bounds[1], box.bounds[3])
    assert taken[0] > along[1] or taken[1] < along[0]
