"""Drawings that Mechwright has written, read back to the same parts: every plate of every example."""

from pathlib import Path

import pytest
import shapely
from by_night import by_night

import mechwright as mw
from mechwright.contracts.details import Chamfer, Engraving, Thread
from mechwright.contracts.sections import Section, sections
from mechwright.drawings.asked import Asked
from mechwright.drawings.plate import Cut, part_of
from mechwright.drawings.reading import read
from mechwright_cad.exporters import DxfExporter

EXAMPLES = Path(__file__).parents[2] / "examples"
DAY = {"crank-rocker-finished", "nema-17-plate"}
SKIPPED = ("-requirement", "-study")
DESIGNS = [
    pytest.param(path, marks=() if path.stem in DAY else by_night, id=path.stem)
    for path in sorted(EXAMPLES.glob("*.toml"))
    if not path.stem.endswith(SKIPPED)
]
WITHIN = 2e-3
"""mm. Mean distance of the walls: chords of half a micrometre each, and arcs for what was round."""


@pytest.mark.parametrize("path", DESIGNS)
def test_a_drawing_reads_back_to_the_same_part(path):
    plates = [part for part in mw.load(path).parts if part.outline is not None]
    assert plates
    for part in plates:
        drawn = read(DxfExporter("spline").part(part), Asked())
        back = part_of(drawn, Asked(), Cut(part.name, part.thickness, part.material))
        assert drawn.told.faults == [], part.name
        assert off(part, back) <= WITHIN, part.name
        assert sizes(part) == sizes(back), part.name
        assert fits(part) == fits(back), part.name


def off(one, two):
    """Mean distance of the walls of two parts, mm, at the depth where it is greatest."""
    layers, others = sections(one, steps=0), sections(two, steps=0)
    depths = sorted({layer.top for layer in (*layers, *others)})
    return max(
        shapely.symmetric_difference(at(layers, depth), at(others, depth)).area / at(layers, depth).length
        for depth in depths
    )


def at(layers: tuple[Section, ...], depth: float) -> shapely.Geometry:
    return next(layer.shape for layer in layers if layer.top <= depth + 1e-9 < layer.bottom)


def sizes(part):
    found = []
    for detail in part.details:
        match detail:
            case Chamfer():
                found.append(("chamfer", detail.side, round(detail.width, 4)))
            case Thread():
                found.append(
                    (detail.designation, round(detail.depth, 4), *(round(v, 4) for v in detail.centre))
                )
            case Engraving():
                found.append(("engraved", round(detail.depth, 4), round(detail.width, 4)))
    return sorted(set(found), key=repr)


def fits(part):
    bores = [feature for feature in part.features if getattr(feature, "fit", None)]
    return sorted((bore.fit.text, round(bore.top, 6), round(bore.depth, 6)) for bore in bores)
