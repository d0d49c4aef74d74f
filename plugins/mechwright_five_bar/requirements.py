"""What the five-bar's synthesis can be asked for."""

from typing import Annotated

from pydantic import Field

from mechwright.mechanics.adjustable.requirement import Coordinate, PhasedPath
from mechwright.units import Millimetres
from mechwright_five_bar.defaults.limits import LEAST_TEETH

_TIP = (
    ((-5.77, 187.59), (12.64, 173.08), (24.84, 144.31), (29.0, 103.49)),
    ((-5.77, 187.59), (28.22, 186.44), (56.97, 173.65), (76.03, 150.46)),
    ((-5.77, 187.59), (-6.61, 148.02), (-3.45, 91.61), (0.55, 34.6)),
)


class AdjustablePathRequirement(PhasedPath):
    """The table ``[requirement]`` of the kind ``adjustable-path``: one path per phase, on one machine.

    Examples
    --------
    >>> [len(points) for points in AdjustablePathRequirement().phases]
    [4, 4, 4]
    """

    phases: tuple[Annotated[tuple[tuple[Coordinate, Coordinate], ...], Field(min_length=3)], ...] = Field(
        _TIP,
        min_length=1,
        max_length=8,
        description="Points [x, y] of each phase in order; the first, in which the machine is set, is the "
        "same in all.",
    )
    crank_teeth: int = Field(20, ge=LEAST_TEETH, le=200, description="Teeth of the crank's gear.")
    arm_teeth: int = Field(40, ge=LEAST_TEETH, le=200, description="Teeth of the arm's gear.")
    idler: bool = Field(True, description="Whether an idler lets crank and arm turn the same way.")
    full_turn: bool = Field(False, description="Whether the crank turns fully in every phase.")
    least_chord: Millimetres = Field(
        0.0,
        ge=0,
        le=500,
        description="Least distance of the places of one pivot in two phases: bore and rim for holes; 0 for "
        "any, set in slots.",
    )

    @property
    def ratio(self) -> float:
        """Turns of the arm per turn of the crank."""
        return (1 if self.idler else -1) * self.crank_teeth / self.arm_teeth
