"""Acceleration poles of an accelerating crank: the synthesis through them, and the page that shows them."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from pydantic import ValidationError

from mechwright.mechanics.planar import Turning, acceleration_pole
from mechwright.pipeline.poles import NAME
from mechwright.pipeline.poles.page import page as page_of
from mechwright.pipeline.poles.planes import MARKED
from mechwright.testing.commands import run
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.kinematics.reach import bar_of
from mechwright_four_bar.poles_page import FourBarPoles
from mechwright_four_bar.synthesis.poles.equations import PoleProblem as FourBarProblem
from mechwright_slider_crank.family import SliderCrankFamily
from mechwright_slider_crank.pages.poles import SliderCrankPoles
from mechwright_slider_crank.synthesis.poles.equations import PoleProblem as SliderProblem


def silent(done, what):
    pass


def coupler(params, crank):
    if hasattr(params, "rod"):
        return params.linkage.bodies(crank.theta, crank).rod
    bar = bar_of(params)
    return close(bar, crank.theta).bodies(bar, crank)["coupler"]


SLIDER, FOUR = SliderCrankFamily(), FourBars()


@pytest.mark.parametrize(
    ("family", "table", "angle"),
    [
        (SLIDER, {"acceleration_ratios": (0.3,)}, "phi_"),
        (SLIDER, {"acceleration_ratios": (0.0, 0.1), "slide_direction": 20}, "phi_"),
        (SLIDER, {"poles": ((60, -12.6), (41.2, 41.6), (20, 70)), "rotations": (), "starts": 800,
                  "acceleration_ratios": (0.1, 0.2, -0.1)}, "phi_"),
        (FOUR, {"acceleration_ratios": (0.3,)}, "crank_angle_"),
        (FOUR, {"acceleration_ratios": (0.3, -0.2, 0.1)}, "crank_angle_"),
    ],
    ids=("slider", "slider-each", "slider-three", "four-bar", "four-bar-each"),
)  # fmt: skip
def test_poles_are_where_they_are_wanted(family, table, angle):
    requirement = family.requirements["poles"](**{"starts": 1200, **table})
    found = family.synthesise("poles", requirement, silent)
    assert found.candidates, found.findings
    ratios = requirement.acceleration_ratios * (1 if len(requirement.acceleration_ratios) > 1 else 3)
    common = len(set(ratios)) == 1
    assert any("set acceleration_ratio" in one.message for one in found.findings) is not common
    for candidate in found.candidates:
        params = candidate.params
        assert params.acceleration_ratio == (ratios[0] if common else 0.0)
        for number, place in enumerate(requirement.poles):
            given = candidate.figures[f"{angle}{number + 1}"]
            phi = np.atleast_1d(np.radians(given.value) if given.unit == "deg" else given.value)
            pole = acceleration_pole(coupler(params, Turning.of(phi, 1.0, ratios[number])))
            assert pole.fixed[0] == pytest.approx(complex(*place), abs=1e-7)


@pytest.mark.parametrize("family", [SLIDER, FOUR])
def test_ratios_are_one_or_as_many_as_poles(family):
    poles = len(family.requirements["poles"]().poles)
    with pytest.raises(ValidationError, match="for all, or one for each"):
        family.requirements["poles"](acceleration_ratios=(0.1,) * (5 - poles))
    with pytest.raises(ValidationError, match="less than or equal to 2"):
        family.requirements["poles"](acceleration_ratios=(2.5,))


@pytest.mark.parametrize("turns", [True, False])
def test_slopes_of_the_slider_cranks_equations_are_their_differences(turns):
    rng = np.random.default_rng(5)
    places = rng.normal(size=3) + 1j * rng.normal(size=3)
    ratios = np.array([0.4, -1.2, 0.7])
    problem = SliderProblem(places, np.array([0.0, 0.8, 2.0]) if turns else None, -1, ratios)
    x = rng.normal(size=(4, 4 if turns else 6))
    slopes, step = problem.slopes(x), 1e-6
    for column in range(x.shape[1]):
        more, less = x.copy(), x.copy()
        more[:, column] += step
        less[:, column] -= step
        quotient = (problem.residual(more) - problem.residual(less)) / (2 * step)
        np.testing.assert_allclose(slopes[:, :, column], quotient, rtol=1e-5, atol=1e-5)


def test_given_ratios_take_no_unknown():
    # As many equations as unknowns, at a random linkage: full rank, for any ratios that are given.
    rng = np.random.default_rng(8)
    ratios = rng.uniform(-1, 1, 3)
    turns = np.array([0.0, 0.9, 2.3])
    two = SliderProblem(np.ones(2, complex), turns[:2], 1, ratios[:2])
    assert np.linalg.matrix_rank(two.slopes(rng.normal(size=(1, 4)))[0]) == 4
    three = SliderProblem(np.ones(3, complex), None, 1, ratios)
    assert np.linalg.matrix_rank(three.slopes(rng.normal(size=(1, 6)))[0]) == 6
    x = rng.normal(size=4) * 0.3
    given = FourBarProblem(np.zeros(3, complex) + 1, turns, None, None, 1, True, ratios)
    gamma, _ = given._poles(x)
    solved = FourBarProblem(gamma * (50 + 20j), turns, None, None, 1, True, ratios)
    assert np.abs(solved.residual(x)).max() < 1e-12
    steps = 1e-6 * np.eye(4)
    matrix = [(solved.residual(x + one) - solved.residual(x - one)) / 2e-6 for one in steps]
    assert np.linalg.matrix_rank(np.array(matrix), tol=1e-6) == 4


PAGES = (
    (SliderCrankPoles(), SLIDER, {"offset": 12, "acceleration_ratio": 0.2}),
    (SliderCrankPoles(), SLIDER, {"rod": 35}),
    (SliderCrankPoles(), SLIDER, {"crank": 50, "rod": 30, "slide_direction": 120, "clockwise": True}),
    (SliderCrankPoles(), SLIDER, {"rod": 40, "slide_direction": 70}),
    (FourBarPoles(), FOUR, {"ground_angle": 25, "branch": "crossed", "direction": "cw"}),
    (FourBarPoles(), FOUR, {"crank": 70, "coupler": 60, "follower": 75, "ground": 110}),
    (FourBarPoles(), FOUR, {"crank": 40, "coupler": 80, "follower": 70, "ground": 110}),
)


@pytest.mark.parametrize(("page", "family", "table"), PAGES)
def test_loci_and_circles_of_the_page_are_those_of_the_motion(page, family, table):
    params = family.Params(**table)
    shown = page.couplers(params)[NAME]
    motion = family.solve(params, shown.way().size)
    if not shown.course.rocks:  # a lever has a law of its own
        for number, names in enumerate((("xG", "yG"), ("xG_coupler", "yG_coupler"))):
            pole = motion.channels[names[0]].values + 1j * motion.channels[names[1]].values
            locus = shown.locus(params.acceleration_ratio)[number]
            np.testing.assert_allclose(locus, pole, rtol=1e-9, atol=1e-6)
    phi = float(shown.way()[7])
    found = shown.circles(phi, 0.3)
    radius = abs(found.inflection[0]) / 2
    away = np.abs(shown.poles_of_all_ratios(phi) - (found.instant_centre + found.inflection / 2)[0])
    np.testing.assert_allclose(away, radius, rtol=1e-6)
    assert page_of("d", "D", shown).count("<svg") == 6
    joints, _ = shown.drawn(phi)
    assert abs(joints["B"] - joints["A"]) == pytest.approx(shown.length)
    assert joints["A"] == pytest.approx(params.crank * np.exp(1j * phi))


def test_the_page_is_written_with_its_pictures(tmp_path):
    design = tmp_path / "design.toml"
    design.write_text('format = 1\nfamily = "slider-crank"\n[parameters]\nacceleration_ratio = 0.2\n')
    done = run("solve", design, "-o", tmp_path / "out", "--samples", "31")
    assert (done.returncode, done.stderr) == (0, "")
    html = (tmp_path / "out" / "poles.html").read_text(encoding="utf-8")
    pictures = re.findall(r"<svg.*?</svg>", html, re.S)
    assert len(pictures) == 6
    for picture in pictures:
        tree = ElementTree.fromstring(picture)  # noqa: S314 - our own
        said = [one.text for one in tree.iter("{http://www.w3.org/2000/svg}text")]
        assert "A" in said
        assert len(list(tree.iter("{http://www.w3.org/2000/svg}path"))) >= 3
    assert "k = 0.2" in html
    assert f">{MARKED[-1]:g}<" in pictures[-1]


def test_a_coupler_that_only_shifts_has_no_page(tmp_path):
    design = tmp_path / "design.toml"
    design.write_text(
        'format = 1\nfamily = "four-bar"\n[parameters]\ncrank = 50\ncoupler = 90\nfollower = 50\nground = 90\n'
    )
    done = run("solve", design, "-o", tmp_path / "out", "--samples", "31")
    assert done.returncode == 0
    assert not (tmp_path / "out" / "poles.html").exists()
