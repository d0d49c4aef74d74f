"""Whether the printed mechanism runs: flanks of gears, plays over the spread, errors beyond limits."""

import math
from collections.abc import Iterator, Sequence

from mechwright.contracts.finding import Change, Finding
from mechwright.designs.text import toml
from mechwright.pipeline import Build
from mechwright.pipeline.tolerances.compared import ComparedOutput
from mechwright.pipeline.tolerances.units import percent, shown, shown_unit
from mechwright.tolerances import TOLERANCES
from mechwright_print.as_made import AsPrinted
from mechwright_print.job.print_job import PrintJob
from mechwright_print.rules.better import REAMED, better_printer, working
from mechwright_print.rules.holes import MEASURE

LOOSENING = ("groove_clearance", "lock_clearance", "guide_clearance", "backlash", "play")
"""Parameters by which families make room between walls that slide, mm."""
ROOM = (0.1, 0.2, 0.3, 0.45, 0.6)
"""More room that is tried, mm."""
STEP = 0.05
"""By which they are raised, mm."""


def backlash_rule(build: Build, job: PrintJob) -> Iterator[Finding]:
    """Teeth have more backlash than their flanks scatter, where the family does not analyse it."""
    params = build.design.params
    if not hasattr(params, "backlash") or build.made(AsPrinted).outputs:
        return
    backlash, need = params.backlash, job.printer.scatter("wall", "wall")
    if backlash is not None and backlash >= need:
        return
    said = "a backlash for milled gears" if backlash is None else f"{backlash:g} mm of backlash"
    made = round(math.ceil(need / STEP - TOLERANCES.slack) * STEP, 3)
    kind = Finding.error if job.printer.measured else Finding.warning
    change: Change = {"parameters.backlash": made}
    yield kind(
        "print.backlash",
        "parameters.backlash",
        f"the flanks have {said}, and two printed ones scatter by ±{need:.2f} mm: they may jam",
        backlash,
        need,
        "mm",
        f"set backlash = {made:g}" + ("" if job.printer.measured else MEASURE),
        proposed=(change,),
    )


def running_rule(build: Build, job: PrintJob) -> Iterator[Finding]:
    """What the family's analysis says of prints that jam, or miss what is asked by more than they may."""
    broken = [one for one in build.made(AsPrinted).outputs if not one.is_kept]
    jamming = [one for one in broken if one.output.stays_above]
    if jamming:
        yield _jam(build, job, jamming)
    for one in broken:
        if not one.output.stays_above:
            yield _miss(build, job, one)


def _jam(build: Build, job: PrintJob, jamming: Sequence[ComparedOutput]) -> Finding:
    """One finding for all plays: the same room helps them."""
    one = min(jamming, key=lambda each: each.kept or 0.0)
    unit, more = one.output.unit, f", and {len(jamming) - 1} more" if len(jamming) > 1 else ""
    rooms = _rooms(build)
    reamed = [] if job.settings.fits == "ream" else [REAMED]
    proposed = working(
        build, job, jamming, (*rooms, *reamed, *({**room, **REAMED} for room in rooms if reamed))
    )
    kind = Finding.error if job.printer.measured else Finding.warning
    return kind(
        "print.as-made",
        next(iter(rooms[0])) if rooms else "print.fits",
        f"{percent(1 - (one.kept or 0.0))} of the prints jam: 99.73 % have {one.output.name} above "
        f"{shown(one.half, unit)} {shown_unit(unit)}{more}",
        one.half,
        0.0,
        unit,
        (_words(proposed) or better_printer(build, job, jamming)) + ("" if job.printer.measured else MEASURE),
        proposed=proposed,
    )


def _miss(build: Build, job: PrintJob, one: ComparedOutput) -> Finding:
    unit = one.output.unit
    proposed = working(build, job, [one], () if job.settings.fits == "ream" else (REAMED,))
    kind = Finding.error if job.printer.measured else Finding.warning
    return kind(
        "print.error",
        "print.fits",
        f"{percent(1 - (one.kept or 0.0))} of the prints miss {one.output.name} by more than "
        f"{shown(one.limit or 0.0, unit)} {shown_unit(unit)}; 99.73 % stay within {shown(one.half, unit)}",
        one.half,
        one.limit,
        unit,
        (_words(proposed) or better_printer(build, job, [one])) + ("" if job.printer.measured else MEASURE),
        proposed=proposed,
    )


def _words(proposed: tuple[Change, ...]) -> str:
    """The first change as a line to type."""
    if not proposed:
        return ""
    said = []
    for key, value in proposed[0].items():
        table, _, name = key.partition(".")
        said.append(f"{name} = {toml(value)}" + (" in [print]" if table == "print" else ""))
    return f"set {' and '.join(said)}"


def _rooms(build: Build) -> tuple[Change, ...]:
    """Changes that give more room between walls, the least first; none where the design has no such key."""
    params = build.design.params
    known = {key: getattr(params, key) or 0.0 for key in LOOSENING if hasattr(params, key)}
    return tuple(
        {f"parameters.{key}": round(value + more, 3) for key, value in known.items()}
        for more in ROOM
        if known
    )


RUNNING = (backlash_rule, running_rule)
"""Rules of the whole mechanism."""
