"""What is proposed where the chosen cutters leave stock between the teeth."""

from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np

from mechwright.contracts.finding import Severity
from mechwright.mechanics.gearing.cut import cut_mesh


@dataclass
class Proof:
    """A pair as cut: how deep its outlines stand in each other, mm."""

    depth: float
    allowance: float = 0.01
    error: float = 0.0
    mesh: SimpleNamespace = field(init=False)

    def __post_init__(self) -> None:
        self.mesh = SimpleNamespace(depth=np.array([0.0, self.depth]), overlap=self.depth**2)

    @property
    def collides(self) -> bool:
        return self.depth > self.allowance


def test_smaller_mills_come_before_thinner_gears_the_thickest_first():
    found = cut_mesh(Proof(0.2), 14.0)
    assert (found.severity, found.value, found.limit) == (Severity.ERROR, 0.2, 0.01)
    keys = [next(iter(change)) for change in found.proposed]
    assert keys == sorted(keys), "cam before parameters"
    thicknesses = [value for change in found.proposed for key, value in change.items() if "thick" in key]
    assert len(thicknesses) >= 5
    assert all(a > b > 0 for a, b in zip([14.0, *thicknesses], thicknesses, strict=False))
    assert {"cam.tools": None} in found.proposed


def test_a_pair_that_meshes_as_cut_is_told_its_error():
    assert cut_mesh(Proof(0.005), 14.0).severity is Severity.NOTE
