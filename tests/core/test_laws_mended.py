"""Laws that stand in for rows or coefficients that are none."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright import Stage
from mechwright.contracts.finding import errors
from mechwright.mechanics.laws import LAWS
from mechwright.mechanics.laws.faults import table_faults
from mechwright.mechanics.laws.mended import instead, mended_rows, nearest_laws
from mechwright.mechanics.laws.table import Table
from mechwright_cam_follower.family import CamFollower
from mechwright_geneva.family import Geneva

COARSE = ((0.0, 0.0), (0.2, 0.03), (0.4, 0.29), (0.6, 0.71), (0.8, 0.97), (1.0, 1.0))
STEEP = tuple((k / 12, round((k / 12) ** 2, 6)) for k in range(13))
"""Rises faster and faster to its end."""


@pytest.mark.parametrize("name", LAWS)
def test_a_few_points_of_a_law_are_fitted_within_a_hundredth_and_find_their_name(name: str) -> None:
    u = np.linspace(0.0, 1.0, 8)
    rows = list(zip(u, LAWS[name]().at(u).s, strict=True))
    mended, even = mended_rows(rows), np.linspace(0.0, 1.0, 201)
    assert mended is not None
    assert np.abs(Table(mended).at(even).s - LAWS[name]().at(even).s).max() < 0.01
    assert nearest_laws(rows)[0] == name


@settings(max_examples=40, deadline=None)
@given(st.lists(st.tuples(st.floats(0.02, 1), st.floats(0, 1)), min_size=3, max_size=14))
def test_whatever_rises_is_mended_to_a_law(steps: list[tuple[float, float]]) -> None:
    u, s = np.cumsum(np.array([(0.0, 0.0), *steps]), axis=0).T
    mended = mended_rows(list(zip(u, s, strict=True)))
    if s[-1] == 0:
        assert mended is None
    elif mended is not None:
        assert not list(table_faults(mended))
        law = Table(mended)
        assert law.at(np.array([0.0, 1.0])).s == pytest.approx([0.0, 1.0], abs=1e-6)


def test_what_falls_or_does_not_rest_is_replaced_by_what_is_near() -> None:
    for rows in (STEEP, (*STEEP[:6], (0.5, 0.1), *STEEP[7:])):
        assert list(table_faults(rows))
        ((law, mended), *named) = instead(rows)
        assert law == "table"
        u, s = np.array(rows).T
        assert np.abs(Table(mended).at(u).s - s).max() < 0.15
        assert len(named) == 3


@pytest.mark.parametrize("rows", [COARSE, STEEP])
def test_changes_of_a_cam_and_of_a_geneva_wheel_work(rows: tuple[tuple[float, float], ...]) -> None:
    """A cam by a coarse table had the cycloidal law as its only change."""
    coefficients = (0.0, 0.0, 1.0)
    for family, tables in (
        (
            CamFollower(),
            [{"laws": ["table"], "table": rows}, {"laws": ["polynomial"], "polynomial": coefficients}],
        ),
        (Geneva(), [{"law": "table", "table": rows}, {"law": "polynomial", "polynomial": coefficients}]),
    ):
        for table in tables:
            params = family.Params.model_validate(table)
            (found, *_) = errors(family.judge(params), Stage.MOTION)
            assert len(found.proposed) == 4, found
            for change in found.proposed:
                own = {key.removeprefix("parameters."): value for key, value in change.items()}
                mended = family.Params.model_validate({**params.model_dump(), **own})
                assert not errors(family.judge(mended), Stage.MOTION), change
