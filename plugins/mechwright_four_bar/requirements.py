"""What the four-bar's synthesis can be asked for."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from mechwright import Parameters
from mechwright.mechanics.adjustable.requirement import Coordinate, PhasedPath, check_lengths
from mechwright.mechanics.planar.course import MOST_RATIO
from mechwright.mechanics.tracing.requirement import MOST_STARTS, PlanePath, Turn
from mechwright.units import Degrees, Millimetres, Ratio, Unit

AccelerationRatio = Annotated[float, Field(ge=-MOST_RATIO, le=MOST_RATIO), Unit("")]

Link = Annotated[float, Field(ge=1, le=2000), Unit("mm")]

LINKS = ("crank", "coupler", "follower", "ground")
ONE_OF = f"{', '.join(LINKS[:-1])} and {LINKS[-1]}"

NEAREST_POLE = 0.01
"""mm. A pole nearer to A0 asks for a coupler that hardly turns; nothing of that kind can be built."""


class PathRequirement(PlanePath):
    """The table ``[requirement]`` of the kind ``path``: a coupler point through points, in this order.

    Examples
    --------
    >>> len(PathRequirement().points)
    6
    """

    frame: tuple[Coordinate, Coordinate, Coordinate, Coordinate] | None = Field(
        None,
        description="Rectangle [least x, least y, greatest x, greatest y] in which both fixed pivots "
        "stand. Default: anywhere.",
    )


_BEAN = (
    ((20.0, 88.0), (-10.0, 78.0), (-27.0, 52.0), (-25.0, 30.0)),
    ((20.0, 88.0), (-5.0, 87.0), (-24.0, 63.0), (-29.0, 40.0)),
)


class AdjustablePathRequirement(PhasedPath):
    """The table ``[requirement]`` of the kind ``adjustable-path``: one path per phase, on one machine.

    Examples
    --------
    >>> [len(points) for points in AdjustablePathRequirement().phases]
    [4, 4]
    """

    phases: tuple[Annotated[tuple[tuple[Coordinate, Coordinate], ...], Field(min_length=3)], ...] = Field(
        _BEAN,
        min_length=1,
        max_length=8,
        description="Points [x, y] of each phase in order; the first, in which the machine is set, is the "
        "same in all.",
    )
    moves: Literal["moving", "fixed", "both"] = Field(
        "moving",
        description="Pivots that are set: A and B on the coupler, A0 and B0 in the ground, or both; crank "
        "and follower keep their lengths.",
    )


class PolesRequirement(Parameters):
    """The table ``[requirement]`` of the kind ``poles``: acceleration poles of the coupler, from A0.

    Examples
    --------
    >>> len(PolesRequirement().poles)
    3
    """

    poles: tuple[tuple[Coordinate, Coordinate], ...] = Field(
        ((93.6, 163.6), (-21.2, 234.4), (119.2, 233.2)),
        min_length=2,
        max_length=5,
        description="Places [x, y] of the acceleration pole, from A0.",
    )
    crank_turns: tuple[Turn, ...] = Field(
        (0.0, 50.0, 150.0),
        max_length=5,
        description="Crank angle at each pole from that at the first, the first 0; [] for any angles.",
    )
    acceleration_ratios: tuple[AccelerationRatio, ...] = Field(
        (0.0,),
        min_length=1,
        max_length=5,
        description="Acceleration of the crank over the square of its speed at each pole, per radian, "
        "counter-clockwise positive, or one for all.",
    )
    ground_angle: Annotated[float, Field(ge=-360, le=360), Unit("deg")] | None = Field(
        None, description="Direction from A0 to B0. Default: any."
    )
    ground: Annotated[float, Field(ge=1, le=5000), Unit("mm")] | None = Field(
        None, description="Distance from A0 to B0, only with ground_angle. Default: any."
    )
    least_transmission_angle: Degrees = Field(
        1.0, ge=0.5, le=80, description="Least transmission angle of the designs."
    )
    starts: int = Field(5000, ge=100, le=MOST_STARTS, description="Random linkages to start from.")
    designs: int = Field(20, ge=1, le=100, description="Most designs to give.")
    seed: int = Field(0, ge=0, le=1_000_000, description="Seed of the random starts.")

    @model_validator(mode="after")
    def _together(self) -> Self:
        count = len(self.poles)
        if self.crank_turns:
            if len(self.crank_turns) != count:
                raise ValueError(f"crank_turns has {len(self.crank_turns)} angles for {count} poles")
            if self.crank_turns[0] != 0 or len({turn % 360 for turn in self.crank_turns}) < count:
                raise ValueError("crank_turns starts with 0 and holds no angle twice")
        if len(self.acceleration_ratios) not in {1, count}:
            raise ValueError(
                f"acceleration_ratios has {len(self.acceleration_ratios)} numbers for {count} poles; "
                "give one for all, or one for each"
            )
        if self.ground is not None and self.ground_angle is None:
            raise ValueError("ground needs a ground_angle; give both, or the angle alone")
        if len(set(self.poles)) < count:
            raise ValueError("poles holds a place twice; leave one out")
        if any(abs(complex(*pole)) < NEAREST_POLE for pole in self.poles):
            raise ValueError(f"poles: a pole in A0 needs a coupler at rest; keep {NEAREST_POLE:g} mm away")
        if self.freedom < 0:
            raise ValueError(
                f"poles: {count} places are {2 * count} equations for {2 * count + self.freedom} unknowns; "
                "leave places out, or leave ground, ground_angle or crank_turns open"
            )
        return self

    @property
    def freedom(self) -> int:
        """Unknowns less equations; above 0 there are infinitely many linkages."""
        count = len(self.poles)
        angles = 1 if self.crank_turns else count
        return 3 + angles + (self.ground_angle is None) + (self.ground is None) - 2 * count


class SwingRequirement(Parameters):
    """The table ``[requirement]`` of the kind ``swing``: a turning crank whose follower swings so far.

    Examples
    --------
    >>> SwingRequirement().swing
    90.0
    """

    also: ClassVar[Mapping[str, str]] = {
        "angle": "it is called swing",
        "quick_return": "it is called time_ratio",
    }

    swing: Degrees = Field(90.0, ge=1, le=170, description="Angle between the follower's limit positions.")
    time_ratio: Ratio = Field(
        1.0, ge=1, le=5, description="Time of the follower's slow stroke over that of its quick one."
    )
    quick: Literal["ccw", "cw"] = Field("ccw", description="Sense of the follower's quick stroke.")
    crank: Link | None = Field(None, description="Crank; one length is given, the others follow.")
    coupler: Link | None = Field(None, description="Coupler.")
    follower: Link | None = Field(60.0, description="Follower; 60 where no length is given.")
    ground: Link | None = Field(None, description="Distance of the fixed pivots.")
    middle_angle: Degrees = Field(
        90.0, ge=-360, le=360, description="Direction of the follower in the middle of its swing, from X."
    )
    least_transmission_angle: Degrees = Field(
        30.0, ge=1, le=80, description="Least transmission angle of the turn."
    )
    longest_link: Millimetres = Field(400.0, ge=1, le=2000, description="Longest link, ground included.")
    shortest_link: Millimetres = Field(10.0, ge=1, le=1000, description="Shortest link, ground included.")
    designs: int = Field(6, ge=1, le=12, description="Most designs to give.")

    @model_validator(mode="before")
    @classmethod
    def _one_length(cls, given: Any) -> Any:
        names = [name for name in LINKS if isinstance(given, Mapping) and given.get(name) is not None]
        if len(names) > 1:
            raise ValueError(f"{' and '.join(names)}: give one of {ONE_OF}; the others follow from it")
        return {**given, "follower": None} if names and names != ["follower"] else given

    @model_validator(mode="after")
    def _lengths(self) -> Self:
        check_lengths(self.shortest_link, self.longest_link)
        if all(getattr(self, name) is None for name in LINKS):
            raise ValueError(f"no length is given; give one of {ONE_OF}")
        return self
