"""What the family contract asks of a model of tolerances."""

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from mechwright.arrays import Array
from mechwright.contracts.family import Family
from mechwright.contracts.finding import Stage, errors
from mechwright.contracts.tolerance_settings import Tolerances, ToleranceSettings
from mechwright.contracts.tolerances import Output, ToleranceModel
from mechwright.mechanics.tolerance import analyse
from mechwright.testing.strategies import tables

_STEP = 1e-5
"""mm or rad: its square, times a second derivative of order 1, is far below what is asked of the slope."""

_WITHIN = 1e-4
"""Part of an output's greatest sensitivity by which a slope may differ: third order where it is steep."""

_PLACES = 25
"""Positions that are tried."""

_RANDOM = 20
"""Random designs that are tried."""


class ToleranceTests:
    """The part of :class:`mechwright.testing.FamilyContract` that is about tolerances."""

    family: ClassVar[type[Family[Any]]]
    """The class under test."""

    def test_tolerances(self, design: Mapping[str, Any]) -> None:
        """Sensitivities, where there is a model of tolerances, are the derivatives of its exact errors."""
        params = self.family.Params.model_validate(dict(design))
        model = self.family().tolerances(params, Tolerances())
        if model is None:
            pytest.skip("the family has no tolerance analysis")
        faults = tolerance_faults(model)
        assert not faults, "; ".join(faults)

    def strategy(self) -> st.SearchStrategy[Mapping[str, Any]]:
        """Random tables; by default every field anywhere inside its bounds."""
        return tables(self.family.Params)

    def test_tolerances_of_random_designs(self) -> None:
        """Any design that moves has an analysis of its tolerances, or the family has none."""

        # Inside the method: hypothesis wants one test function for each class that inherits this one.
        @settings(max_examples=_RANDOM, deadline=None, suppress_health_check=list(HealthCheck))
        @given(self.strategy())
        def has_an_analysis(table: Mapping[str, Any]) -> None:
            try:
                params = self.family.Params.model_validate(dict(table))
            except ValidationError:
                return
            if errors(self.family().check(params), Stage.MOTION):
                return
            asked = Tolerances(ToleranceSettings(samples=100))
            model = self.family().tolerances(params, asked)
            if model is not None:
                assert len(analyse(model, asked).results) == len(model.outputs) > 0

        has_an_analysis()


def tolerance_faults(model: ToleranceModel) -> list[str]:
    """Errors that are none without a deviation, wrong shapes, and sensitivities that are no derivatives."""
    at = model.positions[:: max(1, model.positions.size // _PLACES)]
    names = [one.name for one in model.contributors]
    found = [] if len(set(names)) == len(names) else ["two contributors have one name"]
    for output in model.outputs:
        row = model.sensitivities(output.name, at)
        wanted = [(output.components, one.components, at.size) for one in model.contributors]
        if [part.shape for part in row] != wanted:
            found.append(
                f"{output.name}: sensitivities of the shapes {[part.shape for part in row]}, not {wanted}"
            )
            continue
        if not any(np.isfinite(part).any() for part in row):
            found.append(f"{output.name}: there is a sensitivity in no position")
        found += _slopes(model, output, at, list(row))
    return found


def _slopes(model: ToleranceModel, output: Output, at: Array, row: list[Array]) -> list[str]:
    found = []
    good = np.all([np.isfinite(part).all(axis=(0, 1)) for part in row], axis=0)
    scale = max([float(np.abs(part[..., good]).max(initial=0.0)) for part in row], default=0.0) or 1.0
    for number, one in enumerate(model.contributors):
        for component in range(one.components):
            ends = []
            for step in (_STEP, 0.0, -_STEP):
                moved = [np.zeros((each.components, 1)) for each in model.contributors]
                moved[number][component] = step
                ends.append(model.errors(output.name, moved, at))
            if np.abs(ends[1][..., good]).max(initial=0.0) > _WITHIN * _STEP * scale:
                found.append(f"{output.name}: there is an error without a deviation")
            slope = (ends[0] - ends[2]) / (2 * _STEP)
            miss = float(np.abs(slope - row[number][:, component])[..., good].max(initial=0.0))
            if not miss <= _WITHIN * scale:
                found.append(f"{output.name} by {one.name}: the sensitivity misses the slope by {miss:.3g}")
    return found
