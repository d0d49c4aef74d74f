"""What a design file says of its files for simulators in ``[simulation]``."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import Field

from mechwright.contracts.joint import Vector
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.table import Table
from mechwright.designs.tables import read_table
from mechwright.errors import DesignError
from mechwright.machine.drive import GRAVITY
from mechwright.machine.settings import MachineSettings
from mechwright.machine.table import MachineTable
from mechwright.units import Unit


class SimulationSettings(Parameters):
    """The table ``[simulation]``: what files for simulators have besides masses and joints."""

    gravity: bool = Field(False, description="Weights act; machine.up says which way is up.")
    friction: Annotated[float, Field(ge=0, le=1), Unit("")] = Field(
        0.0,
        description="Coefficient of friction of pins in their holes and bushes, and of slides and rollers; "
        "ball bearings have their own. Steel on bronze with oil: 0.1.",
    )
    play: bool = Field(
        False, description="Pins have the play of their fits, in the middle of both limits; MJCF alone."
    )


class SimulationTable(Table[SimulationSettings]):
    """Reads and writes ``[simulation]``."""

    name = "simulation"
    settings = SimulationSettings

    def read(self, content: object, path: Path) -> SimulationSettings:
        """The settings; the defaults where the file has no table."""
        return read_table(SimulationSettings, content, str(path), self.name)

    def schema(self) -> dict[str, Any]:
        """Of the settings."""
        return model_schema(SimulationSettings)

    def text(self, value: SimulationSettings | None = None) -> list[str]:
        """The whole table for a new design; nothing where a design says nothing of simulation."""
        if value is not None and value == SimulationSettings():
            return []
        from mechwright.designs.text import table_lines

        return table_lines(SimulationSettings, self.name, value)


@dataclass(frozen=True)
class Options:
    """What a file has besides masses and joints, by the tables of its design.

    Parameters
    ----------
    wanted
        What ``[simulation]`` says.
    machine
        How fast the input runs, which way is up, and loads.
    """

    wanted: SimulationSettings
    machine: MachineSettings

    @classmethod
    def of(cls, tables: Mapping[str, Any]) -> Self:
        """The options of a design; raises DesignError for gravity where nothing says which way is up."""
        found = cls(
            tables.get(SimulationTable.name, SimulationSettings()),
            tables.get(MachineTable.name, MachineSettings()),
        )
        if found.wanted.gravity and found.machine.up == "none":
            raise DesignError('simulation.gravity: nothing says which way is up; set machine.up = "y"')
        return found

    @property
    def gravity(self) -> Vector:
        """Acceleration of what falls, m/s², in the coordinates of the poses; 0, 0, 0 without gravity."""
        if not self.wanted.gravity:
            return 0.0, 0.0, 0.0
        x, y, z = (-GRAVITY * one + 0.0 for one in self.machine.upwards)
        return x, y, z


PLAIN = Options(SimulationSettings(), MachineSettings())
"""Of a file with masses and joints alone."""
