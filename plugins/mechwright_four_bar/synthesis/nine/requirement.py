"""What can be asked for of a path through nine points, exactly."""

from typing import Literal, Self

from pydantic import Field, field_validator, model_validator

from mechwright.mechanics.adjustable.requirement import Coordinate
from mechwright_four_bar.synthesis.burmester.requirements import LinkLimits

NINE = 9
"""Points that finitely many four-bars pass through; through fewer infinitely many do."""


class NinePointsRequirement(LinkLimits):
    """The table ``[requirement]`` of the kind ``nine-points``: every four-bar exactly through nine points.

    Examples
    --------
    >>> len(NinePointsRequirement().points)
    9
    """

    points: tuple[tuple[Coordinate, Coordinate], ...] = Field(
        (
            (18.58, 50.66), (23.44, 61.32), (15.12, 64.02), (4.5, 59.22), (-6.9, 47.12), (-11.68, 35.5),
            (-11.0, 28.22), (-5.04, 26.88), (5.7, 35.74),
        ),
        min_length=NINE,
        max_length=NINE,
        description="Nine points [x, y], each another, in the order in which they are passed.",
    )  # fmt: skip
    order: Literal["kept", "any"] = Field(
        "kept", description="Whether the points are passed in their order, or in any."
    )

    @field_validator("points", mode="before")
    @classmethod
    def _count(cls, points: object) -> object:
        if isinstance(points, list | tuple) and len(points) != NINE:
            raise ValueError(
                f"{len(points)} points are given: finitely many four-bars pass through {NINE}; for another "
                "number ask for the kind 'path', which comes as near as can be"
            )
        return points

    @model_validator(mode="after")
    def _apart(self) -> Self:
        places: dict[tuple[float, float], int] = {}
        for number, point in enumerate(self.points, start=1):
            if point in places:
                raise ValueError(
                    f"points {places[point]} and {number} are both ({point[0]:g}, {point[1]:g}): through "
                    "eight places pass infinitely many four-bars; move one, or ask for the kind 'path'"
                )
            places[point] = number
        return self
