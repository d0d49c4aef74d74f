"""Workpiece materials: the one place that knows their densities and elastic constants, and how they are cut.

The cutting figures are ranges for starting values, rounded from what workshop handbooks and makers of solid
carbide cutters commonly print for each group (mean of several, no single maker): unalloyed steel of about
600 N/mm², wrought aluminium, free-cutting brass, acetal copolymer. Speeds of high-speed steel are a third of
those of carbide. The specific cutting force is Kienzle's, k_c = k_c1.1 h^-m with h in mm. Books differ by
15 %, and a worn edge takes up to 30 % more:

* aluminium: N1 of the tool makers' tables, Sandvik and Walter, 600 to 700 and 0.25;
* brass: CuZn37 in Tschätsch, Praxis der Zerspantechnik (free-cutting CuZn39Pb3 takes 550, with 0.25);
* steel: S235JR in the same book (C45 takes 2220, with 0.14);
* acetal: no source agrees with another; 100 to 200 are named, so this is an upper bound;
* polycarbonate: cut as acetal, with a sharp edge and air;
* acrylic, polyethylene, plywood, fibreboard: estimates from settings that makers of routers publish.

What a cutter's maker says of it counts more than any of this.

A design file names a group, ``"aluminium"``, or a grade of it, ``"7075"``. A group is ordered in its usual
grade. A grade has a strength and a density of its own, and is cut as its group, stainless steel more slowly.
A shop file may add materials of its own: see :mod:`mechwright.contracts.own_materials`.

Glossary
--------
group
    Materials that are cut with the same data: each is its own group, a grade is of that of its base.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated, Literal, TypeVar

from pydantic import AfterValidator, Field

from mechwright.errors import DesignError

T = TypeVar("T")

Kind = Literal["wood", "plastic", "soft metal", "steel"]
"""By which small machines choose their chips."""


@dataclass(frozen=True, slots=True)
class Grades:
    """Designations by which a material is ordered: of plates and of round bars, and what is sold in the US.

    They are those whose strength :class:`Material` and :mod:`mechwright.mechanics.strength.allowed` have.
    """

    plate: str
    bar: str
    us_plate: str
    us_bar: str


@dataclass(frozen=True, slots=True)
class Material:
    """A workpiece material.

    Parameters
    ----------
    name
        As design files say it.
    group
        Whose cutting data and sold sizes it has where none are its own.
    density
        g/cm³.
    modulus
        Young's modulus, MPa.
    poisson
        Poisson's ratio.
    strength
        Yield or proof strength of the usual grade, MPa.
    speed
        Lowest and highest usual cutting speed of solid carbide, m/min.
    chip_share
        Lowest and highest usual chip load of an end mill, in its diameters.
    force
        Specific cutting force of a chip 1 mm thick, N/mm² (k_c1.1).
    force_exponent
        By which the specific force grows as the chip gets thinner (m).
    expansion
        By how much a length grows by one kelvin, millionths of it.
    long_chips
        Whether chips of a drill do not break by themselves.
    grades
        What is ordered; handbook, unchecked.
    kind
        By which chips are estimated where a cutter has no data.
    melts
        Whether the least usual speed is the best: warm chips stick to the edge.
    advice
        A sentence for the setup sheets, about people or chips; empty where there is nothing to say.
    pace
        Cutting speed in that of its group.
    """

    name: str
    group: str
    density: float
    modulus: float
    poisson: float
    strength: float
    speed: tuple[float, float]
    chip_share: tuple[float, float]
    force: float
    force_exponent: float
    expansion: float
    long_chips: bool
    grades: Grades
    kind: Kind = "steel"
    melts: bool = False
    advice: str = ""
    pace: float = 1.0

    @property
    def soft(self) -> bool:
        """Whether it creeps or crushes under a head, and around what is pressed in."""
        return self.kind in {"plastic", "wood"}

    @property
    def unbroken(self) -> float:
        """How deep a drill goes at once, in diameters: from there on long chips have to be broken."""
        return UNBROKEN if self.long_chips else JAMS


UNBROKEN = 3.0
"""From this depth in diameters the chip of a drill has to be broken, where the material's does not break."""
JAMS = 5.0
"""From this depth in diameters chips of any kind jam, and the drill comes out of the hole after each peck."""

HSS_SPEED = 1 / 3
"""Cutting speed of high-speed steel in that of carbide: what both may be heated to."""

_GRADES = {
    "aluminium": Grades("EN AW-6082 T651", "EN AW-6082 T6", "6061-T651", "6061-T6"),
    "brass": Grades("CuZn39Pb3 (CW614N)", "CuZn39Pb3 (CW614N)", "C38500", "C36000"),
    "steel": Grades("S355J2+N (1.0577)", "C45+C (1.0503)", "ASTM A572 grade 50", "1045 cold drawn"),
    "pom": Grades("POM-C", "POM-C", "acetal copolymer", "acetal copolymer"),
    "polycarbonate": Grades("PC, clear", "PC, clear", "polycarbonate, clear", "polycarbonate, clear"),
    "acrylic": Grades("PMMA, cast", "PMMA, cast", "acrylic, cast", "acrylic, cast"),
    "hdpe": Grades("PE-HD 300", "PE-HD 300", "HDPE", "HDPE"),
    "plywood": Grades("birch plywood", "beech dowel rod", "baltic birch plywood", "hardwood dowel rod"),
    "mdf": Grades("MDF", "beech dowel rod", "MDF", "hardwood dowel rod"),
}

_DUST = "The dust harms the lungs: cut with extraction, and wear a mask of class P2."
_AIR = "Chips melt onto a dull edge: take a sharp cutter with one flute, and blow air on the cut."
_STATIC = "Adhesive tape does not hold it: use clamps or screws."

_Figures = tuple[float, float, float, float, tuple[float, float], tuple[float, float], float, float, float]


def _group(
    name: str, kind: Kind, figures: _Figures, *, long_chips: bool, melts: bool = False, advice: str = ""
) -> Material:
    """A group by density, modulus, Poisson's ratio, strength, speeds, chips, force, exponent, expansion."""
    return Material(
        name,
        name,
        *figures,
        long_chips=long_chips,
        grades=_GRADES[name],
        kind=kind,
        melts=melts,
        advice=advice,
    )


GROUPS = {
    one.name: one
    for one in (
        _group(
            "aluminium",
            "soft metal",
            (2.70, 70_000, 0.33, 250, (100, 500), (0.004, 0.015), 700, 0.25, 23.4),
            long_chips=True,
        ),
        _group(
            "brass",
            "soft metal",
            (8.50, 97_000, 0.34, 250, (80, 300), (0.003, 0.012), 780, 0.18, 21.0),
            long_chips=False,
        ),
        _group(
            "steel",
            "steel",
            (7.85, 210_000, 0.30, 355, (50, 160), (0.002, 0.008), 1780, 0.17, 11.5),
            long_chips=True,
        ),
        _group(
            "pom",
            "plastic",
            (1.41, 2_800, 0.35, 65, (100, 500), (0.005, 0.025), 200, 0.20, 110.0),
            long_chips=True,
        ),
        _group(
            "polycarbonate",
            "plastic",
            (1.20, 2_350, 0.38, 60, (100, 500), (0.005, 0.025), 200, 0.20, 65.0),
            long_chips=True,
            melts=True,
            advice=_AIR,
        ),
        _group(
            "acrylic",
            "plastic",
            (1.19, 3_100, 0.37, 70, (50, 300), (0.005, 0.03), 200, 0.20, 70.0),
            long_chips=True,
            melts=True,
            advice=_AIR,
        ),
        _group(
            "hdpe",
            "plastic",
            (0.95, 1_000, 0.42, 22, (150, 500), (0.005, 0.03), 100, 0.20, 150.0),
            long_chips=True,
            melts=True,
            advice=_STATIC,
        ),
        _group(
            "plywood",
            "wood",
            (0.65, 8_000, 0.30, 30, (100, 600), (0.005, 0.05), 50, 0.40, 8.0),
            long_chips=False,
            advice=_DUST,
        ),
        _group(
            "mdf",
            "wood",
            (0.75, 3_000, 0.25, 18, (100, 600), (0.005, 0.05), 40, 0.40, 10.0),
            long_chips=False,
            advice=_DUST,
        ),
    )
}
"""Materials that are cut alike, by name."""


def _grade(
    name: str, group: str, figures: tuple[float, float, float, float], grades: Grades, pace: float = 1.0
) -> Material:
    """A grade by density, modulus, strength and expansion."""
    density, modulus, strength, expansion = figures
    base = GROUPS[group]
    return replace(
        base,
        name=name,
        density=density,
        modulus=modulus,
        strength=strength,
        expansion=expansion,
        speed=(pace * base.speed[0], pace * base.speed[1]),
        grades=grades,
        pace=pace,
    )


_STAINLESS = 0.6
"""Cutting speed of stainless in that of unalloyed steel: handbooks have 60 to 90 for 80 to 130 m/min."""

MATERIALS = GROUPS | {
    one.name: one
    for one in (
        _grade(
            "5754",
            "aluminium",
            (2.67, 70_000, 80, 24.0),
            Grades("EN AW-5754 H111", "EN AW-5754 H112", "5052-H32", "5052-H32"),
        ),
        _grade("6082", "aluminium", (2.70, 70_000, 250, 23.4), _GRADES["aluminium"]),
        _grade(
            "7075",
            "aluminium",
            (2.81, 72_000, 450, 23.5),
            Grades("EN AW-7075 T651", "EN AW-7075 T6", "7075-T651", "7075-T6"),
        ),
        _grade(
            "5083",
            "aluminium",
            (2.66, 71_000, 115, 24.0),
            Grades("EN AW-5083 cast", "EN AW-5083 H112", "MIC-6", "5083-H112"),
        ),
        _grade(
            "S235",
            "steel",
            (7.85, 210_000, 235, 12.0),
            Grades("S235JR (1.0038)", "S235JRC+C (1.0122)", "ASTM A36", "1018 cold drawn"),
        ),
        _grade(
            "C45",
            "steel",
            (7.85, 210_000, 305, 11.5),
            Grades("C45+N (1.0503)", "C45+C (1.0503)", "1045 normalised", "1045 cold drawn"),
        ),
        _grade(
            "11SMn30",
            "steel",
            (7.85, 210_000, 375, 11.5),
            Grades("11SMn30+C (1.0715), flat", "11SMn30+C (1.0715)", "12L14 flat", "12L14 cold drawn"),
        ),
        _grade(
            "1.4301",
            "steel",
            (7.90, 200_000, 210, 16.0),
            Grades("1.4301 (X5CrNi18-10)", "1.4301 (X5CrNi18-10)", "304", "304"),
            _STAINLESS,
        ),
        _grade(
            "1.4305",
            "steel",
            (7.90, 200_000, 190, 16.0),
            Grades("1.4305 (X8CrNiS18-9)", "1.4305 (X8CrNiS18-9)", "303", "303"),
            _STAINLESS,
        ),
    )
}
"""All that a design file may name: groups, and grades of them. Handbook figures, right to 10 %, unchecked."""


def entry(table: Mapping[str, T], name: str) -> T | None:
    """What a table by material has of one: its own entry, or that of its group; None where it has neither.

    >>> entry({"aluminium": 1.5, "5754": 2.0}, "5754"), entry({"aluminium": 1.5}, "7075"), entry({}, "pom")
    (2.0, 1.5, None)
    """
    return table[name] if name in table else table.get(material(name).group)


_INSTEAD = "take pom or hdpe, or acrylic for a laser"
NEVER = {
    "pvc": f"its chips and dust give off hydrogen chloride when they get hot; {_INSTEAD}",
    "vinyl": f"it is PVC: its chips give off hydrogen chloride when they get hot; {_INSTEAD}",
}
"""Materials that nobody should cut, with the reason."""


def material(name: str) -> Material:
    """Look a material up; raises DesignError that lists the known ones, or says why one is not cut."""
    try:
        return MATERIALS[name]
    except KeyError:
        pass
    if (why := NEVER.get(name.casefold())) is not None:
        raise DesignError(f"material {name!r} is not cut: {why}")
    raise DesignError(f"material {name!r} is not known; one of: {', '.join(sorted(MATERIALS))}")


OWN_NAME = r"^[a-z0-9][a-z0-9_.-]{0,39}$"
"""Names of materials that a shop adds."""

MaterialName = Annotated[
    str,
    AfterValidator(lambda name: material(name).name),
    Field(json_schema_extra={"enum": sorted(MATERIALS), "others": OWN_NAME}),
]
"""A field of a design's table that names a material: one that is built in, or one of the shop's own."""

BuiltInMaterial = Annotated[
    str,
    AfterValidator(lambda name: material(name).name),
    Field(json_schema_extra={"enum": sorted(MATERIALS)}),
]
"""A field that names a material which is built in."""
