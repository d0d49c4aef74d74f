"""What every synthesis of an adjustable linkage is asked for: a path for each phase, and limits."""

import math
from typing import Annotated, Self

from pydantic import Field, model_validator

from mechwright.contracts.parameters import Parameters
from mechwright.units import Degrees, Millimetres, Unit

Coordinate = Annotated[float, Field(ge=-10000, le=10000), Unit("mm")]

SAME_PLACE = 1e-6
"""mm. Points nearer to each other than this are one: so much is lost in decimals."""


def check_lengths(shortest: float, longest: float) -> None:
    """Raise ValueError where no length is left between the shortest and the longest link, mm."""
    if shortest >= longest:
        raise ValueError(f"shortest_link of {shortest:g} mm must be below longest_link of {longest:g} mm")


class PhasedPath(Parameters):
    """The part of a table ``[requirement]`` that four-bars and five-bars share."""

    phases: tuple[Annotated[tuple[tuple[Coordinate, Coordinate], ...], Field(min_length=3)], ...] = Field(
        min_length=1,
        max_length=8,
        description="Points [x, y] of each phase in order; the first, in which the machine is set, is the "
        "same in all.",
    )
    full_turn: bool = Field(True, description="Whether the crank turns fully in every phase.")
    tolerance: Millimetres = Field(
        0.1, ge=0, le=100, description="Distance in the mean that counts as met; a worse design is a warning."
    )
    least_transmission_angle: Degrees = Field(
        30.0, ge=1, le=80, description="Least transmission angle of the designs, in every phase."
    )
    longest_link: Millimetres = Field(500.0, ge=1, le=5000, description="Longest link, ground included.")
    shortest_link: Millimetres = Field(15.0, ge=1, le=1000, description="Shortest link, ground included.")
    least_chord: Millimetres = Field(
        12.5,
        ge=0,
        le=500,
        description="Least distance of the places of one pivot in two phases: bore and rim for holes; 0 for "
        "any, set in slots.",
    )
    length_step: Millimetres = Field(
        0.0,
        ge=0,
        le=50,
        description="Lengths that all phases have in common are multiples of it, the rest fitted again; "
        "0 for any lengths.",
    )
    starts: int = Field(2000, ge=100, le=100_000, description="Random linkages to try for the first phase.")
    designs: int = Field(3, ge=1, le=20, description="Most machines to give; each has a design per phase.")
    seed: int = Field(0, ge=0, le=1_000_000, description="Seed of the random starts.")

    @model_validator(mode="after")
    def _points(self) -> Self:
        first = self.phases[0][0]
        for number, points in enumerate(self.phases, start=1):
            if math.dist(points[0], first) > SAME_PLACE:
                raise ValueError(
                    f"phases begin at different points: phase {number} at {points[0]}, phase 1 at {first}; "
                    "all begin where the machine is set"
                )
            if len(set(points)) < len(points):
                raise ValueError(f"phases: phase {number} holds a point twice; leave one out")
        check_lengths(self.shortest_link, self.longest_link)
        return self
