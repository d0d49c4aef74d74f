"""Non-circular pairs beside ncgears, on the same designs and in one run: processor time and errors.

The other program makes pairs of a law or a pitch curve as well, by sweeping its rack. It is no dependency;
where it is not installed that is said. Of both are told: processor time from the law to two outlines; the
centre distance against that of 30 digits; and how far flanks of the driver are off the closed form of the
flank, which shares no line with its sweep.

Run:  python benchmarks/bench_ncgears.py [D1 D3 ...]

After pip install --target FOLDER ncgears, with FOLDER on PYTHONPATH.
"""

import json
import math
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import shapely

from mechwright.mechanics.gearing import SIDES, mesh
from mechwright.mechanics.gearing.made import signed_depth
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.table import table_of

DATA = Path(__file__).parents[1] / "tests" / "data" / "noncircular-gears.json"
FINE = 2e-5
"""Chord error of outlines that are compared, mm."""
BAND = 0.5
"""Modules on both sides of the pitch curve within which only flanks are."""
PROFILE = {"bore": 0, "backlash": 0.0}

DESIGNS = {
    "D1": ({"law": "angle", "angle": "phi + 0.3*sin(phi)", "teeth": 40}, "phi + 0.3*sin(phi)", None),
    "D3": (
        {"law": "ellipse", "mate_lobes": 2, "eccentricity": 0.3, "teeth": 30},
        "1/(1 - 0.3*cos(phi))",
        0.5,
    ),
    "D6": (
        {"law": "eccentric-circle", "eccentricity": 0.25, "teeth": 40},
        "0.25*cos(phi) + sqrt(1 - 0.0625*sin(phi)**2)",
        1.0,
    ),
}
"""Design of the reference to its table, the other program's expression, and its ratio of a pitch curve."""


def ours(table: dict[str, object]) -> tuple[float, tuple[np.ndarray, np.ndarray]]:
    """Centre distance and both outlines."""
    params = SizedParams.model_validate({**PROFILE, **table})
    one, two = table_of(params).outlines
    return table_of(params).pair.distance, (one.outer.flatten(FINE), two.outer.flatten(FINE))


def theirs(expression: str, ratio: float | None, teeth: int) -> tuple[float, tuple[np.ndarray, np.ndarray]]:
    """The same of the other program."""
    import ncgears

    with tempfile.TemporaryDirectory() as folder:
        if ratio is None:
            pair = ncgears.generate(expression, teeth=teeth, module=2.0, output_directory=folder)
        else:
            pair = ncgears.generate_from_centrode(
                expression,
                target_cycle_delta=ratio * math.tau,
                teeth=teeth,
                module=2.0,
                output_directory=folder,
            )
        return pair.center_distance, (np.array(pair.drive_outline), np.array(pair.driven_outline))


def flank_error(params: SizedParams, outline: np.ndarray) -> float:
    """Greatest distance, mm, of points of a driver near its pitch curve from the closed form of the flanks.

    The other program may count its angles the other way round: the nearer of both.
    """
    teeth = table_of(params).teeth[0]
    start, t = teeth.flank_arcs[..., None], np.linspace(0.0, 1.0, 400)
    tip = teeth.curve.arc(teeth.tip_trim[0])[..., None]
    frame = teeth.curve.frame_at(teeth.join_arcs[..., None] * (1 - t) + tip * t)
    flanks = teeth.rack.flank(frame, start, SIDES[:, None]).reshape(-1, t.size, 2)
    chords = np.stack((flanks[:, :-1], flanks[:, 1:]), axis=2).reshape(-1, 2, 2)
    tree = shapely.STRtree(shapely.linestrings(chords))
    pitch, best = teeth.curve.frame(np.linspace(0, math.tau, 4001)).point[:-1], math.inf
    for points in (outline, outline * (1.0, -1.0)):
        near = points[np.abs(signed_depth(pitch, points)) < BAND * teeth.rack.module]
        _, off = tree.query_nearest(shapely.points(near), return_distance=True, all_matches=False)
        best = min(best, float(off.max()))
    return best


def main(names: list[str]) -> None:
    """All designs, one after the other."""
    facts = {one["name"]: one["expected"] for one in json.loads(DATA.read_text(encoding="utf-8"))["facts"]}
    try:
        import ncgears  # noqa: F401 - whether it is there

        contestants = ("mechwright", "ncgears")
    except ImportError:
        print("skipped: ncgears is not installed")
        contestants = ("mechwright",)
    for name in names:
        table, expression, ratio = DESIGNS[name]
        params = SizedParams.model_validate({**PROFILE, **table})
        print(f"{name}: {table}")
        for who in contestants:
            start = time.process_time()
            distance, outlines = (
                ours(table) if who == "mechwright" else theirs(expression, ratio, params.teeth)
            )
            taken = time.process_time() - start
            off, flank = abs(distance - facts[f"{name}.a"]), 1e3 * flank_error(params, outlines[0])
            print(
                f"  {who:<11} {taken:8.2f} s  centre distance off {off:.1e} mm  flank off {flank:.4f} µm  "
                f"{sum(map(len, outlines))} points",
                flush=True,
            )
            if who == "mechwright":
                found = mesh(*outlines, table_of(params).pair, params.teeth, allowance=1e-3)
                print(f"  {'':<11} transmission error {1e6 * found.transmission_error:.2f} µrad")


if __name__ == "__main__":
    main(sys.argv[1:] or list(DESIGNS))
