"""Workpiece materials: the one place that knows their densities."""

from dataclasses import dataclass

from mechwright.errors import DesignError


@dataclass(frozen=True, slots=True)
class Material:
    """A workpiece material; density in g/cm³ (common handbook values)."""

    name: str
    density: float


MATERIALS = {
    material.name: material
    for material in (
        Material("aluminium", 2.70),
        Material("brass", 8.50),
        Material("steel", 7.85),
        Material("pom", 1.41),
    )
}


def material(name: str) -> Material:
    """Look a material up; raises DesignError that lists the known ones."""
    try:
        return MATERIALS[name]
    except KeyError:
        raise DesignError(f"material {name!r} is not known; one of: {', '.join(sorted(MATERIALS))}") from None
