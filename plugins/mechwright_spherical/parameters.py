"""The design table of a spherical linkage."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from mechwright import FIRST, GIVEN, Parameters
from mechwright.mechanics.linkage.fields import Phase, phases_together
from mechwright.units import Degrees, Millimetres, Ratio, RevPerMin, Unit
from mechwright_spherical.defaults import published_example
from mechwright_spherical.parts.hardware import DriveTable, FlatTable, HardwareTable, StandTable

Coordinate = Annotated[float, Field(ge=-1000, le=1000), Unit("")]
Pin = Annotated[tuple[Coordinate, ...], Field(min_length=2, max_length=3)]
"""Two numbers: a point of the plane, to be projected. Three: a direction of any length."""
Point = tuple[Coordinate, Coordinate]
Direction = tuple[Coordinate, Coordinate, Coordinate]
Turn = Annotated[float, Field(ge=-720, le=720), Unit("deg")]

MOST_RADIUS = 2000.0
"""Of a sphere, mm."""

MOST_POSITIONS = 50
"""Path points of a design: a table for people."""


def same_length(name: str, points: tuple[Any, ...], other: str, angles: tuple[Any, ...]) -> None:
    """Refuse two lists that do not go together, with a ValueError that names both."""
    if len(points) != len(angles):
        raise ValueError(
            f"{name} has {len(points)} entries and {other} {len(angles)}; give one angle for each point"
        )


Start = Annotated[float, Field(ge=-360, le=360), Unit("deg")] | None
Travel = Annotated[float, Field(ge=-720, le=720), Unit("deg")] | None


class PhaseTable(Parameters):
    """A further phase: how far crank and follower are turned to it in the pose of setting, and its path."""

    crank_turn: Degrees = Field(
        0.0, ge=-360, le=360, description="Of the crank about its axis, from phase 1 to this one."
    )
    start: Start = Field(None, description="As of phase 1. Default: the same.")
    travel: Travel = Field(None, description="As of phase 1. Default: the same.")
    path: tuple[Direction, ...] = Field(
        (), max_length=MOST_POSITIONS, description="Prescribed path points of this phase, as directions."
    )
    path_angles: tuple[Turn, ...] = Field(
        (), max_length=MOST_POSITIONS, description="Their input angles, counted as those of phase 1."
    )

    @model_validator(mode="after")
    def _phase(self) -> Self:
        if self.travel == 0:
            raise ValueError("travel is 0; give the angle that the input turns")
        same_length("path", self.path, "path_angles", self.path_angles)
        return self


class FourBarPhase(PhaseTable):
    """A further phase of a four-bar."""

    follower_turn: Degrees = Field(
        0.0, ge=-360, le=360, description="Of the output link about its axis, likewise."
    )


class FiveBarPhase(PhaseTable):
    """A third or further phase of a five-bar."""

    rocker_turn: Degrees = Field(
        0.0, ge=-360, le=360, description="Of the rocker about its pin of the arm, likewise."
    )


class FourBarTable(Parameters):
    """A spherical four-bar by its arcs.

    The input axis points along ``input_axis``; the output axis lies ``ground`` away from it, towards
    ``output_towards``.
    """

    ground: Degrees = Field(
        80.0, gt=0, lt=180, description="Arc α1 between the fixed axes.", json_schema_extra=FIRST
    )
    input: Degrees = Field(
        30.0, gt=0, lt=180, description="Arc α2 of the input link.", json_schema_extra=FIRST
    )
    coupler: Degrees = Field(
        70.0, gt=0, lt=180, description="Arc α3 of the coupler.", json_schema_extra=FIRST
    )
    output: Degrees = Field(
        60.0, gt=0, lt=180, description="Arc α4 of the output link.", json_schema_extra=FIRST
    )
    branch: Literal[1, -1] = Field(
        1,
        description="1 or -1: which of the two ways to assemble it, the sign of c.(a x b).",
        json_schema_extra=FIRST,
    )
    point_azimuth: Degrees = Field(
        35.0, ge=-180, le=180, description="Path point: angle κ along the coupler from the input pin."
    )
    point_elevation: Degrees = Field(
        15.0, ge=-90, le=90, description="Path point: angle η out of the coupler's great circle, to its left."
    )
    start: Start = Field(
        None,
        description="Input angle at the start; 0 where the input link points at the output axis. Default: "
        "0, or where the swing of an input begins that cannot turn fully.",
        json_schema_extra=FIRST,
    )
    travel: Travel = Field(
        None,
        description="How far the input turns from there. Default: a turn, or as far as it can and back.",
        json_schema_extra=FIRST,
    )
    input_axis: Direction = Field((0.0, 0.0, 1.0), description="Direction of the input axis.")
    output_towards: Direction = Field(
        (1.0, 0.0, 0.0), description="Direction to which the output axis lies from the input axis."
    )
    path: tuple[Direction, ...] = Field(
        (),
        max_length=MOST_POSITIONS,
        description="Prescribed path points, as directions; none to prescribe nothing.",
    )
    path_angles: tuple[Turn, ...] = Field(
        (), max_length=MOST_POSITIONS, description="Input angles of the path points, from the start."
    )
    setting_angle: Travel = Field(
        None, description="Input angle in phase 1 at which the machine is set to another phase."
    )
    phases: tuple[FourBarPhase, ...] = Field(
        (), max_length=7, description="Further phases: the coupler has more places for its pins."
    )
    phase: Phase = 1

    @model_validator(mode="after")
    def _together(self) -> Self:
        if self.travel == 0:
            raise ValueError("travel is 0; give the angle that the input turns")
        same_length("path", self.path, "path_angles", self.path_angles)
        phases_together(self.setting_angle, self.phases, self.phase)
        return self


class FiveBarTable(Parameters):
    """An adjustable spherical five-bar by its pins in the position of adjustment; ``n`` marks phase 2."""

    a0: Pin = Field(
        published_example.PINS["a0"],
        description="Axis of the crank: x, y in the plane, or a direction x, y, z.",
        json_schema_extra=FIRST,
    )
    a1: Pin = Field(
        published_example.PINS["a1"],
        description="Pin of crank and coupler in phase 1.",
        json_schema_extra=FIRST,
    )
    a1n: Pin = Field(
        published_example.PINS["a1n"],
        description="Pin of crank and coupler in phase 2.",
        json_schema_extra=FIRST,
    )
    b0: Pin = Field(published_example.PINS["b0"], description="Axis of the arm.", json_schema_extra=FIRST)
    b1: Pin = Field(
        tuple(round(x, 6) for x in published_example.PINS["b1"]),
        description="Pin of arm and rocker.",
        json_schema_extra=FIRST,
    )
    c1: Pin = Field(
        published_example.PINS["c1"],
        description="Pin of coupler and rocker in phase 1.",
        json_schema_extra=FIRST,
    )
    c1n: Pin = Field(
        published_example.PINS["c1n"],
        description="Pin of coupler and rocker in phase 2.",
        json_schema_extra=FIRST,
    )
    point: Pin = Field(
        published_example.TABLE_2[0],
        description="Path point, the same in both phases.",
        json_schema_extra=FIRST,
    )
    projection_length: Ratio = Field(
        published_example.LENGTH,
        gt=0,
        le=1000,
        description="Distance of the plane from the centre, in the plane's unit; for pins of two numbers.",
        json_schema_extra=FIRST,
    )
    projection_centre: Point = Field(
        (0.0, 0.0), description="Point of the plane that the z axis meets; for pins of two numbers."
    )
    common_arcs: bool = Field(
        False,
        description="Bring the pins to the mean arcs, so that one crank and one rocker serve both phases.",
    )
    ratio: Ratio = Field(
        published_example.RATIO,
        ge=-10,
        le=10,
        description="Turns of the arm per turn of the crank.",
        json_schema_extra=FIRST,
    )
    phases: tuple[FiveBarPhase, ...] = Field(
        (), max_length=6, description="Third and further phases, each by its turns from phase 1."
    )
    phase: Annotated[Phase, Field(json_schema_extra=FIRST)] = 1
    start: Degrees = Field(
        0.0, ge=-360, le=360, description="Crank angle, from the adjustment, at which phase 1 starts."
    )
    start_n: Degrees = Field(
        0.0, ge=-360, le=360, description="Crank angle, from the adjustment, at which phase 2 starts."
    )
    travel: Degrees = Field(
        published_example.ANGLES[-1],
        ge=-720,
        le=720,
        description="Turn of the crank in phase 1, from its start.",
        json_schema_extra=FIRST,
    )
    travel_n: Degrees = Field(
        published_example.ANGLES_N[-1],
        ge=-720,
        le=720,
        description="Turn of the crank in phase 2, from its start.",
        json_schema_extra=FIRST,
    )
    path: tuple[Pin, ...] = Field(
        (),
        max_length=MOST_POSITIONS,
        description="Prescribed path points of phase 1; none to prescribe nothing.",
    )
    path_angles: tuple[Turn, ...] = Field(
        (), max_length=MOST_POSITIONS, description="Crank angles of these points, from the adjustment."
    )
    path_n: tuple[Pin, ...] = Field((), max_length=MOST_POSITIONS, description="Path points of phase 2.")
    path_angles_n: tuple[Turn, ...] = Field((), max_length=MOST_POSITIONS, description="Their crank angles.")

    @model_validator(mode="after")
    def _together(self) -> Self:
        if self.ratio == 0:
            raise ValueError('ratio is 0, so the arm stands still; use kind = "four-bar"')
        if self.travel == 0 or self.travel_n == 0:
            raise ValueError("travel or travel_n is 0; give the angle that the crank turns")
        same_length("path", self.path, "path_angles", self.path_angles)
        same_length("path_n", self.path_n, "path_angles_n", self.path_angles_n)
        if self.phase > 2 + len(self.phases):
            raise ValueError(
                f"phase is {self.phase}, and there are {2 + len(self.phases)}; give more in phases"
            )
        if not self.flat_pins:
            fields = type(self).model_fields
            for name in ("projection_length", "projection_centre"):
                if getattr(self, name) != fields[name].default:
                    raise ValueError(f"{name} is for pins of two numbers, and all have three; leave it out")
        return self

    @property
    def flat_pins(self) -> bool:
        """Whether any pin or path point lies in the plane."""
        named = (self.a0, self.a1, self.a1n, self.b0, self.b1, self.c1, self.c1n, self.point)
        return any(len(pin) == 2 for pin in (*named, *self.path, *self.path_n))


class SphericalParams(Parameters):
    """A spherical four-bar, or an adjustable spherical five-bar, and its links.

    Examples
    --------
    >>> SphericalParams(kind="four-bar").four_bar.ground
    80.0
    """

    kind: Literal["five-bar", "four-bar"] = Field(
        "five-bar",
        description="Which of the tables five_bar and four_bar is used. The other table is not allowed.",
        json_schema_extra=FIRST,
    )
    radius: Millimetres = Field(
        100.0,
        ge=5,
        le=MOST_RADIUS,
        description="Radius of the sphere on which the path point moves.",
        json_schema_extra=FIRST,
    )
    speed: RevPerMin = Field(
        10.0, ge=0.001, le=3000, description="Constant speed of the input.", json_schema_extra=FIRST
    )
    path_tolerance: Annotated[float, Field(gt=0, le=100), Unit("mm")] | None = Field(
        None,
        description="Allowed distance of the path from its prescribed points. Default: it is only reported.",
        json_schema_extra={**FIRST, **GIVEN},
    )
    least_transmission: Degrees = Field(
        40.0,
        ge=0,
        le=89,
        description="Transmission angle that neither side may go below without a warning.",
        json_schema_extra=GIVEN,
    )
    five_bar: FiveBarTable = Field(FiveBarTable(), description="The adjustable five-bar.")
    four_bar: FourBarTable = Field(FourBarTable(), description="The four-bar.")
    hardware: HardwareTable = Field(HardwareTable(), description="Sizes of the links.")
    stand: StandTable = Field(StandTable(), description="The frame's foot.")
    drive: DriveTable = Field(DriveTable(), description="The bevel drive of a five-bar.")
    flat: FlatTable = Field(FlatTable(), description="Links as flat strips.")

    @model_validator(mode="after")
    def _one_kind(self) -> Self:
        other: Any = self.four_bar if self.kind == "five-bar" else self.five_bar
        name = "four_bar" if self.kind == "five-bar" else "five_bar"
        if other != type(other)():
            raise ValueError(f'{name} is not looked at with kind = "{self.kind}"; set kind, or leave it out')
        if self.kind == "four-bar" and self.drive != DriveTable():
            raise ValueError("drive is the bevel drive of a five-bar; leave it out with a four-bar")
        if self.kind == "five-bar" and self.hardware.frame == "two":
            raise ValueError('hardware.frame = "two" is for a four-bar; leave it out with a five-bar')
        if self.path_tolerance is not None and not self._has_path:
            raise ValueError("path_tolerance needs a path; give path and path_angles, or leave it out")
        return self

    @property
    def _has_path(self) -> bool:
        table = self.five_bar if self.kind == "five-bar" else self.four_bar
        more = any(row.path for row in table.phases)
        return bool(table.path) or more or bool(self.kind == "five-bar" and self.five_bar.path_n)
