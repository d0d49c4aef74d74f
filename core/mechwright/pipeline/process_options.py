"""Which processes could make each plate of a design: how long each takes, and what the plate loses by it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from mechwright.contracts.finding import errors
from mechwright.contracts.part import Part
from mechwright.errors import MechwrightError
from mechwright.pipeline.build import Build
from mechwright.pipeline.process import Process, plates_of, process_of


@dataclass(frozen=True, slots=True)
class ProcessOption:
    """A process for one plate.

    Parameters
    ----------
    part, process
        Names of both.
    chosen
        Whether the design has chosen it.
    refused
        Why it does not make the plate, in a clause; empty where it does.
    remedies
        Lines without which it does not: empty where it makes the plate as the file stands.
    seconds
        One piece by estimate; None where there is none.
    untimed
        What gives its time then, such as "by the service".
    loses
        What the plate has less of than as drawn, each in a few words.
    """

    part: str
    process: str
    chosen: bool
    refused: str = ""
    remedies: tuple[str, ...] = ()
    seconds: float | None = None
    loses: tuple[str, ...] = ()
    untimed: str = ""

    @property
    def able(self) -> bool:
        """Whether it makes the plate as the file stands."""
        return not self.refused and not self.remedies

    def as_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "part": self.part,
            "process": self.process,
            "chosen": self.chosen,
            "able": self.able,
            "refused": self.refused or None,
            "remedies": list(self.remedies),
            "seconds": None if self.seconds is None else round(self.seconds, 1),
            "untimed": self.untimed or None,
            "loses": list(self.loses),
        }


def process_options(build: Build) -> list[ProcessOption]:
    """Every installed process for every plate of a build: plate by plate, those that are able first."""
    processes: list[Process] = sorted(build.host.all(Process), key=lambda one: one.name)
    found = []
    for part in plates_of(build.parts):
        own = [_option(part, one, build) for one in processes]
        found += sorted(own, key=lambda one: (not one.chosen, not one.able, bool(one.refused)))
    return found


def _option(part: Part, process: Process, build: Build) -> ProcessOption:
    chosen = process_of(build.design, part.name) == process.name
    try:
        if why := process.refuses(part, build):
            return ProcessOption(part.name, process.name, chosen, why)
        wrong = errors(process.objections(part, build))
        if wrong and not all(one.remedy for one in wrong):
            return ProcessOption(part.name, process.name, chosen, wrong[0].message)
        remedies = tuple(dict.fromkeys(one.remedy.partition(": ")[0] for one in wrong))
        seconds, loses = process.seconds(part, build), tuple(process.loses(part, build))
    except MechwrightError as error:  # such as a table of its own that cannot be obeyed
        return ProcessOption(part.name, process.name, chosen, str(error))
    untimed = process.untimed if seconds is None else ""
    return ProcessOption(part.name, process.name, chosen, "", remedies, seconds, loses, untimed)


def options_table(options: Sequence[ProcessOption]) -> list[str]:
    r"""The options in columns, a star beside what is chosen; nothing without plates.

    >>> print(*options_table([ProcessOption("disc", "mill", True, seconds=90.0)]), sep="\n")
    part  process     time  what the plate loses
    disc  mill*    1.5 min
    """
    rows = [("part", "process", "time", "what the plate loses"), *map(_row, options)]
    if len(rows) == 1:
        return []
    wide = [max(len(row[column]) for row in rows) for column in range(3)]
    return [
        f"{part:<{wide[0]}}  {process:<{wide[1]}}  {time:>{wide[2]}}  {said}".rstrip()
        for part, process, time, said in rows
    ]


def _row(one: ProcessOption) -> tuple[str, str, str, str]:
    name = one.process + "*" * one.chosen
    if one.refused:
        return one.part, name, "", f"refused: {one.refused}"
    said = [*one.loses, *one.remedies]
    return one.part, name, one.untimed if one.seconds is None else _time(one.seconds), "; ".join(said)


def _time(seconds: float) -> str:
    """A time that a person reads.

    >>> _time(3.0), _time(600.0), _time(10000.0)
    ('0.1 min', '10.0 min', '2.8 h')
    """
    minutes = max(seconds / 60, 0.1)
    return f"{minutes:.1f} min" if minutes < 100 else f"{minutes / 60:.1f} h"


def options_sentence(options: Sequence[ProcessOption]) -> str:
    """Which other processes make all plates; empty without plates."""
    if not options:
        return ""
    able = [name for name, of in _by_process(options) if all(one.able for one in of)]
    chosen = {one.process for one in options if one.chosen}
    others = [name for name in able if name not in chosen]
    if not others:
        return "no other process makes all plates as the file stands; check --figures lists what each lacks"
    return f"all plates could also be made by {' or '.join(others)}; check --figures has times and losses"


def _by_process(options: Sequence[ProcessOption]) -> Iterator[tuple[str, list[ProcessOption]]]:
    ordered = sorted(options, key=lambda one: one.process)
    return ((name, list(of)) for name, of in groupby(ordered, key=lambda one: one.process))
