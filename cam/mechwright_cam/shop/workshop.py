"""The workshop of a file of its own, ``shop.toml``: crib, machine, what is in hand, what is preferred."""

import re
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from mechwright.contracts.materials import OWN_NAME, MaterialName
from mechwright.contracts.own_materials import OwnMaterial
from mechwright.contracts.parameters import Parameters
from mechwright.designs.inches import Units
from mechwright.units import Millimetres
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.tool import Tool

LAYOUT: Literal[1] = 1
"""Version of the layout of shop files."""

MEASURED_OFF = 0.25
"""Share by which a sheet may be thinner or thicker than it is called: plywood 6 is 5.2 to 6.3."""


def _screw(text: str) -> str:
    if not re.fullmatch(r"M\d+(\.\d+)?", text):
        raise ValueError("should be a metric thread, such as M5")
    return text


class Holder(Parameters):
    """A table ``[holder.NAME]``."""

    diameter: Millimetres = Field(gt=0, le=200, description="Of its lower end, beside the tool.")


class Plates(Parameters):
    """A table ``[[stock]]``: plates of one material that are in hand."""

    material: MaterialName = Field(description="Of what.")
    thickness: tuple[Annotated[Millimetres, Field(gt=0, le=500)], ...] = Field(
        min_length=1, max_length=100, description="Thicknesses."
    )
    measured: Millimetres | None = Field(
        None, gt=0, le=500, description="Of these plates, by callipers: designs and programs go by it."
    )
    length: Millimetres | None = Field(
        None, gt=0, le=10000, description="Of ready blanks. Default: pieces are sawn off as parts ask."
    )
    width: Millimetres | None = Field(None, gt=0, le=10000, description="Of ready blanks.")

    @model_validator(mode="after")
    def _measured(self) -> Self:
        if self.measured is None:
            return self
        if len(self.thickness) != 1:
            raise ValueError("measured is of plates of one thickness; give each thickness its own [[stock]]")
        if abs(self.measured - self.thickness[0]) > MEASURED_OFF * self.thickness[0]:
            raise ValueError(
                f"measured is {self.measured:g}, and thickness {self.thickness[0]:g}: correct the wrong one"
            )
        return self

    @property
    def in_hand(self) -> tuple[float, ...]:
        """Thicknesses that programs go by, mm: the measured one, if there is one."""
        return self.thickness if self.measured is None else (self.measured,)


class Prefer(Parameters):
    """What holds where a design file says nothing: tables as design files have them."""

    cam: dict[str, Any] = Field(default_factory=dict, description="Keys of [cam].")
    machine: dict[str, Any] = Field(
        default_factory=dict, description="Keys of [machine], for designs with that table."
    )
    cut: dict[str, Any] = Field(
        default_factory=dict, description="Keys of [cut], such as measured kerfs; lengths in mm."
    )


class Workshop(Parameters):
    """A shop file."""

    format: Literal[1] = Field(LAYOUT, description="Version of the layout of the file.")
    name: str = Field("the shop", min_length=1, max_length=60, description="Its name.")
    units: Units = Field("mm", description="Of this file, of programs, tables and sheets.")
    control: str = Field("", max_length=40, description="Control that reads the programs.")
    machine: Machine | None = Field(None, description="The mill: a table, a known name, or a machine file.")
    crib: str = Field(
        "", max_length=200, description="A tool library beside this file, for all tools or the rest of them."
    )
    holder: dict[str, Holder] = Field(default_factory=dict, description="Holders by name.")
    tool: tuple[Tool, ...] = Field((), description="The tools.")
    material: dict[Annotated[str, Field(pattern=OWN_NAME)], OwnMaterial] = Field(
        default_factory=dict, max_length=100, description="Materials besides the built-in ones, by name."
    )
    stock: tuple[Plates, ...] = Field((), description="Plates in hand; none: whatever a part asks for.")
    screws: tuple[Annotated[str, AfterValidator(_screw)], ...] = Field(
        (), max_length=50, description="Threads of the screws that are kept, such as M5; empty: all."
    )
    pins: tuple[Annotated[Millimetres, Field(gt=0, le=50)], ...] = Field(
        (), max_length=50, description="Diameters of the dowel pins that are kept; empty: all."
    )
    prefer: Prefer = Field(Prefer(), description="Values for design files that do not state their own.")
