"""The stages of a chain with their families, and what stands against joining them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Finding, Stage, errors
from mechwright.contracts.mounting import MountingError
from mechwright.contracts.parameters import Parameters, kept
from mechwright.contracts.transmission import Transmission
from mechwright.errors import KinematicsError, MechwrightError
from mechwright.mechanics.chain.params import ChainParams, Families, StageTable

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
            )


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
