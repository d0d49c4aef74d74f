"""Every key of a spherical linkage that is accepted changes a result."""

import pytest

from mechwright.contracts.finding import errors
from mechwright_spherical.family import Spherical
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.rules.rule_table import findings_of as findings


def params(**table):
    return SphericalParams.model_validate(table)


def four(**table):
    return {"kind": "four-bar", "radius": 60, "four_bar": table}


NESTED = {
    "five_bar": {
        "a0": [0.02, 0.0], "a1": [0.15, 0.99], "a1n": [-0.1, 0.99], "b0": [1.3, 0.0], "b1": [1.9, 0.7],
        "c1": [0.9, 1.4], "c1n": [1.25, 1.75], "point": [0.2, 1.9], "projection_length": 4.8,
        "projection_centre": [0.1, 0.1], "common_arcs": True, "ratio": 0.45, "phase": 2, "start": -1, "start_n": -1,
        "travel": -28, "travel_n": -18,
    },
    "hardware": {
        "standoff": 6, "link_thickness": 6, "link_width": 7, "boss_diameter": 11, "boss_height": 0.6,
        "pin_diameter": 5, "fit": 0.1, "gap": 2, "material": "steel", "pin_material": "brass", "section": "shell",
    },
    "stand": {"arc": 45, "height": 50, "plate": 90, "plate_thickness": 10, "screw": 5},
    "drive": {"gears": False, "share": 0.8, "idler": 6, "face_width": 8},
    "flat": {"make": False, "thickness": 2, "bend_radius": 2, "neutral": 0.45},
}  # fmt: skip


def results(design, *solids):
    """What a design leads to, cheap things first; volumes of the solids that are named."""
    family = Spherical()
    motion = family.solve(design, 5)
    yield [(name, channel.values.tolist()) for name, channel in motion.channels.items()]
    yield [pose.position.tolist() + pose.rotation.tolist() for pose in motion.poses.values()]
    yield [str(one) for one in family.check(design)]
    yield [
        (part.name, part.outline, part.thickness, part.material, part.instances)
        for part in family.parts(design)
    ]
    yield [part.build().Volume() for part in family.parts(design) if part.name in solids]


def differ(one, two):
    return any(x != y for x, y in zip(results(one, *SOLIDS), results(two, *SOLIDS), strict=True))


SOLIDS = ("arm", "ground", "pin-a", "pinion")
"""Parts that show what motion, findings and outlines do not; the coupler takes long to build."""


@pytest.mark.parametrize(("table", "key"), [(t, k) for t, keys in NESTED.items() for k in keys])
def test_every_key_of_every_table_changes_a_result(table, key):
    start = {"five_bar": {"phase": 2, "start_n": -0.5}} if key.endswith("_n") else {}
    changed = {table: {**start.get(table, {}), key: NESTED[table][key]}}
    assert errors(findings(params(**changed))) == []
    assert differ(params(**start), params(**changed))


def test_the_tables_above_have_every_key():
    for table, keys in NESTED.items():
        fields = set(SphericalParams.model_fields[table].annotation.model_fields)
        # The frame is that of a four-bar, and so is the flange of a machine, which has tests of its own.
        others = {"path", "path_n", "path_angles", "path_angles_n", "phases", "frame", "motor_flange"}
        assert fields - set(keys) <= others
    assert set(FOUR_BAR_KEYS) == set(SphericalParams.model_fields["four_bar"].annotation.model_fields)


FOUR_BAR_KEYS = {
    "ground": 78, "input": 28, "coupler": 72, "output": 62, "branch": -1, "point_azimuth": 30, "point_elevation": 10,
    "start": 10, "travel": 180, "input_axis": [0, 1, 1], "output_towards": [1, 1, 0],
    "path": [[0.7, -0.4, 0.5]], "path_angles": [20], "setting_angle": 70, "phases": [{"follower_turn": 4}], "phase": 2,
}  # fmt: skip


@pytest.mark.parametrize("key", FOUR_BAR_KEYS)
def test_every_key_of_a_four_bar_changes_a_result(key):
    start: dict[str, object] = {}
    if key.startswith("path"):
        start = {"path": [[0.78, -0.4, 0.45]], "path_angles": [0]}
    if key in {"setting_angle", "phases", "phase"}:
        start = {"setting_angle": 50, "phases": [{"crank_turn": 8}]}
    one, two = params(**four(**start)), params(**four(**{**start, key: FOUR_BAR_KEYS[key]}))
    assert differ(one, two)
