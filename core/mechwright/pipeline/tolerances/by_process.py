"""Tolerances of plates by the process that makes them, where the design does not say its own.

Lengths between holes, centre distances and eccentricities scatter by 0.6 of a size: they are the middle of
two walls each. A wall stands off by half of a size, and of the taper.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TypeVar

from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import Part
from mechwright.contracts.tolerance_settings import Tolerances, ToleranceSettings
from mechwright.contracts.tolerances import Contributor, Zone
from mechwright.mechanics.tolerance import Analysis, analyse
from mechwright.pipeline.build import Build
from mechwright.pipeline.process import Process, Spread, plates_of, process_of
from mechwright.pipeline.tolerances.table import TolerancesTable

MIDDLE = 0.6
"""Scatter of the middle of two walls in that of a size; handbook, unchecked."""
SPREAD_KEYS = ("length", "centre", "eccentricity", "gouge", "leftover")
"""Keys of ``[tolerances]`` that follow from a process."""

T = TypeVar("T", bound=Tolerances)


@dataclass(frozen=True)
class SpreadTolerances(Tolerances):
    """Tolerances of a design whose plates stray as a process has it.

    Parameters
    ----------
    play, scatter
        What a joint has besides its own play, on the diameter, and that plus and minus, mm.
    """

    play: float = 0.0
    scatter: float = 0.0

    def pin(
        self, name: str, diameter: float, own: float | str, *, member: bool = False, joint: str = ""
    ) -> Contributor:
        """A joint with the play of the holes around it."""
        found = super().pin(name, diameter, own, member=member, joint=joint)
        if not self.scatter:
            return found
        more = Zone(self.play - self.scatter, self.play + self.scatter, self.settings.distribution)
        return Contributor(
            found.name, found.key, found.unit, found.nominal, (*found.zones, more), found.directions
        )


def tolerances_of(build: Build) -> Tolerances:
    """What the design says of tolerances."""
    value: Tolerances = build.design.tables.get(TolerancesTable.name, Tolerances())
    return value


def worst_spread(spreads: Iterable[Spread | None]) -> Spread | None:
    """The worst of each figure; None where no plate strays.

    >>> worst_spread([None, Spread(0.1, play=0.2), Spread(0.05, taper=0.1)])
    Spread(size=0.1, taper=0.1, play=0.2, scatter=0.0)
    """
    known = [one for one in spreads if one is not None]
    if not known:
        return None
    return Spread(*(max(getattr(one, key) for one in known) for key in ("size", "taper", "play", "scatter")))


def spread_of(build: Build, part: Part) -> Spread | None:
    """How far a plate strays by the process that the design has chosen; None where a proof bounds it."""
    name = process_of(build.design, part.name)
    process = next((one for one in build.host.all(Process) if one.name == name), None)
    if process is None or process.refuses(part, build):
        return None
    return process.spread(part, build)


def with_spread(asked: Tolerances, spread: Spread, *, over: bool = False) -> SpreadTolerances:
    """Tolerances with what a process does in place of keys that the file leaves out.

    With ``over`` in place of all of them: a mechanism of parts that are made so, whatever was asked for.

    >>> found = with_spread(Tolerances(ToleranceSettings(centre=0.01)), Spread(0.1, taper=0.04))
    >>> found.settings.length, found.settings.centre, found.settings.gouge
    (0.06, 0.01, 0.07)
    """
    middle, wall = round(MIDDLE * spread.size, 6), round(spread.wall, 6)
    found: dict[str, float | None] = dict(zip(SPREAD_KEYS, (middle, middle, middle, wall, wall), strict=True))
    if over:
        found |= {"fit": None, "clearance": None}
    else:
        found = {key: value for key, value in found.items() if key not in asked.settings.model_fields_set}
    settings = asked.settings.model_copy(update=found)
    return SpreadTolerances(settings, {} if over else asked.own, spread.play, spread.scatter)


def tolerances_for(build: Build, parts: Iterable[Part]) -> Tolerances:
    """The tolerances of some plates: the design's own, those of their processes where it leaves them out."""
    asked = tolerances_of(build)
    said = asked.settings.general
    if said != "process" and "general" in asked.settings.model_fields_set:
        return asked
    spread = worst_spread(spread_of(build, part) for part in plates_of(parts))
    return asked if spread is None else with_spread(asked, spread)


def analysed(build: Build, tolerances: T, params: Parameters | None = None) -> Analysis | None:
    """The analysis with other tolerances, and other parameters; None where the family has none.

    Keys that follow from a process and on which nothing depends go back to their defaults.
    """
    family, params = build.design.family, build.design.params if params is None else params
    model = family.tolerances(params, tolerances)
    if model is None:
        return None
    used = {key for one in model.contributors for key in one.key.split()}
    fields = ToleranceSettings.model_fields
    changes = {key: fields[key].default for key in SPREAD_KEYS if key not in used}
    tolerances = replace(tolerances, settings=tolerances.settings.model_copy(update=changes))
    again = family.tolerances(params, tolerances)
    return None if again is None else analyse(again, tolerances)
