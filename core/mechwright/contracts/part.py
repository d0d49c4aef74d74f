"""Parts, and the features that machining sees on them.

Heights are measured downwards from the part's top face, so a feature that starts at the top and goes through
a 10 mm plate has ``top = 0`` and ``depth = 10``. The solid stands on z = 0 and reaches up to the thickness.
"""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, TypeGuard

from mechwright.contracts.bought import Bought
from mechwright.contracts.details import Detail
from mechwright.contracts.file_names import DEVICES
from mechwright.contracts.fits import Fit
from mechwright.contracts.fitting_marks import FittingMark
from mechwright.contracts.free_form import FreeForm
from mechwright.contracts.guard import later
from mechwright.contracts.measure import Measure
from mechwright.contracts.result import maker
from mechwright.contracts.shape import Shape
from mechwright.contracts.turned import Turned, limited
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry import Arc, Loop, Outline
from mechwright.geometry.segments import Point, Segment

if TYPE_CHECKING:
    import cadquery as cq

Colour = tuple[float, float, float]
NAME_PATTERN = r"[a-z0-9](?:[a-z0-9_-]{0,62}[a-z0-9])?"
"""What can be a file name anywhere."""

_NAME = re.compile(NAME_PATTERN)
_OTHER = re.compile(r"[^a-z0-9_]+")
_LONGEST = 64
"""Characters of a name, as the pattern above has it."""


def check_name(name: str, what: str = "name") -> str:
    """Give ``name`` back if it can be a file name anywhere, else raise DesignError.

    >>> check_name("gear-2")
    'gear-2'
    """
    if not _NAME.fullmatch(name):
        shown = (
            repr(name) if len(name) <= 2 * _LONGEST else f"{name[:_LONGEST]!r}... ({len(name):,} characters)"
        )
        raise DesignError(
            f"{what} {shown} cannot be a file name; use up to 64 of a-z, 0-9, - and _, "
            f'a letter or digit at both ends, such as "{name_from(name, "design")}"'
        )
    if name in DEVICES:
        raise DesignError(f"{what} {name!r} is that of a device on Windows; use another, such as {name}-1")
    return name


def name_from(text: str, usual: str) -> str:
    """The name that is next to a text, such as the stem of a file; ``usual`` where nothing of it may stand.

    >>> name_from("Pair m0.5 (steel)", "design"), name_from("\u9f7f", "design")
    ('pair-m0-5-steel', 'design')
    >>> name_from("AUX", "design")
    'aux-1'
    """
    name = _OTHER.sub("-", text.lower())[:_LONGEST].strip("-_") or usual
    return f"{name}-1" if name in DEVICES else name


@dataclass(frozen=True)
class Profile:
    """A wall through or into the plate, along a loop.

    ``side`` says where the cutter runs. ``tab_sites`` are points on the loop where a holding tab does least
    harm, mm, each with the longest tab that fits there; empty if any place will do.
    """

    name: str
    loop: Loop
    side: Literal["outside", "inside"]
    top: float
    depth: float
    tab_sites: tuple[tuple[Point, float], ...] = ()


def is_outside(feature: object) -> TypeGuard[Profile]:
    """Whether a feature is the rim of a part, around which everything else lies."""
    return isinstance(feature, Profile) and feature.side == "outside"


@dataclass(frozen=True)
class Bore:
    """A round hole.

    With a ``fit`` the diameter is the middle of its tolerance; drawing and program note its limits.
    ``depth_limits`` are the lower and the upper limit deviation of the depth of a blind one, mm. Without them
    its depth has the general tolerance.
    """

    name: str
    centre: Point
    diameter: float
    top: float
    depth: float
    fit: Fit | None = None
    depth_limits: tuple[float, float] | None = None

    @property
    def depth_text(self) -> str:
        """Depth with its limit deviations, as a drawing notes it.

        >>> Bore("seat", (0, 0), 22, 0, 7, None, (-0.025, 0.025)).depth_text
        '7 ±0.025'
        """
        if self.depth_limits is None:
            return f"{self.depth:g}"
        return limited(self.depth, *self.depth_limits)


@dataclass(frozen=True)
class Pocket:
    """A flat-bottomed recess inside ``boundary``, around ``islands``.

    A boundary that reaches beyond the plate's outline, or along it, is open there: the cutter runs out over
    the edge, and no wall stands. A groove across the rim is drawn a little longer than the plate. The recess
    of one level may lie in that of another: ``top`` is then the other's ``depth``.

    With a ``floor_radius``, mm, a fillet joins floor and walls: h above the floor the recess is narrower all
    round by r - √(r² - (r - h)²). A ball or a bull nose of this radius makes it.
    """

    name: str
    boundary: Loop
    islands: tuple[Loop, ...]
    top: float
    depth: float
    floor_radius: float = 0.0

    def __post_init__(self) -> None:
        if not 0 <= self.floor_radius <= self.depth:
            raise GeometryError(
                f"pocket {self.name}: the floor_radius is {self.floor_radius:g} mm, not 0 to its depth of "
                f"{self.depth:g} mm"
            )

    def inset(self, height: float) -> float:
        """How much narrower the recess is on every side at a height above its floor, mm."""
        short = max(self.floor_radius - max(height, 0.0), 0.0)
        return self.floor_radius - math.sqrt(self.floor_radius**2 - short**2)


@dataclass(frozen=True, kw_only=True)
class OpenProfile(Pocket):
    """A recess along an open path: a groove ``"on"`` it, or a step on its ``"left"`` or ``"right"``.

    What it takes follows from ``path`` and ``width``. A groove is the strip whose centre line is the path,
    with half circles at its ends, as a cutter of that width leaves it. A step is the strip between the path,
    where its wall stands, and the same moved sideways by the width; inside the plate it ends square.
    As for every recess, the strip is open where it reaches beyond the plate's outline, so the path of a step
    along an edge starts and ends outside.

    Raises
    ------
    GeometryError
        The path does not hang together, closes, or bends too sharply for the width.

    Examples
    --------
    >>> from mechwright.geometry import Line
    >>> path = (Line((0.0, 0.0), (20.0, 0.0)),)
    >>> groove = OpenProfile("groove", 0.0, 2.0, path=path, side="on", width=4.0)
    >>> round(groove.boundary.area, 3)
    92.566
    """

    boundary: Loop = field(init=False)
    islands: tuple[Loop, ...] = field(init=False, default=())
    path: tuple[Segment, ...]
    side: Literal["left", "right", "on"]
    width: float

    def __post_init__(self) -> None:
        from mechwright.geometry.strip import strip

        super().__post_init__()
        half = self.width / 2
        left, right = {"on": (half, half), "left": (self.width, 0.0), "right": (0.0, self.width)}[self.side]
        try:
            boundary = strip(self.path, left, right, "round" if self.side == "on" else "square")
        except GeometryError as error:
            raise GeometryError(f"{self.name}: {error}") from error
        object.__setattr__(self, "boundary", boundary)

    def moved(self, x: float, y: float, angle: float = 0.0) -> "OpenProfile":
        """The feature turned about the origin, rad, then shifted, mm."""
        return replace(self, path=tuple(segment.moved(x, y, angle) for segment in self.path))


Feature = Profile | Bore | Pocket


@dataclass(frozen=True)
class Instance:
    """One copy of a part.

    It belongs to a ``body`` of the motion, its underside stands at the height ``z``, mm, and its ``colour``
    is the part's unless it has one of its own.
    """

    body: str
    z: float = 0.0
    colour: Colour | None = None


@dataclass(frozen=True)
class Part:
    """A thing to make.

    Parameters
    ----------
    name
        Also the stem of its files.
    outline
        The plate seen from above, origin on the part's own axis; None for a part built as a solid.
    thickness
        mm; 0 for a part built as a solid.
    material
        A name of the material table: a group such as ``"aluminium"`` or ``"pom"``, or a grade such as
        ``"7075"``.
    instances
        Where copies stand in the mechanism.
    colour
        Red, green, blue, each 0 to 1.
    machined
        Features in the order of the drawing; empty means: those of the outline.
    build
        Makes the solid of a part that is no plate. Default: what ``turned``, ``bought`` or ``free_form`` has.
    details
        Chamfers, threads and engravings of a plate's top face.
    turned
        What a turned part looks like: it gets a drawing of it.
    bought
        What a part is ordered as that is not made.
    marks
        Signs that show how the part stands to its neighbours; the page of the assembly tells of them, and
        they are engraved on request.
    play
        By how much its copies may miss what they touch, or fill less of a hole than its length, mm: the
        clearance with which they are made to stand.
    vacant
        Names of its holes with a fit that may stay empty: places of a pin that is in one of them.
    measures
        Sizes that tell whether it is right, beside its overall sizes and its bores: they stand on the sheet.
    data
        Names and values of a table that its drawing has, such as those of its teeth.
    free_form
        What a part looks like that is neither a plate nor turned: it gets a drawing of it.

    Raises
    ------
    GeometryError
        It has no solid or more than one, a plate has no thickness, or it is two of turned, bought and of free
        form at once.
    """

    name: str
    outline: Outline | None
    thickness: float
    material: str
    instances: tuple[Instance, ...] = ()
    colour: Colour = (0.7, 0.7, 0.72)
    machined: tuple[Feature, ...] = ()
    build: "Callable[[], cq.Solid] | None" = None
    details: tuple[Detail, ...] = ()
    turned: Turned | None = None
    bought: Bought | None = None
    marks: tuple[FittingMark, ...] = ()
    play: float = 0.0
    vacant: tuple[str, ...] = ()
    measures: tuple[Measure, ...] = ()
    data: tuple[tuple[str, str], ...] = ()
    free_form: FreeForm | None = None

    def __post_init__(self) -> None:
        check_name(self.name, "part name")
        if sum(form is not None for form in (self.turned, self.bought, self.free_form)) > 1:
            raise GeometryError(f"part {self.name} is turned, bought or of free form, one of them alone")
        if self.free_form is not None:
            object.__setattr__(self, "build", self.free_form)
        elif self.outline is None and self.build is None:
            form = self.turned or self.bought
            if form is not None and form.shape is not None:
                object.__setattr__(self, "build", form.shape)
        elif isinstance(shape := getattr(self.build, "__self__", None), Shape):
            object.__setattr__(self, "build", shape)
        elif self.build is not None and not isinstance(self.build, Shape):
            object.__setattr__(self, "build", later(self.build, f"the solid of part {self.name!r}"))
        if (self.outline is None) == (self.build is None):
            raise GeometryError(f"part {self.name} has either an outline or a solid of its own")
        if self.outline is not None and not self.thickness > 0:
            raise GeometryError(f"part {self.name} needs a thickness above 0 mm, not {self.thickness}")

    def __repr__(self) -> str:
        copies = f", {len(self.instances)} copies" if len(self.instances) > 1 else ""
        size = f"{self.thickness:g} mm, " if self.outline is not None else ""
        return f"<Part {self.name}: {self.kind}, {size}{self.material}{copies}>"

    def _repr_html_(self) -> str:
        return self.picture

    def result(self, name: str) -> Any:
        """What a plugin makes of the part; raises PluginError where nobody does, see :class:`Result`."""
        return maker(self, name).make(self)

    @property
    def solid(self) -> "cq.Solid":
        """The solid, mm, of CadQuery: a plate stands on z = 0. It is made once.

        Raises GeometryError where it cannot be made, PluginError where nothing is installed that makes it.
        """
        solid: cq.Solid = self.result("solid")
        return solid

    @property
    def picture(self) -> str:
        """A drawing of it as SVG: a plate from above, else a view in space; raises as ``solid`` does."""
        drawn: str = self.result("picture")
        return drawn

    @cached_property
    def form(self) -> tuple[object, ...]:
        """What its solid depends on, and how it is ordered: equal for copies that stand elsewhere."""
        return (
            self.name,
            self.outline,
            self.thickness,
            self.machined,
            self.details,
            self.build,
            self.turned,
            self.bought,
            self.free_form,
        )

    @property
    def kind(self) -> Literal["plate", "turned", "bought", "solid"]:
        """How one comes by it: cut from a plate, turned, bought, or made by other means."""
        if self.bought is not None:
            return "bought"
        if self.turned is not None:
            return "turned"
        return "solid" if self.outline is None else "plate"

    @property
    def outlines(self) -> tuple[Outline, ...]:
        """What is cut free of the plate: the outline; of several parts on one plate, one each."""
        return () if self.outline is None else (self.outline,)

    @property
    def axes(self) -> tuple[Point, ...]:
        """Where the axes of :attr:`outlines` stand, mm."""
        return ((0.0, 0.0),)

    def colour_of(self, instance: Instance) -> Colour:
        """The colour that a copy of the part shows."""
        return self.colour if instance.colour is None else instance.colour

    @cached_property
    def features(self) -> tuple[Feature, ...]:
        """What machining has to cut: every loop once, openings first."""
        if self.machined or self.outline is None:
            return self.machined
        features: list[Feature] = []
        for number, loop in enumerate(self.outline.inner, start=1):
            segment = loop.segments[0]
            if loop.is_circle and isinstance(segment, Arc):
                features.append(Bore(f"bore-{number}", segment.centre, 2 * segment.radius, 0, self.thickness))
            else:
                features.append(Profile(f"opening-{number}", loop, "inside", 0, self.thickness))
        features.append(Profile("outside", self.outline.outer, "outside", 0, self.thickness))
        return tuple(features)
