import csv
import io
import math
import re
from pathlib import Path

import numpy as np
import pytest
from mechwright_saw_list.page import STEM, SawList

from mechwright import (
    Build,
    Channel,
    Design,
    Family,
    Instance,
    Loop,
    Motion,
    Outline,
    Page,
    Parameters,
    Part,
    Poses,
    circle,
    host,
)


class Sample(Family[Parameters]):
    """A ring that is there twice, and a block that is no plate."""

    name = "sample"
    title = "Sample"
    summary = "A ring and a block."
    Params = Parameters

    def solve(self, params, samples):
        still = Poses(np.zeros((samples, 3)), np.tile(np.eye(3), (samples, 1, 1)))
        return Motion("turn", {"turn": Channel(np.linspace(0.0, 1.0, samples), "rad")}, {"ring": still})

    def parts(self, params):
        import cadquery as cq

        ring = Outline(Loop((circle((0.0, 0.0), 20.0),)), (Loop((circle((0.0, 0.0), 5.0, clockwise=True),)),))
        return [
            Part("ring", ring, 8.0, "brass", instances=(Instance("ring"), Instance("ring", z=9.0))),
            Part("block", None, 0.0, "steel", build=lambda: cq.Solid.makeBox(10, 20, 30)),
        ]


@pytest.fixture(scope="module")
def files():
    with Build(Design("sample", Sample(), Parameters(), Path("sample.toml"), ""), host()) as build:
        made = SawList().files(build)
        assert SawList().files(build) == made, "the same build gives the same bytes"
    return made


def test_it_is_registered():
    assert isinstance(host().get(Page, "saw-list"), SawList)


def test_each_part_has_a_line_with_what_it_weighs(files):
    ring, block = csv.DictReader(io.StringIO(files[f"{STEM}.csv"]))
    grams = math.pi * (20**2 - 5**2) * 8 / 1000 * 8.5
    assert (ring["part"], ring["count"], ring["material"]) == ("ring", "2", "brass")
    assert float(ring["mass_g"]) == pytest.approx(grams, abs=1e-3)
    assert float(ring["total_g"]) == pytest.approx(2 * grams, abs=1e-3)
    assert float(block["mass_g"]) == pytest.approx(6 * 7.85, abs=1e-3)
    assert block["count"] == "1"


def test_the_stock_is_the_box_around_the_part(files):
    ring, block = csv.DictReader(io.StringIO(files[f"{STEM}.csv"]))
    sizes = ("length_mm", "width_mm", "height_mm")
    assert [float(ring[size]) for size in sizes] == [40, 40, 8]
    assert [float(block[size]) for size in sizes] == [10, 20, 30]


def test_the_page_shows_the_same_and_the_sum(files):
    page = files[f"{STEM}.html"]
    assert "40.0 × 40.0 × 8.0" in page
    (total,) = re.findall(r"<p>([\d.]+) kg", page)
    lines = csv.DictReader(io.StringIO(files[f"{STEM}.csv"]))
    assert float(total) == pytest.approx(sum(float(line["total_g"]) for line in lines) / 1000, abs=5e-4)
