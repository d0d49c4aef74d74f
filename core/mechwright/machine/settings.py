"""The keys of ``[machine]``."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import AfterValidator, Field

from mechwright.contracts.joint import Vector
from mechwright.errors import DesignError
from mechwright.machine.frame.keys import FrameKeys
from mechwright.standards.motors import motor
from mechwright.units import RevPerMin, Unit


def _designation(text: str) -> str:
    if text in {"none", "auto"}:
        return text
    try:
        return motor(text).name
    except DesignError as error:
        raise ValueError(f"is no motor; {str(error).partition('; ')[2]}") from error


MotorName = Annotated[str, Field(max_length=40), AfterValidator(_designation)]


class MachineSettings(FrameKeys):
    """The table ``[machine]``; as long as it says nothing, nothing is found and no page written."""

    also: ClassVar[Mapping[str, str]] = {
        "irregularity": "it is speed_variation, in %, up or down: 0.05 of it is speed_variation = 2.5"
    }

    speed: Annotated[RevPerMin, Field(ge=0.001, le=20000)] | None = Field(
        None,
        description="Mean speed of the input, of a lever its swings there and back. Default: as the "
        "mechanism's own parameters have it.",
    )
    direction: Literal["both", "forwards", "backwards"] = Field(
        "both", description="Which way the machine runs; backwards is the same motion in reverse."
    )
    load: Annotated[float, Field(ge=0, le=10000), Unit("N*m")] = Field(
        0.0,
        description="Torque against the turning of the output, beside what the parameters say of loads.",
    )
    output: Annotated[str, Field(max_length=64)] = Field(
        "",
        description="Body with that load. Default: the one that turns in the frame undriven.",
    )
    up: Literal["none", "x", "-x", "y", "-y", "z", "-z"] = Field(
        "none", description="Direction of the mechanism that points up; none leaves weights out."
    )
    speed_variation: Annotated[float, Field(gt=0, le=100), Unit("%")] = Field(
        5.0,
        description="Greatest difference of the input's speed from the requested one within the turn, in % "
        "of it, up or down. Default: 5. A motor that exceeds it is refused; the flywheel keeps it.",
    )
    motor: MotorName = Field(
        "none", description='"auto" for the lightest that is enough, a designation, or none.'
    )
    gear: Annotated[float, Field(ge=0.01, le=1000), Unit("")] = Field(
        1.0, description="Turns of the motor's shaft for one of the input, by a belt or gears between them."
    )
    voltage: Annotated[float, Field(ge=5, le=80), Unit("V")] = Field(
        24.0, description="That a stepper's driver is fed with."
    )
    margin: Annotated[float, Field(ge=1, le=10), Unit("")] = Field(
        1.5, description="Factor on all torques before a motor is judged, for friction and starting."
    )

    @property
    def upwards(self) -> Vector:
        """Unit vector that points up, in the coordinates of the poses; 0, 0, 0 where weights are left out."""
        if self.up == "none":
            return 0.0, 0.0, 0.0
        x, y, z = ((-1.0 if self.up[0] == "-" else 1.0) if self.up[-1] == axis else 0.0 for axis in "xyz")
        return x, y, z

    @property
    def variation(self) -> float:
        """``speed_variation`` as a share of the requested speed."""
        return self.speed_variation / 100

    @property
    def couples(self) -> bool:
        """Whether the frame carries the motor, coupled straight to the input: no gear goes between."""
        return self.motor != "none" and self.frame in {"plate", "base"}
