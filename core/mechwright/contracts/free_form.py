"""A part of free form: a body that the CAD kernel makes, round holes in it, and the sizes on its drawing.

Solid, fits and drawing come from the same holes, so each hole is declared once.

Glossary
--------
free form
    Neither a plate nor a turned part: a link whose bores point at one centre, a casting.
process
    How the part can be made, in a few words; it stands on the drawing and in the bill of materials.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from mechwright.contracts.fits import Fit
from mechwright.contracts.guard import later
from mechwright.contracts.joint import UNIT, Vector
from mechwright.errors import GeometryError

if TYPE_CHECKING:
    import cadquery as cq


@dataclass(frozen=True)
class FormBore:
    """A round hole all through a wall, of any direction.

    Parameters
    ----------
    name
        Of the hole in its part.
    start
        Where its axis enters the material, mm.
    axis
        Unit vector along which it goes on from there.
    length
        Of its wall, mm. The cutter goes ``over`` further at both ends.
    diameter
        mm; with a ``fit`` the middle of its limits.
    over
        mm.

    Raises
    ------
    GeometryError
        The axis is no unit vector, or a size is not above 0 mm.
    """

    name: str
    start: Vector
    axis: Vector
    length: float
    diameter: float
    fit: Fit | None = None
    over: float = 1.0

    def __post_init__(self) -> None:
        if not abs(math.hypot(*self.axis) - 1) < UNIT:
            raise GeometryError(f"bore {self.name}: its axis {self.axis} has a length other than 1")
        if not (self.length > 0 and self.diameter > 0 and self.over >= 0):
            raise GeometryError(
                f"bore {self.name}: {self.diameter:g} mm wide, {self.length:g} mm long; both are above 0"
            )

    @property
    def end(self) -> Vector:
        """Where its axis leaves the material, mm."""
        x, y, z = (a + self.length * b for a, b in zip(self.start, self.axis, strict=True))
        return x, y, z

    def cutter(self) -> "cq.Solid":
        """What it takes away; imports the CAD kernel."""
        import cadquery as cq

        foot = cq.Vector(*(a - self.over * b for a, b in zip(self.start, self.axis, strict=True)))
        return cq.Solid.makeCylinder(
            self.diameter / 2, self.length + 2 * self.over, foot, cq.Vector(*self.axis)
        )


@dataclass(frozen=True)
class AngleSize:
    """The angle between two unit vectors about a point, such as that between the axes of two bores."""

    centre: Vector
    first: Vector
    second: Vector

    @property
    def degrees(self) -> float:
        """0 to 180."""
        cosine = sum(a * b for a, b in zip(self.first, self.second, strict=True))
        x, y, z = (
            self.first[1] * self.second[2] - self.first[2] * self.second[1],
            self.first[2] * self.second[0] - self.first[0] * self.second[2],
            self.first[0] * self.second[1] - self.first[1] * self.second[0],
        )
        return math.degrees(math.atan2(math.hypot(x, y, z), cosine))


@dataclass(frozen=True)
class RadiusSize:
    """A radius about a centre, mm, pointed at in the direction of a unit vector.

    ``sphere`` says that the face is a sphere, ``flat`` that it is a plane so far away; else it is a cylinder.
    """

    centre: Vector
    radius: float
    towards: Vector
    sphere: bool = False
    flat: bool = False

    @property
    def text(self) -> str:
        """As a drawing notes it.

        >>> RadiusSize((0, 0, 0), 66.5, (1, 0, 0)).text
        'R66.5'
        >>> RadiusSize((0, 0, 0), 66, (1, 0, 0), sphere=True).text
        'SR66'
        """
        return f"{'' if self.flat else 'SR' if self.sphere else 'R'}{round(self.radius, 3):g}"


@dataclass(frozen=True)
class LengthSize:
    """The distance of two points, mm; a ``diameter`` if the part is round there."""

    first: Vector
    second: Vector
    diameter: bool = False

    @property
    def text(self) -> str:
        """As a drawing notes it.

        >>> LengthSize((0, 0, -7), (0, 0, 7), diameter=True).text
        '⌀14'
        """
        return f"{'⌀' if self.diameter else ''}{round(math.dist(self.first, self.second), 3):g}"


FormSize = AngleSize | RadiusSize | LengthSize


@dataclass(frozen=True)
class FreeForm:
    """What a part of free form looks like.

    Parameters
    ----------
    body
        Makes the solid without its bores; equal forms have equal ones.
    process
        How it can be made.
    bores
        What is cut into the body.
    sizes
        Sizes of the drawing beside those of the bores, in the part's coordinates.
    centre
        Whether all axes meet in the origin: the drawing then states the faces of bores by their distance from
        it.
    notes
        Lines more on its drawing.

    Raises
    ------
    GeometryError
        It has no process, two bores have one name, or, as it is made, they leave more than one piece.
    """

    body: "Callable[[], cq.Solid]"
    process: str
    bores: tuple[FormBore, ...] = ()
    sizes: tuple[FormSize, ...] = ()
    centre: bool = False
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not self.process:
            raise GeometryError("a part of free form states its process; give it in a few words")
        names = [one.name for one in self.bores]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise GeometryError(f"a part of free form has two bores {twice}; names of bores differ")
        object.__setattr__(self, "body", later(self.body, "the body of a part of free form"))

    def __call__(self) -> "cq.Solid":
        """The solid; imports the CAD kernel."""
        import cadquery as cq

        body = self.body()
        if not self.bores:
            return body
        found = body.cut(*(one.cutter() for one in self.bores)).Solids()
        if len(found) != 1 or not isinstance(found[0], cq.Solid):
            raise GeometryError(f"its bores leave {len(found)} pieces; make the part wider than they are")
        return found[0]

    def bore(self, name: str) -> FormBore:
        """That of a name; raises GeometryError where there is none."""
        for one in self.bores:
            if one.name == name:
                return one
        raise GeometryError(f"no bore {name}; bores: {', '.join(one.name for one in self.bores) or 'none'}")

    def with_fits(self, fits: "dict[str, Fit]") -> "FreeForm":
        """The same with limits of its bores, by name; each is made to the middle of its limits."""
        for name in fits:
            self.bore(name)
        made = (
            replace(one, fit=fits[one.name], diameter=fits[one.name].middle) if one.name in fits else one
            for one in self.bores
        )
        return replace(self, bores=tuple(made))

    @property
    def joined(self) -> "FreeForm":
        """The same with bores as wide as what is pressed into them."""
        wide = (
            replace(one, diameter=one.fit.size)
            if one.fit is not None and one.fit.size > one.diameter
            else one
            for one in self.bores
        )
        return replace(self, bores=tuple(wide))
