"""The design table of a planar linkage."""

from collections.abc import Collection, Mapping, Sequence
from typing import Annotated, Any, ClassVar, Literal, Self, get_args

from pydantic import Field, model_validator

from mechwright import FIRST, MaterialName, Parameters
from mechwright.mechanics.linkage import fields
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.units import Millimetres, Unit
from mechwright_linkage.catalogue.entries import ENTRIES
from mechwright_linkage.catalogue.entry import Entry, Prismatic
from mechwright_linkage.catalogue.legs import Jansen, Klann
from mechwright_linkage.catalogue.parallels import Pantograph, ParallelGuide
from mechwright_linkage.catalogue.quick_return import CrankShaper, Whitworth
from mechwright_linkage.catalogue.six_bars import StephensonOne, StephensonThree, WattOne, WattTwo
from mechwright_linkage.catalogue.slides import ScissorLift, ScotchYoke, TogglePress
from mechwright_linkage.catalogue.stephenson_two import StephensonTwo
from mechwright_linkage.catalogue.straight_lines import Chebyshev, Hoecken, Peaucellier, Roberts, WattLine
from mechwright_linkage.catalogue.wipers import Wiper
from mechwright_linkage.sketch.sketch import refuse_loose_driver, refuse_strangers
from mechwright_linkage.sketch.tables import GearTable, PointTable, SlideTable, Word

DRAWING = frozenset({"points", "scale", "links", "slides", "gears", "driver", "driver_on"})
"""Fields of a drawn linkage."""

LinkageName = Literal[
    "drawn",
    "watt-1",
    "watt-2",
    "stephenson-1",
    "stephenson-2",
    "stephenson-3",
    "whitworth",
    "crank-shaper",
    "scotch-yoke",
    "pantograph",
    "parallel-guide",
    "peaucellier",
    "hoecken",
    "chebyshev",
    "roberts",
    "watt-line",
    "jansen",
    "klann",
    "toggle-press",
    "wiper",
    "scissor-lift",
]


def dimensions(chosen: Entry | type[Entry], name: str = "") -> Any:
    """The field of a table with the dimensions of an entry; ``name`` of one that is not in the catalogue."""
    entry = chosen() if isinstance(chosen, type) else chosen
    name = name or next(name for name, kind in ENTRIES.items() if kind is type(entry))
    return Field(entry, description=f'Dimensions for linkage = "{name}".', json_schema_extra=FIRST)


class LoadTable(Parameters):
    """What pushes and turns a link from outside, all along."""

    link: Word = Field("", description="The link that it acts on.")
    point: Word = Field("", description="The point of the link at which the force acts. Default: its first.")
    force_x: Annotated[float, Field(ge=-1e5, le=1e5), Unit("N")] = Field(0.0, description="Force along X.")
    force_y: Annotated[float, Field(ge=-1e5, le=1e5), Unit("N")] = Field(0.0, description="Force along Y.")
    torque: Annotated[float, Field(ge=-1e4, le=1e4), Unit("N*m")] = Field(
        0.0, description="Torque, counter-clockwise."
    )


class SpringTable(Parameters):
    """A tension or compression spring between points of two links."""

    link: Word = Field("", description="One link.")
    point: Word = Field("", description="The point of it.")
    on: Word = Field(GROUND, description="The other link, or the ground.")
    on_point: Word = Field("", description="The point of that.")
    rate: Annotated[float, Field(ge=0, le=1e5), Unit("N/mm")] = Field(0.0, description="Spring rate.")
    free_length: Millimetres = Field(0.0, ge=0, le=5000, description="Length at which it bears nothing.")

    @property
    def ends(self) -> tuple[tuple[str, str], tuple[str, str]]:
        """Link and point of both ends."""
        return (self.link, self.point), (self.on, self.on_point)


class LinkageParams(Parameters):
    """Links, pins and slides in a plane, made of plates; from the catalogue, or as they are drawn.

    A class that derives from it with another Literal as ``linkage`` has the linkages of these names alone:
    it loses the tables of all others, and the fields of drawn ones.

    Examples
    --------
    >>> LinkageParams(linkage="jansen").entry.m
    15.0
    """

    also: ClassVar[Mapping[str, str]] = {
        "joints": "a point that several links name is their pin; slides has the slides",
        "bars": "they are called links",
        "input": "the link that moves the others is called driver",
        "crank": "in a catalogue linkage it stands in the table of that linkage; drawn, links has it",
    }

    linkage: LinkageName = Field(
        "jansen",
        description="A linkage of the catalogue, whose dimensions stand in the table of its name; or drawn, "
        "by points and links.",
        json_schema_extra=FIRST,
    )
    watt_1: WattOne = dimensions(WattOne())
    watt_2: WattTwo = dimensions(WattTwo())
    stephenson_1: StephensonOne = dimensions(StephensonOne())
    stephenson_2: StephensonTwo = dimensions(StephensonTwo())
    stephenson_3: StephensonThree = dimensions(StephensonThree())
    whitworth: Whitworth = dimensions(Whitworth())
    crank_shaper: CrankShaper = dimensions(CrankShaper())
    scotch_yoke: ScotchYoke = dimensions(ScotchYoke())
    pantograph: Pantograph = dimensions(Pantograph())
    parallel_guide: ParallelGuide = dimensions(ParallelGuide())
    peaucellier: Peaucellier = dimensions(Peaucellier())
    hoecken: Hoecken = dimensions(Hoecken())
    chebyshev: Chebyshev = dimensions(Chebyshev())
    roberts: Roberts = dimensions(Roberts())
    watt_line: WattLine = dimensions(WattLine())
    jansen: Jansen = dimensions(Jansen())
    klann: Klann = dimensions(Klann())
    toggle_press: TogglePress = dimensions(TogglePress())
    wiper: Wiper = dimensions(Wiper())
    scissor_lift: ScissorLift = dimensions(ScissorLift())
    points: dict[str, PointTable] = Field(
        default_factory=dict,
        description="Points of a drawn linkage in one position, as A = { x = 30, y = 0 }.",
    )
    scale: Annotated[float, Field(ge=0.001, le=1000), Unit("")] = Field(
        1.0, description="Size of a drawn linkage over that of the drawing."
    )
    links: dict[str, tuple[Word, ...]] = Field(
        default_factory=dict,
        description='Links of a drawn linkage by their points, as { ground = ["A0", "B0"], crank = ["A0", '
        '"A"] }; a point of two links is their pin.',
    )
    slides: tuple[SlideTable, ...] = Field((), max_length=8, description="Slides of a drawn linkage.")
    gears: tuple[GearTable, ...] = Field((), max_length=8, description="Gear pairs of a drawn linkage.")
    driver: Word = Field(
        "", description="The link of a drawn linkage that the input moves. Default: the one called crank."
    )
    driver_on: Word = Field(GROUND, description="The link against which the driver moves.")
    output: Word = Field(
        "", description="The link that the linkage is for. Default: that of the catalogue, or the last one."
    )
    pairs: Annotated[tuple[tuple[Word, Word], ...], Field(max_length=8)] = Field(
        (),
        description='Pairs of links whose acceleration poles are wanted, as [["coupler", "ground"]]: of the '
        "first as seen from the second. Default: of the output seen from the ground, or of another link if "
        "the output is joined to the ground.",
    )
    speed: fields.Speed = 60.0
    direction: fields.Direction = "ccw"
    swing_from: fields.SwingFrom = None
    swing_to: fields.SwingTo = None
    stroke_from: Annotated[float, Field(ge=-5000, le=5000), Unit("mm")] | None = Field(
        None,
        description="One end of the stroke of a driver that slides, from where it is drawn. Default: it "
        "goes as far as it can.",
    )
    stroke_to: Annotated[float, Field(ge=-5000, le=5000), Unit("mm")] | None = Field(
        None, description="The other end of that stroke."
    )
    loads: tuple[LoadTable, ...] = Field((), max_length=16, description="Forces and torques on links.")
    springs: tuple[SpringTable, ...] = Field((), max_length=16, description="Springs between links.")
    gravity_x: Annotated[float, Field(ge=-100, le=100), Unit("m/s^2")] = Field(
        0.0, description="Acceleration of free fall along X; 0 for a machine that lies flat."
    )
    gravity_y: Annotated[float, Field(ge=-100, le=100), Unit("m/s^2")] = Field(
        0.0, description="Gravity along Y: -9.81 for a machine that stands upright."
    )
    thickness: Millimetres = Field(
        6.0, ge=1, le=100, description="Of the moving links.", json_schema_extra=FIRST
    )
    ground_thickness: fields.GroundThickness = 8.0
    pin_diameter: Millimetres = Field(
        6.0, ge=1, le=200, description="Of the pins of all joints.", json_schema_extra=FIRST
    )
    bushing_wall: Millimetres = Field(
        1.0, ge=0, le=50, description="Wall of the plain bushings in the turning joints, 0 for none."
    )
    running_fit: fields.RunningFit = 0.03
    rim: Millimetres = Field(
        4.0, ge=0.5, le=100, description="Material of the plates around bores and slots."
    )
    web_width: Millimetres = Field(
        10.0, ge=1, le=500, description="Width of straight links between their bosses."
    )
    guide_length: Millimetres = Field(
        30.0, ge=2, le=1000, description="Distance of the two pins by which a plate slides in its slot."
    )
    clearance: fields.Clearance = 1.0
    washer: fields.Washer = 0.5
    frame: Literal["auto", "one", "two"] = Field(
        "auto",
        description="Ground plates: one below the links, two with the links between, or one where that goes.",
    )
    screw_hole: Annotated[float, Field(ge=1, le=200), Unit("mm")] | None = Field(
        None, description="Diameter of the holes in the corners of the ground plates. Default: of the pins."
    )
    screw_offset: Annotated[float, Field(ge=1, le=10000), Unit("mm")] | None = Field(
        None,
        description="Least distance of these holes from the outermost ground pivot across the plate. "
        "Default: as near as the bores leave room.",
    )
    material: MaterialName = Field("aluminium", description="Of the plates.", json_schema_extra=FIRST)

    @classmethod
    def __pydantic_init_subclass__(cls, **_: Any) -> None:
        """Remove the fields of linkages that a derived class does not name; the code reads their defaults."""
        fields = cls.__pydantic_fields__
        names = get_args(fields["linkage"].annotation)
        own = {name.replace("-", "_") for name in names}
        others = {name for name, field in fields.items() if isinstance(field.default, Entry)} - own
        if "drawn" not in names:
            others |= DRAWING
            if not any(_slides(kind()) for kind in cls.entries().values()):
                others |= {"stroke_from", "stroke_to"}
        for name in others & fields.keys():
            setattr(cls, name, fields.pop(name).get_default(call_default_factory=True))
        cls.also = cls.__dict__.get("also", {})
        cls.model_rebuild(force=True)

    @classmethod
    def entries(cls) -> Mapping[str, type[Entry]]:
        """Name of each linkage that is not drawn to its class."""
        fields = cls.model_fields
        names = [name for name in get_args(fields["linkage"].annotation) if name != "drawn"]
        return {name: type(fields[name.replace("-", "_")].default) for name in names}

    def __hash__(self) -> int:
        own = tuple(self.links) if self.linkage == "drawn" else tuple(self.entry.__dict__.values())
        return hash((self.linkage, own, self.speed, self.pin_diameter, self.thickness, self.frame))

    @model_validator(mode="after")
    def _together(self) -> Self:
        drawn = [name for name in ("points", "links", "slides", "gears") if getattr(self, name)]
        if self.linkage != "drawn" and drawn:
            raise ValueError(
                f'{drawn[0]}: it is of a drawn linkage; set linkage = "drawn", or leave {drawn[0]} out'
            )
        self._refuse_other_tables()
        if self.linkage == "drawn":
            refuse_strangers(self.points, self.links, self.slides, self.gears)
        elif self.scale != 1:
            raise ValueError("scale: it is of a drawn linkage; change the dimensions, or leave scale out")
        self._refuse_names()
        fields.swing_together(self.swing_from, self.swing_to, self.direction)
        if (self.stroke_from is None) != (self.stroke_to is None):
            raise ValueError("give both stroke_from and stroke_to, or neither")
        if self.stroke_from is not None and self.stroke_from == self.stroke_to:
            raise ValueError("stroke_from and stroke_to are the same, so nothing moves; give two")
        return self

    def _refuse_other_tables(self) -> None:
        """Refuse dimensions of a linkage that is not chosen."""
        for name in self.model_fields_set - {self.table_name}:
            default = type(self).model_fields[name].default
            if isinstance(default, Entry) and getattr(self, name) != default:
                chosen = name.replace("_", "-")
                raise ValueError(
                    f'{name}: it is of linkage = "{chosen}", not of "{self.linkage}"; leave {name} out'
                )

    def _refuse_names(self) -> None:
        """Refuse links and points that other keys name and that are not there."""
        points = self.link_points
        moving = [link for link in points if link != GROUND]
        asked: list[tuple[str, str, Sequence[str]]] = [("output", self.output, moving)]
        if self.linkage == "drawn":
            asked += [("driver", self.driver or "crank", moving), ("driver_on", self.driver_on, list(points))]
            refuse_loose_driver(*self.driver_links, self.links, self.slides)
        elif self.driver or self.driver_on != GROUND:
            raise ValueError("driver: a linkage of the catalogue has its own; leave driver and driver_on out")
        asked += [("pairs", link, list(points)) for pair in self.pairs for link in pair]
        asked += [("loads", load.link or "?", moving) for load in self.loads]
        asked += [
            ("springs", link or "?", list(points)) for spring in self.springs for link, _ in spring.ends
        ]
        for key, link, known in asked:
            if link and link not in known:
                raise ValueError(f"{key}: no link is called {link!r}; there are {', '.join(known)}")
        for one, two in self.pairs:
            if one == two:
                raise ValueError(f"pairs: {one} does not move relative to itself; name two links")
        stated = [("loads", load.link, load.point) for load in self.loads if load.point]
        stated += [("springs", *one) for spring in self.springs for one in spring.ends]
        for key, link, point in stated:
            if point not in points[link]:
                raise ValueError(f"{key}: {link} has no point {point!r}; it has {', '.join(points[link])}")

    def unused_fields(self) -> Collection[str]:
        """The tables of the other linkages; and drawings of one of the catalogue."""
        others = {name.replace("-", "_") for name in self.entries()} - {self.table_name}
        return others if self.linkage == "drawn" else others | DRAWING

    @property
    def entry(self) -> Entry:
        """The linkage of the catalogue with its dimensions; raises AttributeError of one that is drawn."""
        found: Entry = getattr(self, self.table_name)
        return found

    @property
    def table_name(self) -> str:
        """The key of the table with the dimensions: that of the linkage of the catalogue, else points."""
        return "points" if self.linkage == "drawn" else self.linkage.replace("-", "_")

    @property
    def link_points(self) -> Mapping[str, Sequence[str]]:
        """Link to the names of its points."""
        if self.linkage == "drawn":
            return self.links
        return {link: tuple(own) for link, own in self.entry.points().items()}

    @property
    def driver_links(self) -> tuple[str, str]:
        """The driver, and the link against which it moves."""
        if self.linkage == "drawn":
            return self.driver or "crank", self.driver_on
        drive = self.entry.drive()
        return drive.link, drive.on

    @property
    def output_link(self) -> str:
        """The link that the linkage is for."""
        if self.output or self.linkage != "drawn":
            return self.output or self.entry.output
        return [link for link in self.links if link != GROUND][-1]

    @property
    def pole_pairs(self) -> tuple[tuple[str, str], ...]:
        """The pairs of links whose poles are wanted."""
        return self.pairs or ((self.free_link, GROUND),)

    @property
    def free_link(self) -> str:
        """The output; of an output that is joined to the ground the last link of two points that is not."""
        points = self.link_points
        free = [link for link in points if len(points[link]) > 1 and not self._on_ground(link)]
        return self.output_link if self.output_link in free or not free else free[-1]

    def _on_ground(self, link: str) -> bool:
        """Whether a pin or a slide joins a link to the ground."""
        points = self.link_points
        if link == GROUND:
            return True
        slides = self.slides if self.linkage == "drawn" else self.entry.slides()
        sliding = any({link, GROUND} == {one.block, one.guide} for one in slides)
        return sliding or bool(set(points[link]) & set(points[GROUND]))


def _slides(entry: Entry) -> bool:
    """Whether the driver of a linkage slides."""
    drive = {entry.drive().link, entry.drive().on}
    return any(isinstance(one, Prismatic) and set(one.links) == drive for one in entry.joints())


def replaced(params: LinkageParams, **changes: Any) -> LinkageParams:
    """The same design with other values, which are not validated."""
    return params.model_copy(update=changes)
