"""The keys of ``[tolerances]``, and the contributors that a family makes with them."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from mechwright.contracts.general_tolerances import Grade, general_angle, general_eccentricity, general_length
from mechwright.contracts.pairs import Pair, grade, pair_of
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.tolerances import Contributor, Distribution, Zone
from mechwright.errors import DesignError
from mechwright.tolerances import TOLERANCES
from mechwright.units import Degrees, Unit, convert

Plus = Annotated[float, Field(ge=0, le=10), Unit("mm")]
Angle = Annotated[float, Field(ge=0, le=10), Unit("deg")]
Position = Annotated[float, Field(ge=-720, le=720), Unit("deg")]
Bound = Annotated[float, Field(gt=0, le=1000), Unit("mm")]


def _fit(text: str) -> str:
    """Refuse what is no fit, whatever the size."""
    try:
        pair_of(1.0, text)
    except DesignError as error:
        raise ValueError(str(error).removeprefix(f"{text!r} ")) from error
    return text


FitName = Annotated[str, Field(max_length=20), AfterValidator(_fit)]
Quantity = float | str
"""A number in the contributor's own unit, mm or degrees, or a text with a unit."""

MOST_SAMPLES = 10_000_000
"""Mechanisms of one Monte Carlo: ten millions tell a yield of 99.99 % to 0.0006 %, and take half a minute."""


class ToleranceSettings(Parameters):
    """The table ``[tolerances]``; what single contributors have of their own is in ``[tolerances.of]``."""

    general: Literal["proof", "process", "fine", "medium", "coarse"] = Field(
        "proof",
        description=(
            "Of dimensions without a tolerance of their own: what the proof of a program lets pass, what the "
            "process of the plates holds, or ISO 2768-1 f, m, c. Default: process where plates are cut or "
            "printed, else proof."
        ),
    )
    length: Plus | None = Field(None, description="Of all lengths, plus and minus. Default: general.")
    angle: Angle | None = Field(
        None,
        description="Of all angles of links, plus and minus. Default: general; fine where general is proof.",
    )
    centre: Plus | None = Field(
        None, description="Of distances between axes, plus and minus. Default: general."
    )
    eccentricity: Plus | None = Field(
        None, description="Of a profile to its bore, half the run-out. Default: general."
    )
    gouge: Annotated[float, Field(ge=0, le=1), Unit("mm")] = Field(
        TOLERANCES.gouge, description="Deepest cut into a wall: what the proof lets pass."
    )
    leftover: Annotated[float, Field(ge=0, le=1), Unit("mm")] = Field(
        TOLERANCES.leftover, description="Thickest stock left on a wall: what the proof lets pass."
    )
    input: Degrees = Field(0.0, ge=0, le=10, description="Of the input angle, plus and minus.")
    fit: FitName | None = Field(
        None, description='ISO 286 fit of all pins, such as "H7/g6". Default: the design\'s.'
    )
    clearance: Annotated[float, Field(ge=0, le=5), Unit("mm")] | None = Field(
        None, description="Clearance of all pins, on the diameter, the same in each; in the place of a fit."
    )
    contact: Literal["any", "loaded"] = Field(
        "any", description="Where pins lie in their holes: anywhere, or pressed along the link they join."
    )
    distribution: Distribution = Field(
        "normal", description="Within the tolerances; normal is cut off at 3 sigma."
    )
    at: Annotated[tuple[Position, ...], Field(max_length=12)] = Field(
        (), description="Input angles at which mechanisms are tried; none for the worst ones."
    )
    limit_angle: Annotated[float, Field(gt=0, le=180), Unit("deg")] | None = Field(
        None, description="Allowed error of angles, for the yield. Default: no yield."
    )
    limit_length: Bound | None = Field(
        None, description="Allowed error of lengths and points, for the yield. Default: no yield."
    )
    samples: int = Field(
        100_000, ge=100, le=MOST_SAMPLES, description="Mechanisms that are made and tried at random."
    )
    seed: int = Field(1, ge=0, le=4_294_967_295, description="Of the random numbers.")


class OwnTolerance(Parameters):
    """A table ``[tolerances.of.NAME]``: limits of one contributor, or the fit of one pin."""

    lower: Quantity | None = Field(None, description="Least deviation, or least clearance of a pin.")
    upper: Quantity | None = Field(None, description="Greatest deviation, or greatest clearance of a pin.")
    fit: FitName | None = Field(None, description="ISO 286 fit of a pin.")
    distribution: Distribution | None = Field(None, description="Within these limits.")


@dataclass(frozen=True)
class Tolerances:
    """What a design file says of tolerances; makes the contributors of a family.

    Parameters
    ----------
    settings
        The table ``[tolerances]``.
    own
        Name of a contributor to its own table.

    Examples
    --------
    >>> crank = Tolerances().length("crank", 30.0)
    >>> crank.lower, crank.upper
    (-0.015, 0.015)
    """

    settings: ToleranceSettings = field(default_factory=ToleranceSettings)
    own: Mapping[str, OwnTolerance] = field(default_factory=dict)

    def length(self, name: str, nominal: float) -> Contributor:
        """A length between two holes, or a place on a part, mm."""
        given = self.settings.length
        if given is not None:
            return self._size(name, "mm", nominal, given, "length")
        return self._apart(name, nominal)

    def centre(self, name: str, nominal: float) -> Contributor:
        """A distance between two axes, mm."""
        given = self.settings.centre
        if given is not None:
            return self._size(name, "mm", nominal, given, "centre")
        return self._apart(name, nominal)

    def _apart(self, name: str, nominal: float) -> Contributor:
        grade = self.grade
        if grade is None:
            return self._size(name, "mm", nominal, 2 * self._off_middle, "general", "gouge", "leftover")
        return self._size(name, "mm", nominal, general_length(nominal, grade), "general")

    @property
    def grade(self) -> Grade | None:
        """The class of ISO 2768 for dimensions without a tolerance; None where walls bound them."""
        general = self.settings.general
        return None if general in {"proof", "process"} else general  # type: ignore[return-value]

    def angle(self, name: str, nominal: float, leg: float) -> Contributor:
        """An angle of a link whose shorter leg is ``leg`` mm; rad."""
        given = self.settings.angle
        if given is not None:
            return self._size(name, "rad", nominal, math.radians(given), "angle")
        return self._size(name, "rad", nominal, general_angle(leg, self.grade or "fine"), "general")

    def input(self, name: str) -> tuple[Contributor, ...]:
        """The setting of the input angle, rad; none where it is exact."""
        given = self.settings.input
        if given == 0 and name not in self.own:
            return ()
        return (self._size(name, "rad", 0.0, math.radians(given), "input"),)

    def wall(self, name: str) -> Contributor:
        """Stock left on a milled wall, mm; below 0 it is cut too deep."""
        settings = self.settings
        zone = Zone(-settings.gouge, settings.leftover, settings.distribution)
        return self._owned(Contributor(name, "gouge leftover distribution", "mm", 0.0, (zone,)))

    def eccentricity(self, name: str) -> Contributor:
        """Where a profile stands to its bore: anywhere in a circle, mm."""
        settings = self.settings
        if settings.eccentricity is not None:
            radius, key = settings.eccentricity, "eccentricity"
        elif self.grade is None:
            radius, key = self._off_middle, "general gouge leftover"
        else:
            radius, key = general_eccentricity(self.grade), "general"
        zone = Zone(0.0, 2 * radius, settings.distribution)
        return self._owned(Contributor(name, f"{key} distribution", "mm", 0.0, (zone,), 2))

    def pin(
        self,
        name: str,
        diameter: float,
        own: float | str,
        *,
        member: bool = False,
        joint: str = "",  # noqa: ARG002 - for tolerances that know what was made of a joint
    ) -> Contributor:
        """A pin that turns in a hole, mm.

        Parameters
        ----------
        name
            Of the joint.
        diameter
            Basic size.
        own
            The design's own: the mean clearance, on the diameter, made with a hole of IT 7 and a pin of IT 6;
            or a fit.
        member
            Whether it is a joint of a link that is pressed or pulled along itself, and at no other place.
        joint
            Name of the motion's joint, for parts as measured. Default: ``name``.

        Raises
        ------
        DesignError
            What the design file asks is no fit, or one in which a pin may jam.
        """
        settings, mine = self.settings, self.own.get(name)
        directions: Literal[1, 2] = 1 if settings.contact == "loaded" and member else 2
        contact = " contact" if member else ""
        if mine is not None and mine.fit is not None:
            pair, key = self._running(mine.fit, diameter, f"tolerances.of.{name}.fit"), "distribution"
        elif settings.clearance is not None:
            exact = Contributor(name, "clearance" + contact, "mm", settings.clearance, (), directions)
            return self._owned(exact)
        elif settings.fit is not None:
            pair, key = self._running(settings.fit, diameter, "tolerances.fit"), "fit distribution"
        elif isinstance(own, str):
            pair, key = pair_of(diameter, own), "distribution"
        else:
            hole, shaft = grade(diameter, 7) / 2, grade(diameter, 6) / 2
            pair, key = Pair((own - hole, own + hole), (-shaft, shaft)), "distribution"
        distribution = mine.distribution if mine and mine.distribution else settings.distribution
        zones = (Zone(*pair.hole, distribution), Zone(-pair.shaft[1], -pair.shaft[0], distribution))
        return self._owned(Contributor(name, key + contact, "mm", 0.0, zones, directions))

    def gap(self, name: str, nominal: float, walls: int) -> Contributor:
        """What stands between two walls with a clearance of ``nominal`` mm, of which ``walls`` are milled."""
        settings = self.settings
        zone = Zone(-settings.leftover, settings.gouge, settings.distribution)
        key = "gouge leftover distribution"
        return self._owned(Contributor(name, key, "mm", nominal, (zone,) * walls, 1))

    @property
    def _off_middle(self) -> float:
        """By how much the middle of a hole may be off: one side too deep, the other not cut enough."""
        return (self.settings.gouge + self.settings.leftover) / 2

    def _size(self, name: str, unit: str, nominal: float, half: float, *keys: str) -> Contributor:
        zone = Zone(-half, half, self.settings.distribution)
        return self._owned(Contributor(name, " ".join((*keys, "distribution")), unit, nominal, (zone,)))

    def _running(self, text: str, diameter: float, where: str) -> Pair:
        try:
            pair = pair_of(diameter, text)
        except DesignError as error:
            raise DesignError(f"{where}: {error}") from error
        if pair.least < 0:
            raise DesignError(
                f"{where}: {diameter:g} {text} has a clearance of {pair.least:g} to {pair.greatest:g} mm, so "
                "a pin that has to turn may jam; use f7, g6 or h6 in H7"
            )
        return pair

    def _owned(self, usual: Contributor) -> Contributor:
        """The contributor with the limits of its own table, if it has one."""
        mine = self.own.get(usual.name)
        if mine is None:
            return usual
        where = f"tolerances.of.{usual.name}"
        if mine.fit is not None and usual.directions != 2 and "contact" not in usual.key:
            raise DesignError(f"{where}.fit: it is no pin in a hole; give lower and upper")
        if mine.lower is None and mine.upper is None:
            if mine.distribution is None:
                return usual
            zones = tuple(Zone(zone.lower, zone.upper, mine.distribution) for zone in usual.zones)
            return Contributor(
                usual.name,
                usual.key.replace("distribution", ""),
                usual.unit,
                usual.nominal,
                zones,
                usual.directions,
            )
        if mine.lower is None or mine.upper is None:
            raise DesignError(f"{where}: give both lower and upper")
        if mine.fit is not None:
            raise DesignError(f"{where}: give a fit, or lower and upper")
        lower, upper = (
            _read(value, usual.unit, f"{where}.{key}")
            for key, value in (("lower", mine.lower), ("upper", mine.upper))
        )
        if lower > upper:
            raise DesignError(f"{where}: lower is above upper; exchange them")
        if usual.directions and lower < 0:
            raise DesignError(f"{where}.lower: {mine.lower} is below 0, and so no clearance; give 0 or more")
        zone = Zone(lower, upper, mine.distribution or self.settings.distribution)
        key = ("" if mine.distribution else "distribution") + (" contact" if "contact" in usual.key else "")
        nominal = 0.0 if usual.directions else usual.nominal
        return Contributor(usual.name, key, usual.unit, nominal, (zone,), usual.directions)


def _read(value: Quantity, unit: str, where: str) -> float:
    """A limit in mm or rad."""
    try:
        number = convert(str(value), "deg" if unit == "rad" else unit)
    except ValueError as error:
        raise DesignError(f"{where}: {error}") from error
    return math.radians(number) if unit == "rad" else number
