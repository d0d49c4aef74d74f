"""A family whose limits are known exactly, and what its designs are tried on."""

import tomllib
from pathlib import Path
from typing import Literal

from procedural import Procedural
from pydantic import Field, model_validator

from mechwright.contracts.finding import Finding, errors
from mechwright.contracts.parameters import Parameters
from mechwright.designs.design import Design
from mechwright.remedies import Bench, Limits, tried
from mechwright.units import Degrees, Millimetres


class Pins(Parameters):
    first: Millimetres = Field(5.0, ge=1, le=100, description="First pin.")
    second: Millimetres = Field(5.0, ge=1, le=100, description="Second pin.")


class BeamParams(Parameters):
    length: Millimetres = Field(100.0, ge=1, le=5000, description="Length.")
    width: Millimetres = Field(20.0, gt=0, le=500, description="Width.")
    holes: int = Field(2, ge=0, le=40, description="Number of holes.")
    tilt: Degrees = Field(0.0, ge=-90, le=90, description="Angle of the end.")
    kind: Literal["plain", "bent", "forked"] = Field("plain", description="Shape.")
    collar: Millimetres | None = Field(None, ge=1, le=50, description="Collar. Default: none.")
    collar_width: Millimetres | None = Field(None, ge=1, le=50, description="Its width.")
    pins: Pins = Field(Pins(), description="Its pins.")

    @model_validator(mode="after")
    def _together(self):
        if (self.collar is None) != (self.collar_width is None):
            raise ValueError("give both collar and collar_width")
        return self


def error(code, parameter, remedy, *numbers, proposed=()):
    return Finding.error(
        code, parameter, "it is wrong", *numbers, unit="mm", remedy=remedy, proposed=proposed
    )


class Beam(Procedural[BeamParams]):
    name = "beam"
    title = "Beam"
    summary = "A beam."
    Params = BeamParams

    def found(self, params):
        found = list(self._first(params))
        return found if errors(found) else [*found, *self._second(params)]

    def _first(self, params):
        if params.width < params.length / 10:
            yield error("beam.slender", "width", "make width larger", params.width, params.length / 10)
        if params.kind == "forked":
            yield error("beam.kind", "kind", "take another")
        if params.tilt > 30.5:
            yield error("beam.tilt", "tilt", "less", params.tilt, 30.5)

    def _second(self, params):
        if params.holes * params.pins.first > params.length / 2:
            yield error("beam.holes", "holes", "fewer holes, or a smaller pins.first")
        if params.collar is not None and params.collar < 2 * params.width:
            yield error("beam.collar", "collar", "a larger collar")
        if params.holes > 30:
            yield Finding.warning("beam.many", "holes", "so many", remedy="fewer")
        yield Finding.note("beam.kind", "a figure")

    solve = parts = None


Beam.__abstractmethods__ = frozenset()


def design(family=Beam, **table):
    lines = tomllib.loads("\n".join(f"{key} = {value}" for key, value in table.items()))
    params = family.Params.model_validate(lines)
    return Design("tried", family(), params, Path("tried.toml"), "", content={"parameters": lines})


def told(of, **limits):
    found = list(of.family.check(of.params))
    return tried(of, found, Limits(**limits)) if limits else tried(of, found)


def bench(of, **limits):
    return Bench(of, lambda one: one.family.check(one.params), limits=Limits(**limits))
