"""Pairs from their STEP files, all examples of any law among them: the exact motion to 5 µrad."""

import sys
from pathlib import Path

import numpy as np
import pytest
import shapely
from by_night import NIGHT, by_night
from step_read import read_step_outline

from mechwright import host
from mechwright.designs.design import load
from mechwright.mechanics.chain import ChainParams
from mechwright_cad.exporters import StepExporter
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear_parts import parts_of as elliptic_parts
from mechwright_elliptic_gears.parts.mesh_proof import prove_outlines as prove_elliptic
from mechwright_noncircular_gears.parts.parts import parts_of
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.table import table_of

sys.path.append(str(Path(__file__).parents[1] / "plugins"))
from noncircular import TABLES

SECTORS = {
    "spiral": {"law": "spiral", "sector": 120, "teeth": 20},
    "wave": {"law": "ratio", "ratio": "1+0.3*sin(phi)", "sector": 200, "teeth": 30, "tooth_offset": 0.3},
}
SOUND = ("D1", "D2", "D3", "D4", "D5", "D6", "D7", "D8", "SL", *SECTORS)

CHORDS = 2.5e-5
"""Chord error, mm: coarser chords turn the gears by microradians of their own."""


EXAMPLES = Path(__file__).parents[2] / "examples"
FILES = sorted(
    one
    for one in (*EXAMPLES.glob("noncircular-*.toml"), *EXAMPLES.glob("chains/*.toml"))
    if not one.stem.endswith(("-requirement", "-study"))
)


def pairs():
    """Each pair of the reference, of sectors, and of the examples, those in chains as well."""
    for name in SOUND:
        yield name, SizedParams.model_validate({"bore": 8, **{**TABLES, **SECTORS}[name]})
    for path in FILES:
        params = load(path, host()).params
        stages = [one.parameters for one in params.stage] if isinstance(params, ChainParams) else [params]
        for number, one in enumerate(stages, start=1):
            if isinstance(one, SizedParams):
                yield f"{path.stem}-{number}", one


PAIRS = dict(pairs()) if NIGHT else {}


@by_night
@pytest.mark.parametrize("name", PAIRS)
def test_transmission_error_of_the_file(name):
    params = PAIRS[name]
    one, two = (
        read_step_outline(StepExporter().part(part), CHORDS)[0] for part in parts_of(table_of(params))
    )
    wall = (
        max(two.interiors, key=lambda hole: shapely.Polygon(hole).area) if params.internal else two.exterior
    )
    outlines = [np.asarray(ring.coords)[:-1] for ring in (one.exterior, wall)]
    proof = table_of(params).prove_outlines(*outlines, 1e-3)
    assert not proof.collides
    assert proof.error < 5e-6, proof.error


@by_night
@pytest.mark.parametrize(
    ("e", "teeth", "distance"), [(0.3, 33, 80), (0.1, 41, 80), (0.3, 25, 100), (0.2, 19, 30)]
)
def test_transmission_error_of_elliptic_pairs(e, teeth, distance):
    params = EllipticGearParams(eccentricity=e, teeth=teeth, semi_major=distance / 2, bore=4.0)
    gear = read_step_outline(StepExporter().part(elliptic_parts(params)[0]), CHORDS)[0]
    proof = prove_elliptic(params, np.asarray(gear.exterior.coords)[:-1], 1e-3)
    assert proof.error < 5e-6, proof.error
