"""What deviations of crank and slot do to the stroke."""

import math
from collections.abc import Sequence

import numpy as np

from mechwright import Array, Output, ToleranceModel, Tolerances
from mechwright_scotch_yoke.family import ScotchYokeParams


class ScotchYokeTolerances(ToleranceModel):
    """x = r cos θ + the place of the pin in its slot; the pin's displacement counts along the stroke."""

    input_name = "theta"

    def __init__(self, params: ScotchYokeParams, tolerances: Tolerances) -> None:
        self.radius = params.crank_radius
        self.positions = np.linspace(0, math.tau, 361)
        self.contributors = (
            tolerances.length("crank", self.radius),
            tolerances.gap("pin-in-slot", params.clearance, 2),
            *tolerances.input("input"),
        )
        self.outputs = (Output("stroke", "mm"),)

    def nominal(self, output: str, at: Array) -> Array:  # noqa: ARG002 - there is one output
        """The yoke's place, mm."""
        return self.radius * np.cos(at)[None]

    def sensitivities(self, output: str, at: Array) -> list[Array]:  # noqa: ARG002
        """dx/dr = cos θ, dx/dθ = -r sin θ."""
        rates = (np.cos(at), np.ones(at.shape), -self.radius * np.sin(at))
        return [rate[None, None] for rate in rates[: len(self.contributors)]]

    def errors(self, output: str, deviations: Sequence[Array], at: Array) -> Array:  # noqa: ARG002
        """Place as made, less the nominal one."""
        crank, pin, *turn = (one[0] for one in deviations)
        angle = at + turn[0] if turn else at
        return np.asarray((self.radius + crank) * np.cos(angle) + pin - self.radius * np.cos(at))[None]
