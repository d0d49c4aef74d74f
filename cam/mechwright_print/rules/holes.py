"""Round holes of a print: fits finer than a printer scatters, shafts that jam or rattle, room for inserts.

One finding tells of all holes with one fault, and its change is for all of them.
"""

import math
from collections.abc import Iterator, Sequence

from mechwright.contracts.finding import Change, Finding
from mechwright.contracts.holes import wall_beside
from mechwright.contracts.part import Bore
from mechwright_print.compensation.holes import PrintedHole
from mechwright_print.job.print_job import PrintJob
from mechwright_print.printer.facts import JointKind
from mechwright_print.printer.inserts import WALL

MEASURE = ", or measure the printer: mechwright print --coupon -o coupon"
"""What is said besides of a printer whose figures are published ones."""
NAMED = 4
"""Holes that a line names."""
RUNNING: tuple[JointKind, ...] = ("sliding", "loose", "turning")
"""Joints in which a shaft has to move, from tight to free."""


def fitted_holes(job: PrintJob) -> list[PrintedHole]:
    """The holes with a fit that neither a reamer nor a bush makes."""
    return [
        hole for one in job.parts for hole in one.made.holes if hole.fit is not None and not hole.is_finished
    ]


def middle_play(hole: PrintedHole) -> float:
    """Play of a shaft of the basic size in a printed hole, on the diameter, mm."""
    return 0.0 if hole.fit is None else hole.target - hole.fit.size


def fit_rule(job: PrintJob) -> Iterator[Finding]:
    """No fit is finer than the printer scatters, no moving shaft jams, none has more play than is asked."""
    holes, scatter = fitted_holes(job), job.printer.scatter("hole")
    drawn = [hole for hole in holes if hole.kind == "drawn"]
    if drawn:
        finest = min(drawn, key=_width)
        yield Finding.error(
            "print.fit",
            "print.holes" if all(_key(hole) in job.settings.holes for hole in drawn) else "print.fits",
            f"{_named(drawn)}: a fit is {_width(finest):.3f} mm wide, and this printer scatters by "
            f"±{scatter:.2f} mm",
            2 * scatter,
            _width(finest),
            "mm",
            f'{_line(job, drawn, "ream")}, or set fits = "open"',
            proposed=(_change(job, drawn, "ream"), {"print.fits": "open"}),
        )
    if tight := [hole for hole in holes if hole.kind in RUNNING and middle_play(hole) <= scatter]:
        yield _jams(job, tight, scatter)
    limit = job.settings.greatest_play
    if limit is not None and (wide := [hole for hole in holes if middle_play(hole) + scatter > limit]):
        most = max(middle_play(hole) for hole in wide) + scatter
        moving = all(hole.kind in RUNNING for hole in wide)
        kinds = _able(job, scatter) if moving else ["ream"]
        yield Finding.error(
            "print.play",
            "print.greatest_play",
            f"{_named(wide)}: a shaft has up to {most:.2f} mm of play; the limit is {limit:g} mm",
            most,
            limit,
            "mm",
            _line(job, wide, kinds[0]),
            proposed=tuple(_change(job, wide, kind) for kind in kinds),
        )
    if pressed := [hole for hole in holes if hole.kind == "press"]:
        yield Finding.warning(
            "print.press",
            "print.holes",
            f"{_named(pressed)}: what is pressed in comes loose, or splits the print, which scatters by "
            f"±{scatter:.2f} mm",
            scatter,
            None,
            "mm",
            _line(job, pressed, "ream"),
            proposed=(_change(job, pressed, "ream"),),
        )


def _jams(job: PrintJob, tight: Sequence[PrintedHole], scatter: float) -> Finding:
    """An error of a measured printer; of another one the coupon may tell better."""
    least = min(middle_play(hole) for hole in tight)
    kinds = _able(job, scatter)
    kind = Finding.error if job.printer.measured else Finding.warning
    return kind(
        "print.jam",
        "print.holes",
        f"{_named(tight)}: a shaft has {least:.2f} mm of play, and this printer scatters by ±{scatter:.2f} "
        "mm: it may jam",
        least,
        scatter,
        "mm",
        _line(job, tight, kinds[0]) + ("" if job.printer.measured else MEASURE),
        proposed=tuple(_change(job, tight, kind) for kind in kinds),
    )


def _able(job: PrintJob, scatter: float) -> list[str]:
    """What is printed so that a shaft moves and does not rattle more than is asked; a reamed hole does."""
    limit = math.inf if job.settings.greatest_play is None else job.settings.greatest_play
    plays = {kind: 2 * job.printer.side_clearance(kind) for kind in RUNNING}
    return [*(kind for kind, play in plays.items() if scatter < play <= limit - scatter), "ream"]


def bush_rule(job: PrintJob) -> Iterator[Finding]:
    """Plastic stays around bushes."""
    for one in job.parts:
        bores = {bore.name: bore for bore in one.part.features if isinstance(bore, Bore)}
        for hole in one.made.holes:
            if hole.bush is None or hole.name not in bores:
                continue
            wall = wall_beside(one.part, bores[hole.name]) - hole.target / 2
            if wall < WALL:
                yield Finding.warning(
                    "print.bush",
                    "print.holes",
                    f"{_key(hole)}: {wall:.2f} mm of plastic stay beside a bush of {hole.bush.outside:g} mm, "
                    f"and it takes {WALL:g} mm",
                    wall,
                    WALL,
                    "mm",
                    _line(job, [hole], "ream"),
                    proposed=(_change(job, [hole], "ream"),),
                )


def insert_rule(job: PrintJob) -> Iterator[Finding]:
    """Plastic stays around inserts, and holes are as deep as they are long; other threads are told."""
    short, odd = [], []
    for one in job.parts:
        bores = {bore.name: bore for bore in one.part.features if isinstance(bore, Bore)}
        for hole in one.made.holes:
            if hole.insert is not None:
                bore = bores[hole.name]
                wall = wall_beside(one.part, bore) - hole.insert.hole / 2
                deep = min(bore.depth, one.part.thickness)
                if wall < WALL or deep < hole.insert.length:
                    short.append((hole, wall, deep))
            elif hole.kind == "tap" and job.settings.threads == "insert":
                odd.append(hole)
    screw: Change = {"print.threads": "screw"}
    words = 'set threads = "screw" in [print]: a screw goes through, with a nut'
    if short:
        hole, wall, deep = short[0]
        assert hole.insert is not None  # noqa: S101 - chosen so
        lack = f"{deep:g} mm deep" if deep < hole.insert.length else f"{max(wall, 0):.2f} mm off a wall"
        yield Finding.warning(
            "print.insert",
            "print.threads",
            f"{_named([one for one, _, _ in short])}: no room for a {hole.insert.name}: the hole is {lack}, "
            f"and it takes {hole.insert.length:g} mm and {WALL:g} mm of wall",
            deep if deep < hole.insert.length else wall,
            hole.insert.length if deep < hole.insert.length else WALL,
            "mm",
            words,
            proposed=(screw,),
        )
    if odd:
        yield Finding.warning(
            "print.thread",
            "print.threads",
            f"{_named(odd)}: no insert is known for the thread: the hole is printed for a tap",
            remedy=words,
            proposed=(screw,),
        )


def _key(hole: PrintedHole) -> str:
    return f"{hole.part}.{hole.name}"


def _width(hole: PrintedHole) -> float:
    return 0.0 if hole.fit is None else hole.fit.upper - hole.fit.lower


def _named(holes: Sequence[PrintedHole]) -> str:
    """The holes by part and name, the first of many.

    >>> hole = PrintedHole("crank", "bore", "snug", 6.0, 6.1)
    >>> _named([hole] * 6)
    'crank.bore, crank.bore, crank.bore, crank.bore and 2 more'
    """
    names = [_key(hole) for hole in holes]
    more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
    return ", ".join(names[:NAMED]) + more


def _change(job: PrintJob, holes: Sequence[PrintedHole], kind: str) -> Change:
    return {"print.holes": {**job.settings.holes, **{_key(hole): kind for hole in holes}}}


def _line(job: PrintJob, holes: Sequence[PrintedHole], kind: str) -> str:
    said = ", ".join(
        f'"{key}" = "{value}"' for key, value in _change(job, holes, kind)["print.holes"].items()
    )
    return f"set holes = {{ {said} }} in [print]"
