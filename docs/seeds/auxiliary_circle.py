"""The worked examples of the source on offset slider-cranks, a page and its pictures for each.

``python docs/seeds/auxiliary_circle.py`` writes them anew.
"""

import math
from dataclasses import dataclass
from pathlib import Path

from mechwright.pipeline.figures import Grid
from mechwright_slider_crank.kinematics.limits import crank_turns
from mechwright_slider_crank.kinematics.simulated_stroke import simulated
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank
from mechwright_slider_crank.pages import construction_pictures as pictures
from mechwright_slider_crank.pages.circle import AuxiliaryCircle, Found
from mechwright_slider_crank.pages.construction import numbers, solutions
from mechwright_slider_crank.synthesis.stroke import Lengths, from_crank, from_offset, from_rod

HERE = Path(__file__).parent
IMAGES = HERE.parent / "images"
CIRCLE = AuxiliaryCircle(120.0, 1.5)


@dataclass(frozen=True)
class Example:
    """A worked example: its name, the figure of the source, what is given, and what the source reads off."""

    name: str
    figure: str
    given: str
    found: Found
    exact: Lengths
    printed: tuple[float, float, float]
    section: str
    steps: tuple[str, ...]


EXAMPLES = (
    Example(
        "offset-50",
        "2",
        "offset e = 50 mm",
        CIRCLE.by_offset(50),
        from_offset(120, 1.5, 50),
        (50, 115, 50),
        "3",
        (
            "the line MN parallel to C1C2 at 50 mm meets the circle in A",
            "AC1 is laid off on AC2 from A and gives E; half of EC2 is a",
            "G, the foot of F on AC2, is the middle of EC2; AG is b",
            "C1A is prolonged beyond A by a, to B",
        ),
    ),
    Example(
        "crank-35",
        "3",
        "crank a = 35 mm",
        CIRCLE.by_crank(35),
        from_crank(120, 1.5, 35),
        (35, 160, 127),
        "4",
        (
            "F is where the perpendicular from O to C1C2 meets the smaller arc",
            "circle I about F through C2 and circle II about C2 with 2 a = 70 mm meet in E",
            "C2E prolonged meets the circle in A; the height of A is e",
            "G, the foot of F on C2A, gives AG = b; C1A is prolonged beyond A by a, to B",
        ),
    ),
    Example(
        "rod-130",
        "4",
        "rod b = 130 mm",
        CIRCLE.by_rod(130),
        from_rod(120, 1.5, 130),
        (45, 130, 70.3),
        "5",
        (
            "F as before",
            "circle III about F with b/cos(θ/2) = 136.690089 mm meets the circle in A; the height of A is e",
            "AC1 is laid off on AC2 from A and gives E; half of EC2 is a",
            "C1A is prolonged beyond A by a, to B; the source has half of AB there, a misprint",
        ),
    ),
)


def drawn() -> dict[str, str]:
    """Picture to its content."""
    make = {"offset-50": pictures.by_offset, "crank-35": pictures.by_crank, "rod-130": pictures.by_rod}
    found = {
        "circle-1-stroke": pictures.base(CIRCLE).picture("the auxiliary circle"),
        "circle-family": pictures.family(CIRCLE, [one.found for one in EXAMPLES]),
    }
    for one in EXAMPLES:
        found[f"circle-{one.name}"] = make[one.name](CIRCLE, one.found)
        found[f"circle-{one.name}-mechanism"] = pictures.mechanism(CIRCLE, one.found)
    return {f"{name}.svg": content + "\n" for name, content in found.items()}


def table(grid: Grid) -> list[str]:
    """A table in Markdown."""
    rows = [grid.head, ["---"] * len(grid.head), *grid.rows]
    return [f"{grid.caption}:", "", *(f"| {' | '.join(row)} |" for row in rows), ""]


def slips(found: Found) -> str:
    """What a millimetre of A along the circle does to a, b and e: half of the slope over λ, over R."""
    step = 1e-6
    more, less = CIRCLE.at(found.position + step), CIRCLE.at(found.position - step)
    slopes = [
        (getattr(more, name) - getattr(less, name)) / (4 * step * CIRCLE.radius)
        for name in ("crank", "rod", "offset")
    ]
    return ", ".join(f"{slope:.3f}" for slope in slopes)


def beside(one: Example) -> list[str]:
    """Lengths by the construction, in closed form, as printed, and what they do."""
    rows = ["| lengths | a | b | e | H and K of the motion |", "| --- | --- | --- | --- | --- |"]
    found, exact = one.found, one.exact
    for name, (a, b, e) in (
        ("constructed", (found.crank, found.rod, found.offset)),
        ("closed form", (exact.crank, exact.rod, exact.offset)),
        ("printed, read off", one.printed),
    ):
        if crank_turns(a, b, e):
            stroke, ratio = simulated(SliderCrank(a, b, e))
            does = f"{stroke:.6f}, {ratio:.6f}"
        else:
            does = f"none: the crank cannot turn, b − a = {b - a:g} < e = {e:g}"
        rows.append(f"| {name} | {a:.9g} | {b:.9g} | {e:.9g} | {does} |")
    return rows


def page(one: Example) -> str:
    """The page of an example."""
    title = one.given[0].upper() + one.given[1:]
    lines = [
        f"# {title}, H = 120 mm, K = 1.5: the construction",
        "",
        "<!-- written by auxiliary_circle.py in this folder; do not edit -->",
        "",
        f"Section {one.section} of [the source](offset-slider-crank.md), its figure {one.figure}, drawn to "
        f"scale; "
        f"θ = 36°.",
        "",
        "## The circle, figure 1",
        "",
        "![The auxiliary circle](../images/circle-1-stroke.svg)",
        "",
        "1. C1C2 = 120 mm.",
        "2. O over C1C2 with base angles of 54°; the circle about O through C1, R = 102.078097 mm.",
        "",
        f"## The third condition, figure {one.figure}",
        "",
        f"![{title}](../images/circle-{one.name}.svg)",
        "",
        *(f"{number}. {step[0].upper()}{step[1:]}." for number, step in enumerate(one.steps, start=3)),
        "",
        f"![Both limits](../images/circle-{one.name}-mechanism.svg)",
        "",
        *table(numbers(CIRCLE, one.found)),
        "## Result",
        "",
        *beside(one),
        "",
        f"λ, the angle of AC2 to the stroke, is {math.degrees(one.found.position):.9f}°. An error of 1 mm in "
        f"A along the circle changes a, b and e by {slips(one.found)} mm. The printed lengths have larger "
        "errors than the width of a pencil's line.",
        "",
        *table(solutions(CIRCLE, one.found)),
    ]
    return "\n".join(lines)


def pages() -> dict[Path, str]:
    """File to content: the pages."""
    return {HERE / f"offset-slider-crank-{one.name}.md": page(one) for one in EXAMPLES}


def write() -> None:
    """Write pages and pictures anew."""
    for path, content in pages().items():
        path.write_text(content, encoding="utf-8")
    for name, content in drawn().items():
        (IMAGES / name).write_text(content, encoding="utf-8")


if __name__ == "__main__":
    write()
