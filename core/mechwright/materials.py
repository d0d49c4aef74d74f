"""Workpiece materials: the one place that knows their densities and elastic constants."""

from dataclasses import dataclass

from mechwright.errors import DesignError


@dataclass(frozen=True, slots=True)
class Material:
    """A workpiece material (common handbook values of the usual grade).

    Parameters
    ----------
    name
        As a design file says it.
    density
        g/cm³.
    modulus
        Young's modulus, MPa.
    poisson
        Poisson's ratio.
    strength
        Yield or proof strength, MPa.
    """

    name: str
    density: float
    modulus: float
    poisson: float
    strength: float


MATERIALS = {
    material.name: material
    for material in (
        Material("aluminium", 2.70, 70_000, 0.33, 250),  # EN AW-6082 T6
        Material("brass", 8.50, 97_000, 0.34, 250),  # CW614N
        Material("steel", 7.85, 210_000, 0.30, 355),  # S355
        Material("pom", 1.41, 2_800, 0.35, 65),
    )
}


def material(name: str) -> Material:
    """Look a material up; raises DesignError that lists the known ones."""
    try:
        return MATERIALS[name]
    except KeyError:
        raise DesignError(f"material {name!r} is not known; one of: {', '.join(sorted(MATERIALS))}") from None
