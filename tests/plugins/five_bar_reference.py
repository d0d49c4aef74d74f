"""The reference of adjustable geared five-bars: its table, and facts that were computed by other means."""

import json
from pathlib import Path

from mechwright_five_bar.defaults.complete_parameters import CompleteParams

FACTS = {
    fact["name"]: fact
    for fact in json.loads(
        (Path(__file__).parents[1] / "data" / "adjustable.json").read_text(encoding="utf-8")
    )["facts"]
}
POINTS = FACTS["adjust.planar5.three.points"]

TURNS = (
    {"crank_turn": 15, "rocker_turn": -19, "swing_from": 98, "swing_to": -2},
    {"crank_turn": -12, "rocker_turn": 11, "swing_from": 71, "swing_to": -34},
)
NEAR = (
    {"crank_turn": 6, "rocker_turn": -9, "swing_from": 89, "swing_to": -31},
    {"crank_turn": -4, "rocker_turn": 3, "swing_from": 79, "swing_to": -41},
)
"""Turns that leave no room for a hole each."""


def reference(**changes) -> CompleteParams:
    """The reference mechanism: levers of 120 degrees and less."""
    table = {
        "crank": 100, "arm": 100, "coupler": 90, "rocker": 130, "ground": 125, "arm_angle": 3.5,
        "coupler_point_x": 30, "coupler_point_y": 85, "swing_from": 83, "swing_to": -37,
        "setting_angle": 83, "phases": TURNS, **changes,
    }  # fmt: skip
    return CompleteParams.model_validate(table)
