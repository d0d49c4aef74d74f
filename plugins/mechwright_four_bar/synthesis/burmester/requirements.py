"""What can be asked for of a body's poses, and of the follower's answers to the crank."""

from itertools import combinations
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from mechwright import Parameters
from mechwright.mechanics.adjustable.requirement import Coordinate, check_lengths
from mechwright.mechanics.tracing.requirement import check_one_way
from mechwright.units import Degrees, Millimetres, Unit

Direction = Annotated[float, Field(ge=-3600, le=3600), Unit("deg")]

EXACT = 5
"""Most poses that a dyad can meet exactly in general."""

MOST_POSES = 200
"""More poses of a body, or pairs of angles, than this say nothing new."""


class LinkLimits(Parameters):
    """Limits that exact syntheses share."""

    drive: Literal["crank", "lever", "any"] = Field(
        "any", description="A crank that turns fully, a lever that swings through the positions, or either."
    )
    least_transmission_angle: Degrees = Field(
        20.0, ge=1, le=80, description="Least transmission angle of the turn, or of the lever's swing."
    )
    longest_link: Millimetres = Field(400.0, ge=1, le=2000, description="Longest link, ground included.")
    shortest_link: Millimetres = Field(10.0, ge=1, le=1000, description="Shortest link, ground included.")
    designs: int = Field(5, ge=1, le=50, description="Most designs to give.")

    @model_validator(mode="after")
    def _lengths(self) -> Self:
        check_lengths(self.shortest_link, self.longest_link)
        return self


class PosesRequirement(LinkLimits):
    """The table ``[requirement]`` of the kind ``poses``: the coupler carries a body through poses in order.

    Examples
    --------
    >>> len(PosesRequirement().poses)
    5
    """

    poses: tuple[tuple[Coordinate, Coordinate, Direction], ...] = Field(
        ((7, -6, -27), (14, -17, -40), (23, -24, -61), (28, -25, -72), (37, -19, -91)),
        min_length=3,
        max_length=MOST_POSES,
        description="Poses [x, y, direction] of the body, mm and degrees: 3 to 5 are met exactly, more as "
        "nearly as possible.",
    )
    arm: Annotated[float, Field(gt=0, le=5000), Unit("mm")] = Field(
        50.0,
        description="Of more than five poses: an error of direction counts as that of a point so far out.",
    )
    starts: int = Field(
        400, ge=20, le=5000, description="Joints of the body to try, where there are infinitely many."
    )
    seed: int = Field(0, ge=0, le=1_000_000, description="Seed of these joints.")

    @model_validator(mode="after")
    def _apart(self) -> Self:
        # More poses are fitted, and a body may come back to one of them.
        for (i, one), (k, two) in combinations(enumerate(self.poses, start=1), 2):
            near = k == i + 1 or len(self.poses) <= EXACT
            if near and one[:2] == two[:2] and (one[2] - two[2]) % 360 == 0:
                raise ValueError(f"poses {i} and {k} are the same; leave one out")
        if all((pose[2] - self.poses[0][2]) % 360 == 0 for pose in self.poses):
            raise ValueError(
                "all poses have the direction of the first: a body that does not turn needs parallel cranks"
            )
        return self


class FunctionRequirement(LinkLimits):
    """The table ``[requirement]`` of the kind ``function``: the follower answers angles of the crank.

    Examples
    --------
    >>> len(FunctionRequirement().crank_angles)
    5
    """

    crank_angles: tuple[Direction, ...] = Field(
        (0.0, 10.9, 28.5, 46.2, 57.1),
        min_length=3,
        max_length=MOST_POSES,
        description="Angles of the crank in their order; 3 pairs are met exactly, 4 and 5 with free "
        "offsets, more as nearly as possible.",
    )
    follower_angles: tuple[Direction, ...] = Field(
        (0.0, 21.2, 49.5, 72.7, 85.3),
        min_length=3,
        max_length=MOST_POSES,
        description="Angle of the follower at each of them.",
    )
    offsets: Literal["none", "follower", "both"] = Field(
        "both",
        description="Which angles are counted from anywhere: none (all from the ground line), the "
        "follower's, or both.",
    )
    ground: Annotated[float, Field(ge=1, le=2000), Unit("mm")] = Field(
        100.0, description="Distance of the fixed pivots; the other links scale with it."
    )
    tolerance: Degrees = Field(
        0.0,
        ge=0,
        le=45,
        description="Greatest error of the follower that counts as met; 0 for as near as possible.",
    )

    @model_validator(mode="after")
    def _pairs(self) -> Self:
        one, two = len(self.crank_angles), len(self.follower_angles)
        if one != two:
            raise ValueError(f"follower_angles has {two} angles for the {one} of crank_angles")
        check_one_way("crank_angles", self.crank_angles)
        needed = {"none": 3, "follower": 4, "both": 5}[self.offsets]
        if one < needed:
            raise ValueError(
                f"crank_angles: {one} pairs leave offsets = {self.offsets!r} open; give {needed}, or say "
                "fewer offsets"
            )
        if len(set(self.follower_angles)) == 1:
            raise ValueError("follower_angles are all the same: the follower would stand still")
        return self
