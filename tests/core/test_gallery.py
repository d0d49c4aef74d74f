"""The gallery of a synthesis: what designs are compared by, which are on the front, and the page."""

import json
import math
import re

import numpy as np
import pytest

import mechwright as mw
from mechwright.contracts.motion import Scalar
from mechwright.contracts.synthesis import Candidate, Reason
from mechwright.scripting.gallery import Shown, gallery
from mechwright.scripting.merits import best_of, in_words, merits


def rows(*values):
    return [
        {"error": Scalar(e, "mm"), "size": Scalar(s, "mm"), "least_transmission_angle": Scalar(a, "rad")}
        for e, s, a in values
    ]


def test_the_front_holds_what_no_other_beats():
    assert best_of(rows((0.1, 50, 0.7), (0.2, 40, 0.7), (0.2, 50, 0.8), (0.2, 50, 0.7))).tolist() == [0, 1, 2]
    # A larger transmission angle is better; rounding decides nothing.
    assert best_of(rows((0, 50, 0.7), (0, 50, 0.8))).tolist() == [1]
    assert best_of(rows((1e-14, 50, 0.7), (3e-15, 50 * (1 + 1e-13), 0.7))).tolist() == [0, 1]
    # What one design does not tell counts for none.
    short = rows((0.1, 50, 0.7), (0.1, 60, 0.7))
    del short[0]["size"]
    assert best_of(short).tolist() == [0, 1]


def test_merits_are_those_of_the_motion():
    """A central slider-crank with a point on the crank's pin: its acceleration is ω² a."""
    slider = mw.design("slider-crank", crank=30, rod=100, offset=0, speed=60, coupler_x=0.0)
    found = merits(Candidate(slider.design.params, Scalar(0.25, "mm")), slider)
    assert found["error"].value == 0.25
    assert found["peak_acceleration"].value == pytest.approx(30 * math.tau**2, rel=1e-9)
    assert found["least_transmission_angle"].value == pytest.approx(math.acos(0.3))
    assert found["drive_torque"] == slider.motion.scalars["drive_torque_max"]
    outlines = [part.outline.outer.flatten() for part in slider.design.parts() if part.outline]
    assert found["size"].value == pytest.approx(max(float(np.ptp(one, axis=0).max()) for one in outlines))
    told = Candidate(slider.design.params, Scalar(0.0, "mm"), {"longest_link": Scalar(100.0, "mm")})
    assert merits(told, slider)["size"].value == 100


def test_the_page_escapes_what_it_is_told_and_needs_no_other_file():
    one, two = rows((0, 50, 0.7), (0.5, 60, 0.5))
    picture = {"window": [0, 0, 1, 1], "shapes": [], "traces": ["</script>"]}
    designs = [Shown("arm-1", one, True, picture), Shown("arm-2", two, False, None)]
    page = gallery("a<b", "Four-bar", "9 found, 2 given", [Reason("a.b-c", 7, "x < y")], [], designs)
    assert "<h1>a&lt;b</h1>" in page
    assert "7 b c" in page
    assert "x &lt; y" in page
    assert "</script>" not in re.search(r'id="moving">(.*?)</script>', page, re.S)[1]
    assert json.loads(re.search(r'id="moving">(.*?)</script>', page, re.S)[1]) == [picture]
    assert page.count("<svg role") == 1
    assert page.count('class="best"') == 1
    assert "error 0 mm, size 50 mm, angle 40.11°" in page
    assert not re.search(r'(src|href)="(http|//)', page)
    assert in_words(Scalar(math.pi / 6, "rad")) == "30°"


PATHS = {
    "four-bar": {"points": [[20.0 + k, 20.0 + 5 * k] for k in range(6)], "starts": 6000, "designs": 1},
    "slider-crank": {"points": [[20.0 + k, 20.0 + 5 * k] for k in range(6)], "starts": 6000, "designs": 1},
}


@pytest.mark.parametrize("family", PATHS)
def test_pictures_show_the_points_that_were_asked_for_where_the_path_runs(family):
    """Each dot lies on the drawn path, also where a design stands in the origin; and the window holds it."""
    found = mw.synthesize(family, "path", **PATHS[family])
    page = found.gallery()
    assert "Dots are the places that were asked for" in page
    (picture,) = json.loads(re.search(r'id="moving">(.*?)</script>', page, re.S)[1])
    dots = np.array([[float(n) for n in dot.split()] for dot in re.findall(r"M(.*?)h0", picture["asked"])])
    assert len(dots) == 6
    error = found.result.candidates[0].residual.value
    curve = np.array([[float(n) for n in one.split()] for one in picture["traces"][0].strip("MZ").split("L")])
    ends = np.roll(curve, -1, axis=0)
    along = np.clip(((dots[:, None] - curve) * (ends - curve)).sum(-1) / ((ends - curve) ** 2).sum(-1), 0, 1)[
        ..., None
    ]
    near = np.linalg.norm(dots[:, None] - curve - along * (ends - curve), axis=-1).min(axis=1)
    assert near.max() < 3 * error + 0.3  # of a path in steps of five degrees
    left, bottom, width, height = picture["window"]
    assert ((dots > [left, bottom]) & (dots < [left + width, bottom + height])).all()


def test_minutes_are_those_of_all_programs():
    """A plate of which nothing is asked but to be there; two of a part take twice as long."""
    plate = mw.design("plate")
    times = {one.name: one.proof.as_dict()["time_estimate_s"] for one in plate.programs}
    (part,) = plate.parts
    count = max(1, len(part.instances))
    assert plate.result("minutes") == pytest.approx(count * sum(times.values()) / 60)
    assert plate.result("minutes") > 0
