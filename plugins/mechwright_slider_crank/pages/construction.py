"""The page ``construction.html``: how a slider-crank follows from its stroke and time ratio on paper."""

import math
from collections.abc import Mapping

from mechwright.pipeline import Build, FileName, Page, Wanted
from mechwright.pipeline.figures import Figure, Grid, figures_page
from mechwright_slider_crank.pages.circle import AuxiliaryCircle, Found
from mechwright_slider_crank.parameters import SliderCrankParams

NAME = "construction.html"
"""The file."""

SHARES = (0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 1.0)
"""Places of A in the table, as parts of its arc."""


class ConstructionPage(Page):
    """``construction.html``: the construction with the auxiliary circle, for the three given lengths."""

    name = "slider-crank-construction"
    commands = frozenset({"solve", "build"})
    doing = "construction"

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """The page."""
        return (
            [FileName(NAME, "the construction")] if isinstance(build.design.params, SliderCrankParams) else []
        )

    def files(self, build: Build) -> Mapping[str, str]:
        """The page; none of other families, of levers, and without an offset, where there is no circle."""
        params = build.design.params
        given = constructed(params) if isinstance(params, SliderCrankParams) else None
        return {} if given is None else {NAME: page(build.design.name, *given)}


def constructed(params: SliderCrankParams) -> tuple[AuxiliaryCircle, Found] | None:
    """The circle of a design's stroke and time ratio, and the design on it; None where there is none."""
    from mechwright_slider_crank.kinematics.limits import crank_turns, limits

    linkage = params.linkage
    if not crank_turns(params.crank, params.rod, params.offset) or linkage.at_limit:
        return None
    found = limits(linkage)
    if abs(found.time_ratio - 1) < LEAST:
        return None
    circle = AuxiliaryCircle(found.stroke, found.time_ratio)
    return circle, circle.by_offset(abs(params.offset))


LEAST = 1e-6
"""Time ratios nearer to 1 have a circle of a thousand strokes and more: nobody draws it."""


def page(name: str, circle: AuxiliaryCircle, found: Found) -> str:
    """The page of a solution on its circle."""
    return figures_page(
        name, "Slider-crank: construction with the auxiliary circle", notes(circle), steps(circle, found),
        [numbers(circle, found), solutions(circle, found)],
    )  # fmt: skip


def notes(circle: AuxiliaryCircle) -> list[str]:
    """What the page shows, and within which limits there is a solution."""
    half, turn = circle.stroke / 2, math.tan(circle.theta / 2)
    return [
        f"Stroke H = {circle.stroke:.6g} mm, time ratio K = {circle.time_ratio:.6g}: θ = 180° (K − 1)/(K + "
        f"1) = "
        f"{math.degrees(circle.theta):.6g}°. A is drawn over the stroke; the mirror images, A on the right "
        f"arc or "
        "below the stroke, have the same lengths, with the quick return or the sense the other way.",
        f"There is a solution for 0 < e ≤ {circle.opposite[0].imag:.6g}, {half * turn:.6g} ≤ a < {half:.6g}, "
        f"{half:.6g} < b ≤ {half / turn:.6g} mm; at the ends in C1′ b = a + e, and the crank only just "
        f"turns.",
    ]


def steps(circle: AuxiliaryCircle, found: Found) -> list[Figure]:
    """The figures in their order."""
    from mechwright_slider_crank.pages import construction_pictures as pictures

    theta = math.degrees(circle.theta)
    return [
        Figure(
            "1. The circle of the stroke",
            pictures.base(circle).picture("the auxiliary circle"),
            f"C1C2 = H = {circle.stroke:.6g} mm. O over it with base angles of 90° − θ = {90 - theta:.6g}°; "
            f"the circle "
            f"about O through C1, radius {circle.radius:.6g} mm. F is the middle of the smaller arc; C1′ "
            f"and C2′ are "
            "opposite to C2 and C1. From A on the green arcs the stroke is seen at θ.",
        ),
        Figure(
            f"2. With the offset, e = {found.offset:.6g} mm",
            pictures.by_offset(circle, found),
            "The parallel MN to C1C2 at e meets the arc in A. AC1 laid off on AC2 gives E.",
        ),
        Figure(
            f"3. Or with the crank, a = {found.crank:.6g} mm",
            pictures.by_crank(circle, found),
            "Circle I about F through C2 and circle II about C2 with 2 a meet in E; C2E prolonged leads to "
            "A.",
        ),
        Figure(
            f"4. Or with the rod, b = {found.rod:.6g} mm",
            pictures.by_rod(circle, found),
            "Circle III about F with b/cos(θ/2) meets the arc in A. E and G follow on AC2.",
        ),
        Figure(
            "5. Lengths and limits",
            pictures.mechanism(circle, found),
            "G, the foot of F on AC2, halves EC2: C2G = GE = a, AG = b. C1A prolonged by a beyond A leads "
            "to B, the "
            "crank pin with the slider in C1; the other limit has the pin on AC2.",
        ),
        Figure(
            "6. All solutions",
            pictures.family(circle, [found]),
            "Crank, rod and offset as A goes from C1 to C1′, over λ, the angle of AC2 to the stroke: a "
            "falls, b and e "
            "rise. The dots are this design.",
        ),
    ]


def numbers(circle: AuxiliaryCircle, found: Found) -> Grid:
    """The places of the construction."""
    places = {
        "O": circle.centre,
        "F": circle.middle,
        "C1′": circle.opposite[0],
        "C2′": circle.opposite[1],
        "A": found.pivot,
        "E": found.divide,
        "G": found.foot,
        "B (slider in C1)": found.pin,
    }
    rows = [[name, _mm(place.real), _mm(place.imag)] for name, place in places.items()]
    return Grid("Places, mm, C1 in the origin and C2 on x", ["point", "x", "y"], rows)


def solutions(circle: AuxiliaryCircle, found: Found) -> Grid:
    """The family of solutions over λ, this one among them."""
    some = [circle.at(share * circle.last) for share in SHARES]
    rows = []
    for one in sorted([*some, found], key=lambda one: one.position):
        least = math.degrees(math.acos(min(1.0, (one.crank + one.offset) / one.rod)))
        mark = " (this)" if one is found else ""
        cells = (one.crank, one.rod, one.offset)
        rows.append([f"{math.degrees(one.position):.4f}°{mark}", *map(_mm, cells), f"{least:.3f}°"])
    return Grid("Solutions over the place of A, mm", ["λ", "a", "b", "e", "least transmission angle"], rows)


def _mm(value: float) -> str:
    return f"{value:.6f}".replace("-", "−")
