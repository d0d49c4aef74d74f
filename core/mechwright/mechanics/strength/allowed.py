"""What materials bear in machine parts, MPa: handbook figures for the usual grades, none of them checked.

Steel is S355 or C45 normalised, aluminium 6082-T6, brass CuZn39, POM a copolymer. Grades follow from their
group: endurance and roots by the ratio of tensile strengths, keys, contact and heads by that of yield
strengths, at most what the group bears where a handbook has no more.
"""

from dataclasses import dataclass

from mechwright.contracts.materials import entry, material
from mechwright.errors import DesignError


@dataclass(frozen=True)
class Allowed:
    """Stresses, MPa.

    Parameters
    ----------
    endurance
        Alternating bending, of a polished bar; of aluminium at 10⁸ turns.
    key
        Pressure of a key on the hub, one direction.
    root
        At the root of a tooth, one direction, with :data:`ROOT_SAFETY`.
    contact
        Hertz pressure of what runs for long.
    head
        Pressure under the head of a screw; more wants a washer.
    shear
        At which the turns of a thread strip: 0.6 of the tensile strength of the weakest usual grade (S235,
        CuZn39Pb3), of aluminium 0.65 (6082-T6).
    """

    endurance: float
    key: float
    root: float
    contact: float
    head: float
    shear: float


ALLOWED = {
    "steel": Allowed(300.0, 100.0, 160.0, 600.0, 355.0, 216.0),
    "aluminium": Allowed(95.0, 80.0, 60.0, 200.0, 200.0, 188.5),
    "brass": Allowed(100.0, 50.0, 60.0, 250.0, 250.0, 258.0),
    "pom": Allowed(25.0, 20.0, 20.0, 60.0, 40.0, 39.0),
    "polycarbonate": Allowed(8.0, 15.0, 8.0, 30.0, 30.0, 39.0),
    "acrylic": Allowed(8.0, 12.0, 8.0, 30.0, 20.0, 30.0),
    "hdpe": Allowed(5.0, 6.0, 5.0, 15.0, 10.0, 12.0),
    "plywood": Allowed(8.0, 6.0, 6.0, 8.0, 5.0, 3.0),
    "mdf": Allowed(4.0, 4.0, 3.0, 5.0, 3.0, 1.5),
    "5754": Allowed(60.0, 25.0, 38.0, 65.0, 80.0, 123.5),
    "6082": Allowed(95.0, 80.0, 60.0, 200.0, 200.0, 188.5),
    "7075": Allowed(160.0, 140.0, 100.0, 360.0, 360.0, 331.5),
    "5083": Allowed(70.0, 37.0, 45.0, 90.0, 115.0, 143.0),
    "S235": Allowed(210.0, 66.0, 112.0, 400.0, 235.0, 216.0),
    "C45": Allowed(270.0, 86.0, 160.0, 515.0, 305.0, 348.0),
    "11SMn30": Allowed(230.0, 100.0, 130.0, 600.0, 355.0, 276.0),
    "1.4301": Allowed(200.0, 60.0, 140.0, 350.0, 210.0, 312.0),
    "1.4305": Allowed(180.0, 54.0, 130.0, 320.0, 190.0, 300.0),
}
"""By material."""

REVERSING_KEY, SHOCK_KEY, REVERSING_ROOT = 0.6, 0.5, 0.7
"""What is left where a torque changes its direction, or comes in shocks."""

ROOT_SAFETY = 1.5
"""That is in what a tooth's root bears."""

PIN_SHEAR = {
    "steady": 80.0,
    "swelling": 60.0,
    "alternating": 40.0,
    "hardened": 120.0,
    "hardened, alternating": 60.0,
}
"""Shear of pins, MPa: unhardened under three kinds of load, and hardened, of which half is left as well where
the load changes its sign."""

PIN_BENDING = 250.0
"""MPa of a hardened dowel whose load turns over: a quarter of its strength."""


def allowed(name: str) -> Allowed:
    """Of a material, or of its group; raises DesignError that lists the known ones."""
    found = entry(ALLOWED, name)
    if found is None:
        raise DesignError(f"no allowed stresses for {material(name).name}; one of: {', '.join(ALLOWED)}")
    return found
