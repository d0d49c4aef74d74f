"""Many Geneva mechanisms at once are what each of them is by itself."""

import numpy as np
import pytest

from mechwright import Stage
from mechwright.contracts.by_arrays import Designs
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.contracts.table_evaluation import answer
from mechwright.testing.evaluation import assert_same
from mechwright_geneva.family import Geneva
from mechwright_geneva.parameters import GenevaParams

FAMILY = Geneva()

COLUMNS = (
    "centre_distance", "dwell_share", "index_time", "alpha_w_max", "contact_force_max", "contact_pressure_max",
    "crank_torque_max", "contact_force.greatest", "crank_torque.least", "pressure_angle.greatest", "jerk_w.least",
    "theta_w.greatest", "mass", "mass.wheel", "mass.hub", "mass.locking-disc", "mass.crank", "mass.roller",
)  # fmt: skip


def ranges(size, **more):
    rng = np.random.default_rng(3)
    found = {
        "slots": (4, 9), "crank_half_angle": (35, 75), "offset_angle": (-4, 16), "entry_radius": (60, 150),
        "roller_radius": (3, 9), "load_inertia": (0.001, 0.1), **more,
    }  # fmt: skip
    return {
        name: rng.integers(*ends, size)
        if isinstance(ends[0], int) and name == "slots"
        else rng.uniform(*ends, size)
        for name, ends in found.items()
    }


def laws(size):
    names = np.array(
        ["cycloidal", "modified-sine", "3-4-5", "4-5-6-7", "modified-trapezoid", "simple-harmonic"]
    )
    return names[np.random.default_rng(4).integers(0, names.size, size)]


STUDIES = {
    "curved": ({}, {**ranges(48), "law": laws(48)}),
    "loaded": ({"load_torque": 2.0, "bore": 0, "rollers": 2}, ranges(24, crank_half_angle=(40, 60))),
    "thin": (
        {"slots": 6, "crank_half_angle": 58, "offset_angle": 10, "roller_radius": 4, "entry_radius": 100},
        {"thickness": np.linspace(1, 14, 27)},
    ),
    "sized": (
        {"slots": 6, "law": "3-4-5", "fixing": 0, "hub_diameter": 30},
        {"crank_half_angle": np.linspace(50, 66, 16), "offset_angle": np.linspace(8, 12, 16),
         "centre_distance": np.linspace(90, 200, 16), "roller_radius": np.full(16, 4.0),
         "lock_radius": np.linspace(20, 60, 16), "hub_height": np.linspace(4, 8, 16)},
    ),
    "keyed": (
        {"slots": 6, "law": "3-4-5", "crank_half_angle": 58, "offset_angle": 10, "hub_diameter": 24},
        {"entry_radius": np.tile(np.linspace(60, 160, 8), 4), "roller_radius": np.tile(np.linspace(3, 8, 8), 4),
         "keyway_width": np.repeat([0.0, 2.0, 3.0, 4.5], 8), "driver_keyway_width": np.repeat([3.0, 3.0, 0.0, 2.0], 8),
         "keyway_relief": np.tile([0.0, 0.6, 1.2, 4.0], 8)},
    ),
    "keyed shafts": (
        {"slots": 6, "crank_half_angle": 58, "offset_angle": 10, "roller_radius": 4, "keyway_width": 3,
         "driver_keyway_width": 4},
        {"entry_radius": np.linspace(60, 120, 12), "bore": np.linspace(0.1, 16, 12),
         "driver_bore": np.linspace(18, 2, 12)},
    ),
    "backwards": (
        {"crank_half_angle": 60, "offset_angle": 10, "slots": 6, "driver_direction": "backwards"},
        {"entry_radius": np.linspace(70, 120, 5), "roller_radius": np.linspace(3, 6, 5)},
    ),
    "lopsided": (
        {"slots": 6, "law": "polynomial", "polynomial": [0, 0, 0, 12, -21, 12, -2], "speed": 10,
         "load_inertia": 0.001, "pin_fit": "P7"},
        {"crank_half_angle": np.linspace(54, 60, 8), "offset_angle": np.linspace(8, 13, 8),
         "roller_radius": np.linspace(3, 4.2, 8)},
    ),
    "straight": (
        {"law": "straight", "roller_radius": 6},
        {"slots": np.array([3, 4, 5, 6, 8, 10]), "entry_radius": np.linspace(50, 140, 6),
         "thickness": np.linspace(3, 14, 6), "pin_diameter": np.linspace(6, 11.5, 6)},
    ),
}  # fmt: skip


@pytest.mark.parametrize("study", STUDIES)
@pytest.mark.parametrize("stage", [Stage.MOTION, Stage.PARTS])
def test_they_are_what_each_is_by_itself(study, stage):
    content, varied = STUDIES[study]
    batch = Batch(GenevaParams, content, varied)
    if stage is Stage.MOTION:
        batch = Batch(GenevaParams, content, {name: values[:8] for name, values in varied.items()})
    found = FAMILY.evaluate(batch, COLUMNS, stage)
    assert_same(found, one_by_one(FAMILY.judge, FAMILY.solve, batch, COLUMNS, stage, FAMILY.parts))


@pytest.mark.parametrize("study", ["curved", "loaded", "sized", "straight", "keyed", "keyed shafts"])
def test_no_design_is_asked_by_itself(study):
    content, varied = STUDIES[study]
    batch = Batch(GenevaParams, content, varied)
    designs = Designs(batch.common, varied)
    with np.errstate(all="ignore"):
        said = answer(FAMILY, designs, COLUMNS, Stage.PARTS)
    assert not said.undecided.any()
    if study in ("curved", "straight"):
        assert 0.05 < (said.forbidden == 0).mean() < 0.95
