"""The figures of the source on acceleration poles, drawn by the code, and what stands beside them."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import six_bar_poles
from signed_distances import SignedDistances, of_four_bar, of_slider_crank

from mechwright.pipeline.figures.sheet import INK, Window, linkage
from mechwright.pipeline.poles import NAME, Coupler, planes
from mechwright_four_bar.kinematics.reach import bar_of
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.poles_page import FourBarPoles
from mechwright_slider_crank.pages.poles import SliderCrankPoles
from mechwright_slider_crank.parameters import SliderCrankParams

IMAGES = Path(__file__).parents[1] / "images"

FOUR = FourBarParams(crank=40, coupler=120, follower=80, ground=100)
SLIDER = SliderCrankParams(crank=50, rod=150, offset=20)
ALIGNED = SliderCrankParams(crank=50, rod=75, offset=25)
TWO_POLES = SliderCrankParams(crank=30.96199786318436, rod=51.20936077066423, offset=13.106814419352881)
ROCKER = FourBarParams(
    crank=23.5785086,
    coupler=68.7641778,
    follower=71.859653,
    ground=61.9700602,
    ground_angle=29.7376,
)
"""The crank-rocker through three poles of the page, twentyfold."""


def model(coupler: Coupler, found: SignedDistances, phi: float, lines: list[list[complex]]) -> str:
    """The linkage with P, Q and G, the line of the crank with g and h on it, and other lines."""
    p, q = complex(found.instant_centre.flat[0]), complex(found.relative_centre.flat[0])
    g = coupler.pole(phi, 0.0)
    joints, links = coupler.drawn(phi)
    window = Window.about([*joints.values(), p, q, g], 0.06)
    dashed = {"stroke_dasharray": window.dashes()}
    drawn = [window.line(np.array(line), "#1f5fa8", 0.9, **dashed) for line in [[0j, p], [q, p], *lines]]
    drawn += linkage(window, joints, links)
    drawn += [window.dot(place, INK, name) for name, place in (("P", p), ("Q", q))]
    drawn.append(window.dot(g, "#b3261e", "G", 1.3))
    said = [
        (f"g = {float(found.g.flat[0]):.3f} mm", INK),
        (f"h = {float(found.h.flat[0]):.3f} mm", INK),
        (f"cot δ = {float(found.cot_delta.flat[0]):.4f}", INK),
    ]
    return window.picture([*drawn, window.scale(), window.key(said)], "the linkage with P, Q and its pole")


def slider(params: SliderCrankParams) -> Coupler:
    return SliderCrankPoles().couplers(params)[NAME]


def four_bar(params: FourBarParams) -> Coupler:
    return FourBarPoles().couplers(params)[NAME]


def first() -> str:
    phi = math.radians(120)
    coupler = four_bar(FOUR)
    joints, _ = coupler.drawn(phi)
    found = of_four_bar(bar_of(FOUR), phi)
    p, q = complex(found.instant_centre.flat[0]), complex(found.relative_centre.flat[0])
    return model(coupler, found, phi, [[joints["B"], p], [joints["A0"], q], [joints["A"], q]])


def second() -> str:
    phi = math.radians(150)
    coupler = slider(SLIDER)
    joints, _ = coupler.drawn(phi)
    found = of_slider_crank(SLIDER.linkage, phi)
    p, q = complex(found.instant_centre.flat[0]), complex(found.relative_centre.flat[0])
    return model(coupler, found, phi, [[joints["B"], p], [joints["A0"], q], [joints["A"], q]])


def two_poles() -> str:
    marks = {"G1": 60 - 12.6j, "G2": 41.2 + 41.6j}
    return planes.ground(slider(TWO_POLES), (0.0,), math.radians(59.5657), marks)


def three_poles() -> str:
    marks = {"G1": 46.8 + 81.8j, "G2": -10.6 + 117.2j, "G3": 59.6 + 116.6j}
    return planes.ground(four_bar(ROCKER), (0.0,), math.radians(135.756), marks)


RATIOS = (0.0, 0.5, -0.5, 2.0)

DRAWN: dict[str, Callable[[], str]] = {
    "poles-1-four-bar": first,
    "poles-2-slider-crank": second,
    "poles-6-locus": lambda: planes.ground(slider(SLIDER), (0.0,), 1.0),
    "poles-6-locus-coupler": lambda: planes.moving(slider(SLIDER), (0.0,)),
    "poles-8-locus": lambda: planes.ground(slider(ALIGNED), (0.0,), 1.0),
    "poles-8-locus-coupler": lambda: planes.moving(slider(ALIGNED), (0.0,)),
    "poles-four-bar-locus": lambda: planes.ground(four_bar(FOUR), (0.0,), 2.0),
    "poles-four-bar-locus-coupler": lambda: planes.moving(four_bar(FOUR), (0.0,)),
    "poles-11-two-poles": two_poles,
    "poles-12-three-poles": three_poles,
    "poles-accelerating-slider-crank": lambda: planes.ground(slider(SLIDER), RATIOS, 1.0),
    "poles-accelerating-slider-crank-coupler": lambda: planes.moving(slider(SLIDER), RATIOS),
    "poles-accelerating-four-bar": lambda: planes.ground(four_bar(FOUR), RATIOS, 2.0),
    "poles-accelerating-four-bar-coupler": lambda: planes.moving(four_bar(FOUR), RATIOS),
    "poles-circles-slider-crank": lambda: planes.position(slider(SLIDER), 0.5, math.radians(150)),
    "poles-circles-four-bar": lambda: planes.position(four_bar(FOUR), 0.5, math.radians(240)),
    "poles-six-bar-stephenson": lambda: six_bar_poles.picture("Stephenson"),
    "poles-six-bar-watt": lambda: six_bar_poles.picture("Watt"),
}
"""Picture to what draws it."""

BESIDE = (
    ("1", "four-bar with P, Q, g, h, δ and G", "poles-1-four-bar", "40, 120, 80, 100 mm, crank at 120°"),
    ("2", "slider-crank with the same", "poles-2-slider-crank", "50, 150, e = 20 mm, crank at 150°"),
    ("3 to 5", "lost with their pages", "", "nothing in the text refers to them"),
    ("6", "slider-crank, both branches, on the ground: symmetric about Y", "poles-6-locus", "the same "
     "linkage, other assembly dashed; lengths of the source are lost"),
    ("(9, 10 lost)", "in the coupler: symmetric about x", "poles-6-locus-coupler", "our drawing of the "
     "statement under (18)"),
    ("7, 8", "slider-crank with c = a + e, and its locus", "poles-8-locus", "50, 75, e = 25 mm: one circuit "
     "through both assemblies"),
    ("", "in the coupler", "poles-8-locus-coupler", "not in the source"),
    ("", "four-bar: left to later work", "poles-four-bar-locus", "40, 120, 80, 100 mm on the ground"),
    ("", "", "poles-four-bar-locus-coupler", "and in the coupler"),
    ("11, Tables 2, 3", "slider-crank through two poles", "poles-11-two-poles", "poles (60, −12.6) and "
     "(41.2, 41.6), 47° apart; the tables' numbers are lost"),
    ("12, Tables 4, 5", "crank-rocker through two poles, ground angle given", "poles-12-three-poles",
     "through three poles, (46.8, 81.8), (−10.6, 117.2), (59.6, 116.6)"),
    ("Table 1", "degrees and circular points", "", "both tables of loci below"),
)  # fmt: skip
"""Figure, what it shows, our picture, and what is in it."""


def figures() -> list[str]:
    """The part of the page that goes through the figures."""
    rows = ["## Figures, one by one", "", "| figure | shows | ours | of |", "| --- | --- | --- | --- |"]
    for number, shows, name, of in BESIDE:
        ours = f"![{name.replace('-', ' ')}](../images/{name}.svg)" if name else "none"
        rows.append(f"| {number} | {shows} | {ours} | {of} |")
    return [*rows, ""]


def draw() -> None:
    """Write the pictures anew."""
    for name, make in DRAWN.items():
        (IMAGES / f"{name}.svg").write_text(make() + "\n", encoding="utf-8")
