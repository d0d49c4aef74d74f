"""Gears, CAM and command line against their targets: ``python benchmarks/bench_pipeline.py``.

Targets in seconds hold for a machine of two cores where ``import cadquery`` takes 1.6 s; they are scaled by
what that import takes here and now, so that a slow hour does not fail them.
"""

import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from harness import child, race, report, require

from mechwright.designs.design import load
from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import machine
from mechwright_cam.planning import choose_tools
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.table import settings_of
from mechwright_elliptic_gears.parts.gear import outline_of, teeth_of

EXAMPLE = Path(__file__).parents[1] / "examples" / "elliptic-pair.toml"
ANCHOR, ANCHOR_SECONDS = "import cadquery", 1.6
CAM = "import sys; sys.argv = ['mechwright', *sys.argv[1:]]; from mechwright.cli import main; main()"


def forget() -> None:
    """Empty what planning and proof remember of shapes: a command cuts every part for the first time."""
    for name, module in list(sys.modules.items()):
        if name.startswith("mechwright_cam.") and name != "mechwright_cam.shop.library":
            for value in vars(module).values():
                if hasattr(value, "cache_clear"):
                    value.cache_clear()


def main() -> int:
    design = load(EXAMPLE, host())
    post = host().get(Control, settings_of(design).cam.control)
    params = design.family.Params(teeth=41, module=2, eccentricity=0.4)
    (part,) = design.family.parts(params)
    library = load_library()
    (example,) = design.family.parts(design.params)

    def outline() -> object:
        outline_of.cache_clear()
        teeth_of.cache_clear()
        return outline_of(params)

    def job_of(which: object) -> object:
        forget()
        return machine(
            make_job(which, settings_of(design).cam, choose_tools(which, settings_of(design).cam, library)),
            post,
        ).proof.ok

    with tempfile.TemporaryDirectory() as folder:
        timings = race(
            {
                ANCHOR: child("import cadquery"),
                "mechwright --help": child(CAM, "--help"),
                "mechwright build (the example)": child(CAM, "build", str(EXAMPLE), "-o", f"{folder}/out"),
                "outline of 41 teeth, flanks and fit": outline,
                "CAM with proof, 41 teeth of module 2": lambda: job_of(replace(part)),
                "CAM with proof, the example": lambda: job_of(replace(example)),
            },
            rounds=7,
        )
    ratios = report("Gears, CAM and command line", timings, ANCHOR)
    print("\nlimits, as multiples of the anchor")
    kept = [
        require("--help in 0.2 s", ratios["mechwright --help"], 0.2 / ANCHOR_SECONDS),
        require("build in 2.5 imports", ratios["mechwright build (the example)"], 2.5),
        require("outline in 0.1 s", ratios["outline of 41 teeth, flanks and fit"], 0.1 / ANCHOR_SECONDS),
        require("CAM job in 0.5 s", ratios["CAM with proof, 41 teeth of module 2"], 0.5 / ANCHOR_SECONDS),
    ]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
