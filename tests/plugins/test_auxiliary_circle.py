"""The construction with the auxiliary circle: an independent check's numbers, and the closed forms."""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from mechwright.errors import GeometryError
from mechwright.testing.commands import run
from mechwright_slider_crank.kinematics.simulated_stroke import simulated
from mechwright_slider_crank.pages.circle import AuxiliaryCircle
from mechwright_slider_crank.pages.construction import constructed, page
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_slider_crank.synthesis.stroke import from_crank, from_offset, from_rod, ranges

ROOT = Path(__file__).parents[2]
FACTS = json.loads((ROOT / "tests" / "data" / "auxiliary-circle.json").read_text(encoding="utf-8"))["facts"]
CIRCLE = AuxiliaryCircle(120, 1.5)
FOUND = {"e50": CIRCLE.by_offset(50), "a35": CIRCLE.by_crank(35), "b130": CIRCLE.by_rod(130)}


def read(name):
    """What the construction has for a fact of the examples or of the circle."""
    if name in FOUND_OF_CIRCLE:
        return FOUND_OF_CIRCLE[name]
    case, what = name.split(".")
    one = FOUND[case]
    return {
        "a": one.crank,
        "b": one.rod,
        "e": one.offset,
        "lambda_deg": math.degrees(one.position),
        "A": one.pivot,
        "E": one.divide,
        "G": one.foot,
        "B_at_C1": one.pin,
        "AF": abs(one.pivot - CIRCLE.middle),
    }[what]


FOUND_OF_CIRCLE = {
    "O": CIRCLE.centre,
    "F": CIRCLE.middle,
    "R": CIRCLE.radius,
    "FC2": abs(CIRCLE.middle - 120),
}
SINGLE = [fact for fact in FACTS if not re.search(r"family|limits", fact["name"])]


@pytest.mark.parametrize("fact", SINGLE, ids=lambda fact: fact["name"])
def test_places_and_lengths_are_those_of_the_reference(fact):
    wanted = fact["expected"]
    wanted = complex(*wanted) if isinstance(wanted, list) else wanted
    assert read(fact["name"].removeprefix("aux.")) == pytest.approx(wanted, abs=fact["tolerance"])


@pytest.mark.parametrize(
    "fact", [fact for fact in FACTS if "family" in fact["name"]], ids=lambda f: f["name"]
)
def test_solutions_over_the_place_of_the_pivot(fact):
    one = CIRCLE.at(math.radians(fact["inputs"]["lambda_deg"]))
    assert (one.crank, one.rod, one.offset) == pytest.approx(fact["expected"], abs=fact["tolerance"])


@pytest.mark.parametrize(
    "fact", [fact for fact in FACTS if "limits" in fact["name"]], ids=lambda f: f["name"]
)
def test_limits_are_those_of_the_reference(fact):
    circle = AuxiliaryCircle(1.0, fact["inputs"]["K"])
    last = circle.at(circle.last)
    assert (last.crank, last.rod, last.offset) == pytest.approx(fact["expected"], abs=fact["tolerance"])
    assert last.rod == pytest.approx(last.crank + last.offset), "there the crank only just turns"


def test_construction_closed_form_and_motion_agree():
    rng = np.random.default_rng(4)
    for _ in range(60):
        stroke, ratio = 10 ** rng.uniform(0, 3), rng.uniform(1.05, 2.9)
        circle = AuxiliaryCircle(stroke, ratio)
        one = circle.at(rng.uniform(0.02, 0.98) * circle.last)
        for other in (circle.by_offset(one.offset), circle.by_crank(one.crank), circle.by_rod(one.rod)):
            assert other.pivot == pytest.approx(one.pivot, abs=1e-7 * stroke / circle.theta)
        lengths = (one.crank, one.rod, one.offset)
        for closed, given in ((from_offset, one.offset), (from_crank, one.crank), (from_rod, one.rod)):
            same = closed(stroke, ratio, given)
            assert (same.crank, same.rod, same.offset) == pytest.approx(lengths, rel=1e-7)
        a, c1, c2 = one.pivot, *circle.ends
        assert abs(a - circle.centre) == pytest.approx(circle.radius)
        assert (abs(a - c1), abs(a - c2)) == pytest.approx((one.rod - one.crank, one.rod + one.crank))
        assert abs(one.divide - circle.middle) == pytest.approx(abs(c2 - circle.middle))
        assert abs(one.pin - c1) == pytest.approx(one.rod)
        params = SliderCrankParams.model_construct(crank=one.crank, rod=one.rod, offset=one.offset)
        assert simulated(params.linkage) == pytest.approx((stroke, ratio), rel=1e-7)


@pytest.mark.parametrize(
    ("make", "name", "value", "words"),
    [
        ("by_offset", "offset", 1.001, "MN"),
        ("by_crank", "crank", 0.999, "circle II"),
        ("by_rod", "rod", 1.001, "circle III"),
    ],
)
def test_what_misses_the_arc_is_refused_with_the_limit(make, name, value, words):
    low, high = getattr(ranges(120, 1.5), name)
    limit = low if name == "crank" else high
    getattr(CIRCLE, make)(limit)
    with pytest.raises(GeometryError, match=f"{words}.*{limit:.6g}"):
        getattr(CIRCLE, make)(limit * value)
    with pytest.raises(GeometryError, match=words):
        getattr(CIRCLE, make)(high if name == "crank" else low)


def test_no_circle_without_a_quick_return():
    for ratio in (1.0, 3.0):
        with pytest.raises(GeometryError, match="between 1 and 3"):
            AuxiliaryCircle(120, ratio)
    with pytest.raises(GeometryError, match="54"):
        CIRCLE.at(math.radians(55))


@pytest.mark.parametrize("table", [{}, {"offset": -12, "assembly": "behind", "clockwise": True}])
def test_a_design_lies_on_the_circle_of_its_own_stroke(table):
    params = SliderCrankParams(**table)
    _, found = constructed(params)
    lengths = (params.crank, params.rod, abs(params.offset))
    assert (found.crank, found.rod, found.offset) == pytest.approx(lengths, rel=1e-9)


def test_without_a_circle_there_is_no_page():
    assert constructed(SliderCrankParams(offset=0)) is None
    assert constructed(SliderCrankParams(rod=35)) is None
    assert constructed(SliderCrankParams(rod=40)) is None


def test_the_page_has_each_step(tmp_path):
    html = page("name", CIRCLE, FOUND["a35"])
    assert re.findall(r"<h2>(\d)\.", html) == list("123456")
    for words in ("MN at e = 121.825", "r = 2 a = 70", "r = b/cos(θ/2) = 169.857", "b ≤ 184.661", "38.3042°"):
        assert words in html
    design = tmp_path / "design.toml"
    design.write_text('format = 1\nfamily = "slider-crank"\n[parameters]\n')
    assert run("solve", design, "-o", tmp_path / "out", "--samples", "31").returncode == 0
    assert (tmp_path / "out" / "construction.html").exists()


def test_pages_and_pictures_of_the_examples_are_up_to_date():
    import auxiliary_circle

    for path, content in auxiliary_circle.pages().items():
        assert path.read_text(encoding="utf-8") == content, "run: python docs/seeds/auxiliary_circle.py"
    for name, content in auxiliary_circle.drawn().items():
        shown = (auxiliary_circle.IMAGES / name).read_text(encoding="utf-8")
        assert shown == content, "run: python docs/seeds/auxiliary_circle.py"
