"""Masses as columns: of the parts of a design, one by one, and where a study may ask for them."""

import numpy as np
import pytest

from mechwright import (
    DesignError,
    DesignRule,
    Family,
    Instance,
    Motion,
    Outline,
    Parameters,
    Part,
    Stage,
    in_turn,
)
from mechwright.contracts.evaluation import Batch
from mechwright.contracts.masses import masses_of
from mechwright.contracts.motion import Channel
from mechwright.geometry import Loop
from mechwright.mechanics.linkage import Boss, hull_link, rectangle, web_link
from mechwright.mechanics.linkage.areas import hull_area, rectangle_area, two_discs_area, web_area
from mechwright.plugins.host import host
from mechwright.studies.study import study_of


class BlockParams(Parameters):
    width: float = 10.0
    height: float = 10.0


class Blocks(Family[BlockParams]):
    name, title, summary = "blocks", "Blocks", "Two blocks and a spare one."
    Params = BlockParams

    def rules(self):
        return in_turn(DesignRule("blocks.flat", "width", "is too flat", lambda t: t.params.width, 1))

    def solve(self, params, samples):
        x = np.linspace(0, 1, samples)
        return Motion("x", {"x": Channel(x, "mm"), "y": Channel(x * params.width, "mm")})

    def parts(self, params):
        size = [(0, 0), (params.width, 0), (params.width, params.height), (0, params.height)]
        outline = Outline(Loop.polygon(size))
        return [
            Part("block", outline, 10.0, "steel", (Instance("ground"), Instance("ground", 10.0))),
            Part("spare", outline, 20.0, "steel"),
        ]


def test_a_third_partys_masses_are_columns():
    family = Blocks()
    assert family.measures(BlockParams()) == {
        "y.least": "mm", "y.greatest": "mm", "mass": "kg", "mass.block": "kg", "mass.spare": "kg",
    }  # fmt: skip
    batch = Batch(BlockParams, {}, {"width": np.array([10.0, 0.5, 20.0])})
    found = family.evaluate(batch, ("mass", "mass.spare", "y.greatest"))
    steel = 7.85e-6 * 1000
    np.testing.assert_allclose(found.values["mass"], [2 * steel, np.nan, 4 * steel])
    np.testing.assert_allclose(found.values["mass.spare"], [2 * steel, np.nan, 4 * steel])
    assert found.counts == {"blocks.flat": 1}
    motion = family.evaluate(batch, ("mass",), Stage.MOTION)
    assert np.isnan(motion.values["mass"]).all()
    assert not motion.counts


def test_what_has_no_density_has_no_mass(monkeypatch):
    monkeypatch.setattr("mechwright.contracts.mass.material", lambda _: type("None", (), {"density": 0.0}))
    assert masses_of(Blocks().parts(BlockParams())) == {}


def test_a_study_of_the_motion_has_no_masses(tmp_path):
    content = {
        "format": 1, "family": "four-bar", "name": "light", "parameters": {},
        "study": {"stage": "motion", "ranges": {"crank": {"least": 20, "greatest": 30}}, "columns": ["mass.crank"]},
    }  # fmt: skip
    with pytest.raises(DesignError, match=r'study.stage: is "motion", and mass.crank is of parts'):
        study_of(content, tmp_path / "light.toml", host())
    content["study"]["stage"] = "parts"
    assert study_of(content, tmp_path / "light.toml", host()).units["mass.crank"] == "kg"


def test_areas_by_formula_are_those_of_outlines():
    rng = np.random.default_rng(4)
    for count in (1, 2, 3, 4, 7):
        places = 30 * (rng.normal(size=(count, 40)) + 1j * rng.normal(size=(count, 40)))
        radii = rng.uniform(1, 30, (count, 40))
        radii[:, 30:] = 5
        drawn = [
            hull_link([*map(Boss, *column)]).area
            for column in zip(places.T.tolist(), radii.T.tolist(), strict=True)
        ]
        np.testing.assert_allclose(hull_area(places, radii, 40), drawn, rtol=1e-12)
    row = [0j, 10 + 0j, 30 + 0j, 10 + 0j]
    assert hull_area(row, [5.0] * 4, 1)[0] == pytest.approx(hull_link([Boss(at, 5.0) for at in row]).area)
    one, two = Boss(0j, 8.0), Boss(40 + 0j, 6.0)
    assert two_discs_area(40.0, 8.0, 6.0) == pytest.approx(hull_link([one, two]).area, rel=1e-13)
    assert web_area(40.0, 8.0, 6.0, 7.0, 4.0) == pytest.approx(web_link(one, two, 7.0, 4.0).area, rel=1e-13)
    assert rectangle_area(9.0, 7.0, 2.0) == pytest.approx(rectangle(0j, 9 + 7j, 2.0).area, rel=1e-13)
