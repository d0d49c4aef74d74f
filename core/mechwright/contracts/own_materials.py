"""Materials that a shop adds to the built-in ones: a table ``[material.NAME]`` of its file.

A material is cut, screwed and pressed as the one that it is ``like``; its own figures lie over those.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated

from pydantic import Field

from mechwright.contracts.materials import MATERIALS, NEVER, BuiltInMaterial, Grades, Material
from mechwright.contracts.parameters import Parameters
from mechwright.errors import DesignError
from mechwright.units import MetresPerMin, Ratio


class OwnMaterial(Parameters):
    """A table ``[material.NAME]``."""

    like: BuiltInMaterial = Field(description="The built-in material whose figures hold where none is given.")
    density: Annotated[Ratio, Field(gt=0, le=25)] | None = Field(None, description="Density in g/cm³.")
    modulus: Annotated[Ratio, Field(gt=0, le=1e6)] | None = Field(None, description="Young's modulus in MPa.")
    strength: Annotated[Ratio, Field(gt=0, le=5000)] | None = Field(
        None, description="Yield or proof strength in MPa; tensile strength of what breaks without yielding."
    )
    expansion: Annotated[Ratio, Field(ge=0, le=500)] | None = Field(
        None, description="Growth of a length by one kelvin, in millionths of it."
    )
    force: Annotated[Ratio, Field(gt=0, le=10000)] | None = Field(
        None, description="Specific cutting force of a chip 1 mm thick in N/mm² (k_c1.1)."
    )
    force_exponent: Ratio | None = Field(
        None, ge=0, lt=1, description="Exponent by which that force grows as the chip gets thinner (m)."
    )
    least_speed: MetresPerMin | None = Field(None, gt=0, le=2000, description="Least usual cutting speed.")
    greatest_speed: MetresPerMin | None = Field(
        None, gt=0, le=2000, description="Greatest usual cutting speed."
    )
    order: str = Field("", max_length=60, description="Name by which plates are ordered; by default its own.")
    advice: str = Field("", max_length=200, description="A sentence for the setup sheets.")

    def material(self, name: str) -> Material:
        """The material of this name."""
        base = MATERIALS[self.like]
        said = {
            key: value
            for key in ("density", "modulus", "strength", "expansion", "force", "force_exponent")
            if (value := getattr(self, key)) is not None
        }
        low = base.speed[0] if self.least_speed is None else self.least_speed
        high = base.speed[1] if self.greatest_speed is None else self.greatest_speed
        if low > high:
            raise DesignError(
                f"least_speed {low:g} is above greatest_speed {high:g}; give both in m/min, the lesser first"
            )
        ordered = self.order or name
        return replace(
            base,
            name=name,
            speed=(low, high),
            grades=Grades(ordered, base.grades.bar, ordered, base.grades.us_bar),
            advice=self.advice or base.advice,
            **said,
        )


_own: set[str] = set()


def add_materials(tables: Mapping[str, OwnMaterial]) -> None:
    """Let designs name these materials, in place of those that were added before.

    Raises DesignError for the name of a built-in material, or of one that nobody should cut.
    """
    for name in _own:
        del MATERIALS[name]
    _own.clear()
    made = {}
    for name, table in tables.items():
        if name in MATERIALS:
            raise DesignError(f"material.{name}: is built in; give yours another name")
        if (why := NEVER.get(name.casefold())) is not None:
            raise DesignError(f"material.{name}: is not cut: {why}")
        try:
            made[name] = table.material(name)
        except DesignError as error:
            raise DesignError(f"material.{name}: {error}") from error
    MATERIALS.update(made)
    _own.update(made)
