"""A drawing of one part as SVG, for notebooks: a plate from above, a solid as the CAD kernel projects it."""

from mechwright.contracts.part import Part, Pocket
from mechwright.geometry import Outline
from mechwright.output import svg

MARGIN = 0.08
"""Of the greater side, around the plate."""
HIDDEN = 1 / 2000
"""Of the greater side: how far curves may be off, well below the width of a line on a screen."""
CHARACTER = 0.6
"""Width of a letter in heights, on the wide side."""
WIDTH = "24em"


def part_picture(part: Part) -> str:
    """A plate with its recesses and its size, or another part's edges; the latter imports the CAD kernel."""
    return _projected(part) if part.outline is None else _plate(part, part.outline)


def _plate(part: Part, outline: Outline) -> str:
    x0, y0, x1, y1 = outline.bounds
    size = max(x1 - x0, y1 - y0)
    margin, hidden = MARGIN * size, HIDDEN * size
    wide = max(x1 - x0, 0.8 * size)
    look = {"stroke": "#1d3557", "stroke_width": svg.number(size / 300)}
    rim = "".join(svg.path(loop.flatten(hidden), close=True) for loop in outline.loops)
    drawn = [svg.element("path", d=rim, fill="#dbe4ec", fill_rule="evenodd", **look)]
    for feature in part.features:
        if isinstance(feature, Pocket):
            loops = (feature.boundary, *feature.islands)
            data = "".join(svg.path(loop.flatten(hidden), close=True) for loop in loops)
            drawn.append(svg.element("path", d=data, fill="#b9c8d6", fill_rule="evenodd", **look))
    words = f"{part.name}: {x1 - x0:.4g} × {y1 - y0:.4g} × {part.thickness:.4g} mm, {part.material}"
    letter = min(0.045 * size, wide / (CHARACTER * len(words)))
    drawn.append(svg.text(x0, y0 - margin / 2 - letter, words, letter, fill="#333"))
    box = (x0 - margin, -y1 - margin, wide + 2 * margin, y1 - y0 + 2 * margin + 2 * letter)
    return _sized(svg.picture("".join(drawn), box, words))


def _projected(part: Part) -> str:
    from cadquery.occ_impl.exporters.svg import getSVG

    from mechwright_cad.solids.solid import part_solid

    options = {
        "width": 400,
        "height": 300,
        "showHidden": False,
        "marginLeft": 20,
        "marginTop": 20,
        "showAxes": False,
    }
    drawn: str = getSVG(part_solid(part), options)  # type: ignore[no-untyped-call]
    return drawn[drawn.index("<svg") :]


def _sized(picture: str) -> str:
    return picture.replace("<svg ", f'<svg style="width:{WIDTH};max-width:100%" ', 1)
