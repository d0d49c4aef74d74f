"""Designs that are not milled: proven and assembled as made, without a warning."""

from pathlib import Path

import pytest
from by_night import by_night

from mechwright.contracts.finding import Severity, Stage
from mechwright.pipeline import PROGRAMS, Build, Run, Wanted, Work
from mechwright.pipeline.as_made import as_made, produced_plates
from mechwright.pipeline.page import pages_of
from mechwright.plugins.host import host

EXAMPLES = Path(__file__).parents[2] / "examples" / "processes"
WORK = Work(Stage.OUTPUT, frozenset({PROGRAMS}))
FILES = {
    "geneva-laser": {"laser-acrylic-3.nc", "laser-acrylic-4.nc", "cut.html", "cut-proof.json"},
    "elliptic-pair-wire": {"wire-steel-10.iso", "cut.html", "cut-proof.json"},
    "slider-crank-service": {
        *(f"{name}-cut.dxf" for name in ("base", "rail", "crank", "rod", "slider")),
        "cut.html",
    },
}
JUDGED = {"geneva-laser": 6, "elliptic-pair-wire": 5, "slider-crank-service": 3}
"""Figures as made; those of a service's plates are of their drawings."""


def test_every_example_is_tried():
    assert {path.stem for path in EXAMPLES.glob("*.toml")} == FILES.keys()


@pytest.mark.parametrize(
    "name", ["geneva-laser", pytest.param("elliptic-pair-wire", marks=by_night), "slider-crank-service"]
)
def test_an_example_is_proven_and_runs_as_made(name):
    with Build(EXAMPLES / f"{name}.toml", host(), Wanted("cut", work=WORK)) as build:
        run = Run(build, WORK)
        files = run.make(pages_of(build.host, "cut"))
        assert set(files.files) == FILES[name]
        assert [one for one in run.findings if one.severity is not Severity.NOTE] == []
        assert len(build.made(as_made).figures) == JUDGED[name]
        plates = build.made(produced_plates)
        assert plates
        assert all(abs(part.off).max() < 0.005 for parts in plates.values() for part in parts)
