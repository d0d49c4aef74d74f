"""Compares the published construction of offset slider-cranks with the code.

``python docs/seeds/offset_slider_crank.py`` writes the page anew.
"""

import math
from pathlib import Path

from auxiliary_circle import EXAMPLES

from mechwright.errors import KinematicsError
from mechwright_slider_crank.kinematics.limits import crank_turns, least_transmission_angle
from mechwright_slider_crank.kinematics.simulated_stroke import simulated
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank
from mechwright_slider_crank.synthesis.stroke import (
    Lengths,
    best,
    from_crank,
    from_offset,
    from_rod,
    ranges,
    rocking_angle,
)

PAGE = Path(__file__).parent / "offset-slider-crank.md"

STROKE, RATIO = 120.0, 1.5
"""The source's example."""

ANSWERS = (
    ("e = 50", from_offset(STROKE, RATIO, 50.0), (50.0, 115.0, 50.0)),
    ("a = 35", from_crank(STROKE, RATIO, 35.0), (35.0, 160.0, 127.0)),
    ("b = 130", from_rod(STROKE, RATIO, 130.0), (45.0, 130.0, 70.3)),
)
"""What is given, the exact lengths, and the printed a, b, e."""


def degrees(lengths: Lengths) -> float:
    return math.degrees(least_transmission_angle(lengths.crank, lengths.rod, lengths.offset))


def printed_does(triple: tuple[float, float, float]) -> str:
    """What the printed lengths really give."""
    a, b, e = triple
    if not crank_turns(a, b, e):
        return f"**cannot turn**: b - a = {b - a:g} < e = {e:g}"
    try:
        stroke, ratio = simulated(SliderCrank(a, b, e))
    except KinematicsError as error:
        return str(error)
    return f"H = {stroke:.4f}, K = {ratio:.5f}"


def answers() -> list[str]:
    rows = [
        "| given | exact a | exact b | exact e | least μ | simulated H, K | printed a, b, e | printed "
        "lengths give |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for given, exact, printed in ANSWERS:
        stroke, ratio = simulated(SliderCrank(exact.crank, exact.rod, exact.offset))
        rows.append(
            f"| {given} | {exact.crank:.9f} | {exact.rod:.9f} | {exact.offset:.9f} | {degrees(exact):.4f}° | "
            f"{stroke:.9f}, {ratio:.9f} | {', '.join(f'{v:g}' for v in printed)} | {printed_does(printed)} |"
        )
    return rows


def worst_error() -> float:
    """The largest error of a printed length, as a part of the exact one."""
    return max(
        abs(shown / exact - 1)
        for _, lengths, printed in ANSWERS
        for shown, exact in zip(printed, (lengths.crank, lengths.rod, lengths.offset), strict=True)
    )


def trends() -> list[str]:
    """How the lengths change with the offset."""
    most = ranges(STROKE, RATIO).offset[1]
    rows = ["| e | a | b | least μ |", "| --- | --- | --- | --- |"]
    for share in (0.05, 0.2, 0.4, 0.6, 0.8, 0.95):
        found = from_offset(STROKE, RATIO, round(share * most, 3))
        rows.append(f"| {found.offset:.3f} | {found.crank:.4f} | {found.rod:.4f} | {degrees(found):.4f}° |")
    return rows


def limits_over_ratios() -> list[str]:
    """Least crank, largest rod and largest offset of a stroke of 1."""
    rows = ["| K | least a/H | largest b/H | largest e/H |", "| --- | --- | --- | --- |"]
    for ratio in (1.1, 1.2, 1.4, 1.5, 2.0, 2.5, 2.9):
        found = ranges(1.0, ratio)
        rows.append(f"| {ratio:g} | {found.crank[0]:.6f} | {found.rod[1]:.6f} | {found.offset[1]:.6f} |")
    return rows


def page() -> str:
    allowed, top = ranges(STROKE, RATIO), best(STROKE, RATIO)
    theta = math.degrees(rocking_angle(RATIO))
    lines = [
        "# Offset slider-cranks from stroke and time ratio, and the code",
        "",
        "<!-- written by offset_slider_crank.py in this folder; do not edit -->",
        "",
        "The source constructs offset slider-cranks for a stroke H and a time ratio K with auxiliary "
        "circles. One length is given as well: crank a, rod b or offset e. The code solves the same triangle "
        "in closed form; [the family's page](../slider-crank.md) has the equations. Every exact answer "
        "here is simulated: H and K are measured on the motion, from the reversals of the slider's velocity.",
        "",
        f"## The example: H = {STROKE:g} mm, K = {RATIO:g}",
        "",
        *answers(),
        "",
        f"The printed answers, read off a drawing, have errors of up to {100 * worst_error():.1f} %. One of "
        "them cannot turn.",
        "",
        "Figure by figure:",
        "",
        "| figure | shows | ours |",
        "| --- | --- | --- |",
        "| 1 | the circle over the stroke and its triangle | ![circle](../images/circle-1-stroke.svg) |",
        *(
            f"| {one.figure} | [{one.given}](offset-slider-crank-{one.name}.md), step by step | "
            f"![{one.given}](../images/circle-{one.name}.svg) |"
            for one in EXAMPLES
        ),
        "",
        "## Where solutions exist",
        "",
        f"For this example θ = {theta:g}°. The crank lies between {allowed.crank[0]:.6f} and "
        f"{allowed.crank[1]:g} mm, the rod between {allowed.rod[0]:g} and {allowed.rod[1]:.6f} mm, the "
        f"offset between 0 and {allowed.offset[1]:.6f} mm. At the largest offset the crank only just turns: "
        "b = a + e. In general 1 < K < 3; at K = 3 (θ = 90°) the ranges are empty.",
        "",
        f"With none of the three given, e = {top.offset:.9f} mm has the largest least transmission angle, "
        f"{degrees(top):.6f}° (a = {top.crank:.6f}, b = {top.rod:.6f} mm).",
        "",
        *trends(),
        "",
        "Over the place of A on its arc from C1 to C1′, the three answers marked:",
        "",
        "![Crank, rod and offset over the place of A](../images/circle-family.svg)",
        "",
        "The limits over K, parts of the stroke:",
        "",
        *limits_over_ratios(),
        "",
        "## Claims",
        "",
        "| claim | verdict |",
        "| --- | --- |",
        "| L_AF = b / cos(θ/2), from which the construction follows | true; the printed B is b |",
        "| the crank is shorter than H/2 | true, but incomplete: a is at least (H/2) tan(θ/2), and b and e "
        "have bounds too |",
        "| with A on the circle, e and a grow together, b the other way | **false**: da/de = -(H/4) "
        "tan(θ/2)/a is below 0 and db/de = (H/4) cot(θ/2)/b above. e and b grow together, a the other way, "
        "as the table and the source's own answers show |",
        f"| the accuracy of the drawing is enough for engineering | not here: errors of up to "
        f"{100 * worst_error():.1f} %, "
        "and one answer that cannot turn |",
        "",
        "## Errata of the source",
        "",
        "1. Equation (3) is θ = 180° (K - 1)/(K + 1); the print has lost its signs.",
        "2. Equation (2): the numerator B is the rod's length b. The introduction's a, b, c are a, b, e.",
        "3. Section 5 refers to all steps of section 4. Only the first, which finds F, can be meant, since a "
        "is not known yet. Its third step must read L_AB = a, not half of it.",
        "4. F is the middle of the smaller arc over the stroke. The other one gives a point A whose "
        "angle is 180° - θ.",
        "5. The two intersections of line and circle are mirror images: the same lengths, with the quick "
        "return reversed. The code gives both.",
        "",
    ]
    return "\n".join(lines)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
