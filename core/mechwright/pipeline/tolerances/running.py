"""Whether a mechanism runs whose parts stray as their process does: plays that jam, errors beyond limits."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from mechwright.contracts.finding import Change, Finding
from mechwright.contracts.parameters import Parameters
from mechwright.designs.text import toml
from mechwright.errors import MechwrightError
from mechwright.pipeline.build import Build
from mechwright.pipeline.tolerances.compared import ComparedOutput
from mechwright.pipeline.tolerances.units import percent, shown, shown_unit
from mechwright.tolerances import TOLERANCES

LOOSENING = ("groove_clearance", "lock_clearance", "guide_clearance", "backlash", "play")
"""Parameters by which families make room between walls that slide, mm."""
ROOM = (0.1, 0.2, 0.3, 0.45, 0.6)
"""More room that is tried, mm."""
STEP = 0.05
"""By which they are raised, mm."""


@dataclass(frozen=True)
class Wording:
    """How findings about parts of one process are worded.

    Parameters
    ----------
    code
        Of the process, such as ``"print"``.
    parts
        Its parts in words, such as ``"prints"``.
    key
        Of what loosens or tightens its holes, such as ``"print.fits"``.
    kind
        Makes the finding: an error where the spread is measured, else a warning.
    tail
        Said behind each remedy.
    otherwise
        The remedy where no change helps, of the outputs that are not kept.
    again
        The outputs with other parameters, and with a change of the process.
    tighter
        Changes of the process that take play away; none where it has none.
    """

    code: str
    parts: str
    key: str
    kind: Callable[..., Finding]
    otherwise: Callable[[Sequence[ComparedOutput]], str]
    again: Callable[[Parameters, Change], Sequence[ComparedOutput]]
    tail: str = ""
    tighter: Change | None = None


def backlash_rule(
    build: Build, wording: Wording, outputs: Sequence[ComparedOutput], need: float
) -> Iterator[Finding]:
    """Teeth have more backlash than their flanks need, mm, where the family does not analyse it."""
    params = build.design.params
    if not hasattr(params, "backlash") or outputs:
        return
    backlash = params.backlash
    if backlash is not None and backlash >= need:
        return
    said = "a backlash for milled gears" if backlash is None else f"{backlash:g} mm of backlash"
    made = round(math.ceil(need / STEP - TOLERANCES.slack) * STEP, 3)
    change: Change = {"parameters.backlash": made}
    yield wording.kind(
        f"{wording.code}.backlash",
        "parameters.backlash",
        f"the flanks have {said}, and those of two {wording.parts} want {need:.2f} mm: they may jam",
        backlash,
        need,
        "mm",
        f"set backlash = {made:g}{wording.tail}",
        proposed=(change,),
    )


def running_rule(build: Build, wording: Wording, outputs: Sequence[ComparedOutput]) -> Iterator[Finding]:
    """What the family's analysis says of parts that jam, or miss what is asked by more than they may."""
    broken = [one for one in outputs if not one.is_kept]
    jamming = [one for one in broken if one.output.stays_above]
    if jamming:
        yield _jam(build, wording, jamming)
    for one in broken:
        if not one.output.stays_above:
            yield _miss(build, wording, one)


def _jam(build: Build, wording: Wording, jamming: Sequence[ComparedOutput]) -> Finding:
    """One finding for all plays: the same room helps them."""
    one = min(jamming, key=lambda each: each.kept or 0.0)
    unit, more = one.output.unit, f", and {len(jamming) - 1} more" if len(jamming) > 1 else ""
    tighter, rooms = wording.tighter, _rooms(build)
    tried = (*rooms, *([tighter] if tighter else []), *({**room, **tighter} for room in rooms if tighter))
    proposed = _working(build, wording, jamming, tried)
    return wording.kind(
        f"{wording.code}.as-made",
        next(iter(rooms[0])) if rooms else wording.key,
        f"{percent(1 - (one.kept or 0.0))} of the {wording.parts} jam: 99.73 % have {one.output.name} above "
        f"{shown(one.half, unit)} {shown_unit(unit)}{more}",
        one.half,
        0.0,
        unit,
        (_words(proposed, wording) or wording.otherwise(jamming)) + wording.tail,
        proposed=proposed,
    )


def _miss(build: Build, wording: Wording, one: ComparedOutput) -> Finding:
    unit = one.output.unit
    proposed = _working(build, wording, [one], () if wording.tighter is None else (wording.tighter,))
    return wording.kind(
        f"{wording.code}.error",
        wording.key,
        f"{percent(1 - (one.kept or 0.0))} of the {wording.parts} miss {one.output.name} by more than "
        f"{shown(one.limit or 0.0, unit)} {shown_unit(unit)}; 99.73 % stay within {shown(one.half, unit)}",
        one.half,
        one.limit,
        unit,
        (_words(proposed, wording) or wording.otherwise([one])) + wording.tail,
        proposed=proposed,
    )


def _working(
    build: Build, wording: Wording, broken: Sequence[ComparedOutput], changes: Sequence[Change]
) -> tuple[Change, ...]:
    """The first change with which all outputs are kept, and those after it; none where no change helps."""
    names = {one.output.name for one in broken}
    for place, change in enumerate(changes):
        try:
            again = wording.again(_params(build, change), change)
        except MechwrightError:
            continue
        if all(one.is_kept for one in again if one.output.name in names):
            return tuple(changes[place:])
    return ()


def _params(build: Build, change: Change) -> Parameters:
    """The parameters with a change, without a new choice of keys that the file leaves out."""
    own: Change = {key: value for key, value in change.items() if key.startswith("parameters.")}
    return build.design.changed(own, settle=False).params if own else build.design.params


def _words(proposed: tuple[Change, ...], wording: Wording) -> str:
    """The first change as a line to type."""
    if not proposed:
        return ""
    said = []
    for key, value in proposed[0].items():
        table, _, name = key.partition(".")
        said.append(f"{name} = {toml(value)}" + (f" in [{table}]" if table == wording.code else ""))
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
