"""The designs of the reference as design tables."""

import json
import math
from pathlib import Path

from mechwright_noncircular_gears.sized import SizedParams

REFERENCE = json.loads(
    (Path(__file__).parents[1] / "data" / "noncircular-gears.json").read_text(encoding="utf-8")
)
NODES = list(zip(*REFERENCE["designs"]["D7"]["nodes_deg"], strict=True))

TABLES = {
    "D1": {"law": "fourier", "sines": [math.degrees(0.3)], "teeth": 40},
    "D2": {"law": "window", "window_ratio": 0.85, "window": 100, "blend": 90, "teeth": 41},
    "D3": {"law": "ellipse", "mate_lobes": 2, "eccentricity": 0.3, "teeth": 30},
    "D4": {"law": "ellipse", "lobes": 2, "mate_lobes": 3, "eccentricity": 0.12, "teeth": 32},
    "D5": {"law": "ellipse", "internal": True, "mate_lobes": 3, "eccentricity": 0.15, "teeth": 24},
    "D6": {"law": "eccentric-circle", "eccentricity": 0.25, "teeth": 40},
    "D7": {"law": "table", "nodes": NODES, "teeth": 40},
    "D8": {
        "law": "limacon",
        "lobes": 2,
        "mate_lobes": 2,
        "eccentricity": 0.25,
        "teeth": 72,
        "module": 1.5,
        "cutter": "shaper",
    },
    "D9": {"law": "fourier", "sines": [math.degrees(0.42)], "teeth": 20},
    "D10": {"law": "ellipse", "lobes": 3, "mate_lobes": 3, "eccentricity": 0.2, "teeth": 48},
    "SL": {"law": "slider", "teeth": 48},
    "GP4": {"law": "geneva", "teeth": 60, "slots": 4, "ramp": 0.145, "window": 180, "blend": 60},
    "GP6": {"law": "geneva", "teeth": 60, "slots": 6, "ramp": 0.2, "window": 160, "blend": 40},
}
"""Design of the reference to its table."""


def design(name: str, **changes: object) -> SizedParams:
    """A design of the reference, without backlash."""
    return SizedParams.model_validate({"backlash": 0.0, "bore": 8, **TABLES[name], **changes})
