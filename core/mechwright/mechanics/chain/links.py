"""The stages of a chain with their families, and what stands against joining them."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Change, Finding, Stage, errors
from mechwright.contracts.mounting import MountingError
from mechwright.contracts.parameters import Parameters, kept
from mechwright.contracts.transmission import Transmission
from mechwright.contracts.turning import Turning
from mechwright.errors import KinematicsError, MechwrightError, PluginFaultError
from mechwright.mechanics.chain.params import ChainParams, Families, StageTable
from mechwright.tolerances import exceeds

_SAMPLES = 1440
"""Of a turn of the chain's input, where the ends of a swing are sought: each a quarter of a degree."""

_ROUNDING = 1e-6
"""rad by which a swing may pass the end of a travel: far less than a tooth."""

MOST_TURNS = 60
"""Turns of the chain's input over which its stages come back: what a motion with 721 samples can show."""


@dataclass(frozen=True, eq=False)
class Link:
    """A stage that can be joined."""

    number: int
    family: Family[Any]
    table: StageTable
    transmission: Transmission

    @property
    def params(self) -> Parameters:
        """Of its family."""
        return self.table.parameters

    def named(self, name: str) -> str:
        """A part or body of the stage, as the chain has it."""
        return f"{self.number}-{name}"


def key_of(number: int, key: str) -> str:
    """The design-file key of a stage's key, which findings of families write without ``parameters``.

    >>> key_of(2, "bore"), key_of(1, "parameters.bore"), key_of(1, "")
    ('stage.2.parameters.bore', 'stage.1.parameters.bore', '')
    """
    return f"stage.{number}.parameters.{key.removeprefix('parameters.')}" if key else ""


def staged(number: int, family: Family[Any], finding: Finding) -> Finding:
    """A finding of a stage as one of the chain: its key, its changes and its words say which stage."""
    changes = tuple(
        {
            key_of(number, key) if key.startswith("parameters.") else key: value
            for key, value in change.items()
        }
        for change in finding.proposed
    )
    return replace(
        finding,
        parameter=key_of(number, finding.parameter),
        message=f"stage {number}, {family.name}: {finding.message}",
        proposed=changes,
    )


def pairs(params: ChainParams, families: Families) -> Iterator[tuple[int, Family[Any], StageTable]]:
    """Number, family and table of each stage."""
    for number, (family, table) in enumerate(zip(families, params.stage, strict=True), start=1):
        yield number, family, table


@kept
def links_of(params: ChainParams, families: Families) -> tuple[Link, ...]:
    """The stages of a chain that moves; raises KinematicsError with the first reason why it does not."""
    found, faults = _joined(params, families)
    for fault in faults:
        raise KinematicsError(f"{fault.parameter}: {fault.message}; {fault.remedy}")
    return found


@kept
def joining(params: ChainParams, families: Families) -> tuple[Finding, ...]:
    """What stands against joining the stages: errors of the motion."""
    return _joined(params, families)[1]


@kept
def _joined(params: ChainParams, families: Families) -> tuple[tuple[Link, ...], tuple[Finding, ...]]:
    found: list[Link] = []
    faults: list[Finding] = []
    for number, family, table in pairs(params, families):
        own = table.parameters
        stopping = errors(family.judge(own), Stage.MOTION)
        if stopping:
            faults += [staged(number, family, one) for one in stopping]
            continue
        try:
            transmission = family.transmission(own)
            if number == 1 and transmission is not None:
                transmission.at(np.zeros(1))  # whether its own drive goes on turn by turn
        except PluginFaultError:  # of no design
            raise
        except MechwrightError as error:
            faults.append(_no_stage(number, family, error))
            continue
        if transmission is None:
            faults.append(_no_family(number, family))
            continue
        last = number == len(params.stage)
        faults += _given(number, family, own, transmission) if number > 1 else ()
        faults += _no_output(number, family, transmission, last=last)
        found.append(Link(number, family, table, transmission))
    if not faults:
        faults += (*_turned_back(found), *_never_back(found))
    if not faults:
        faults += _beyond(found)
    return tuple(found), tuple(faults)


def _no_stage(number: int, family: Family[Any], error: MechwrightError) -> Finding:
    key, _, rest = str(error).partition(": ")
    said, _, cure = (rest or key).partition("; ")
    changes = error.proposed if isinstance(error, MountingError) else ()
    cure = cure or "take another mechanism there"
    found = Finding.error("chain.stage", key if rest else "", said, remedy=cure, proposed=changes)
    named = staged(number, family, found)
    return named if rest else replace(named, parameter=f"stage.{number}.family")


def _no_family(number: int, family: Family[Any]) -> Finding:
    return Finding.error(
        "chain.family",
        f"stage.{number}.family",
        f"stage {number}: mechanisms of the family {family.name} cannot follow another one",
        remedy="take a family of which one shaft turns another: docs/chains.md has those that are built in",
    )


def _given(
    number: int, family: Family[Any], own: Parameters, transmission: Transmission
) -> Iterator[Finding]:
    """Fields of the drive of a stage that another one drives."""
    for name in transmission.own_drive:
        field = type(own).model_fields[name]
        if name in own.model_fields_set and getattr(own, name) != field.get_default():
            yield Finding.error(
                "chain.driven",
                key_of(number, name),
                f"stage {number}, {family.name}: its input is turned by stage {number - 1}",
                remedy=f"leave {name} out; stage 1 has the speed of the chain",
                proposed=({key_of(number, name): None},),
            )


def _no_output(
    number: int, family: Family[Any], transmission: Transmission, *, last: bool
) -> Iterator[Finding]:
    if transmission.output is None and not last:
        yield Finding.error(
            "chain.output",
            f"stage.{number}.family",
            f"stage {number}, {family.name}: no shaft comes out of it that could turn stage {number + 1}",
            remedy="make it the last stage",
        )


def _turned_back(links: Sequence[Link]) -> Iterator[Finding]:
    """Stages that have to be turned on, behind one whose output swings."""
    for place, link in enumerate(links):
        swinging = next((one for one in links[:place] if one.transmission.advance == 0), None)
        if link.transmission.turns_on and swinging is not None:
            yield Finding.error(
                "chain.swings",
                f"stage.{link.number}.family",
                f"stage {link.number}, {link.family.name}: its input has to turn on, and what comes out of "
                f"stage {swinging.number}, {swinging.family.name}, swings there and back: its output would "
                "go back too",
                remedy=f"make stage {swinging.number} one whose output turns all the way, such as a double "
                f"crank or gears, or put stage {link.number} before it",
                proposed=_whole(swinging),
            )


def _whole(link: Link) -> tuple[Change, ...]:
    """Changes with which a stage turns all the way."""
    return tuple(
        {key_of(link.number, key): value for key, value in change.items()}
        for change in link.transmission.whole
    )


def _beyond(links: Sequence[Link]) -> Iterator[Finding]:
    """Stages whose input swings within bounds, and is driven beyond them."""
    for place, link in enumerate(links):
        own, key = link.transmission, f"stage.{link.number}.start"
        if place == 0 or own.travel is None:
            continue
        named, room = f"stage {link.number}, {link.family.name}", own.travel[1] - own.travel[0]
        if all(one.transmission.advance for one in links[:place]):
            yield Finding.error(
                "chain.travel",
                f"stage.{link.number}.family",
                f"{named}: its input swings over {math.degrees(room):g} degrees, and what comes out of "
                f"stage {link.number - 1} turns on",
                remedy=f"put it behind a lever, or make stage {link.number} one that turns all the way",
                proposed=_whole(link),
            )
            return
        theta = list(inputs_of(links, _period(links)))[place].theta
        low, width = float(theta.min()), float(np.ptp(theta))
        if exceeds(width, room):
            wider: Change = {key_of(link.number, own.travel_field): math.ceil(math.degrees(width) + 1)}
            yield Finding.error(
                "chain.travel",
                next(iter(wider)),
                f"{named}: its input is swung over {math.degrees(width):.4g} degrees, and it has "
                f"{math.degrees(room):g}",
                math.degrees(width),
                math.degrees(room),
                "deg",
                f"make {own.travel_field} at least as much",
                proposed=(wider,),
            )
            return
        if low < own.travel[0] - _ROUNDING or low + width > own.travel[1] + _ROUNDING:
            begin = math.degrees(float(theta[0]) + own.travel[0] - low + (room - width) / 2)
            yield Finding.error(
                "chain.travel",
                key,
                f"{named}: its input goes from {math.degrees(low):.4g} to {math.degrees(low + width):.4g} "
                f"degrees, and it swings from {math.degrees(own.travel[0]):g} to "
                f"{math.degrees(own.travel[1]):g}",
                link.table.start,
                begin,
                "deg",
                f"set {key} = {begin:.2f}: the middle of its swing is then that of its travel",
                proposed=({key: round(begin, 2)},),
            )
            return


def _period(links: Sequence[Link]) -> Turning:
    """The input of a chain over one period."""
    own, turns = links[0].transmission, float(turns_of(links))
    way = np.linspace(0.0, math.tau * turns, math.ceil(turns * _SAMPLES) + 1)
    return own.at(own.start + (-way if own.speed < 0 else way))[1]


def inputs_of(links: Sequence[Link], first: Turning) -> Iterator[Turning]:
    """The input of each stage over that of the first (n,), whose first sample is where the chain begins."""
    drive, before = first, None
    for link in links:
        if before is not None and before.transmission.output is not None:
            out = before.transmission.move(drive)
            # Both ports are one shaft; each counts its angle in its own sense.
            sense = float(before.transmission.output.sense * link.transmission.input.sense)
            turned = out.scaled(sense)
            begin = math.radians(link.table.start) - turned.theta[0]
            drive = Turning(turned.theta + begin, turned.omega, turned.alpha, turned.jerk)
        yield drive
        before = link


def turns_of(links: Sequence[Link]) -> Fraction:
    """Turns of the chain's input after which all stages stand as before.

    Over N periods of the stages before, the input of a stage goes on by N times their advance, which has to
    be a whole number of its periods.
    """
    turns, advance = Fraction(0), Fraction(0)
    for number, link in enumerate(links):
        own = link.transmission
        if number == 0:
            turns, advance = own.period, own.advance
            continue
        periods = advance / own.period
        turns *= periods.denominator
        advance = periods.numerator * own.advance
    return turns


def _never_back(links: Sequence[Link]) -> Iterator[Finding]:
    for count in range(2, len(links) + 1):
        turns = turns_of(links[:count])
        if turns > MOST_TURNS:
            number = links[count - 1].number
            yield Finding.error(
                "chain.period",
                f"stage.{number}",
                f"stage {number}, {links[count - 1].family.name}: it comes back only after "
                f"{float(turns):g} turns of the chain's input",
                float(turns),
                MOST_TURNS,
                remedy="take numbers of lobes, teeth and slots with common factors",
            )
            return
