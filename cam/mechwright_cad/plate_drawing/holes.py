"""The holes of a plate as its table of holes has them: place, size, fit, depth, thread, countersink."""

import math
from collections import defaultdict
from dataclasses import dataclass

from mechwright.contracts.details import CORE_PLAY, Chamfer, Thread
from mechwright.contracts.part import Bore, Part
from mechwright.contracts.threads import COARSE
from mechwright.geometry import Arc
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cad.sheet.words import FAIR, number


@dataclass(frozen=True)
class Hole:
    """Everything round about one axis.

    Parameters
    ----------
    centre
        Of the axis, mm, in the part's own coordinates.
    radius
        Of the largest circle, mm.
    words
        What is drilled, reamed, threaded and countersunk there, from the largest to the smallest diameter.
    fitted
        Whether one of its diameters has a fit.
    """

    centre: Point
    radius: float
    words: str
    fitted: bool


@dataclass(frozen=True)
class Kind:
    """Holes that are alike: a letter, what they are, and where they are."""

    letter: str
    words: str
    holes: tuple[Hole, ...]


def kinds(part: Part, datum: Point) -> tuple[Kind, ...]:
    """The holes of a plate by what they are, those with a fit first; each lot counted from the datum on."""
    lots = defaultdict(list)
    for hole in _holes(part):
        lots[not hole.fitted, hole.words].append(hole)
    order = sorted(lots.items(), key=lambda item: (item[0][0], -item[1][0].radius, item[0][1]))
    return tuple(
        Kind(_letter(count), words, tuple(sorted(found, key=lambda one: _from(one.centre, datum))))
        for count, ((_, words), found) in enumerate(order)
    )


def _letter(count: int) -> str:
    """C, D, ... Z, CC, CD ...; A and B are datums, and I and O could be read as numbers."""
    letters = "CDEFGHJKLMNPQRSTUVWXYZ"
    before, last = divmod(count, len(letters))
    return (_letter(before - 1) if before else "") + letters[last]


def _from(centre: Point, datum: Point) -> tuple[float, float]:
    x, y = centre[0] - datum[0], centre[1] - datum[1]
    return round(math.hypot(x, y), 6), round(math.atan2(y, x) % math.tau, 6)


def _holes(part: Part) -> list[Hole]:
    bores = [one for one in part.features if isinstance(one, Bore)]
    threads = [one for one in part.details if isinstance(one, Thread)]
    chamfers = [(one, _round(one)) for one in part.details if isinstance(one, Chamfer)]
    lots: dict[tuple[float, float], list[Bore]] = defaultdict(list)
    for bore in bores:
        lots[_key(bore.centre)].append(bore)
    found = []
    for key, lot in lots.items():
        own = [thread for thread in threads if _key(thread.centre) == key]
        words = _of_threads(own, lot, part.thickness)
        broken = [
            f"{number(one.width)} x 45°" for one, at in chamfers if at is not None and _key(at.centre) == key
        ]
        radius = max([bore.diameter / 2 for bore in lot] + [thread.diameter / 2 for thread in own])
        fitted = any(bore.fit is not None for bore in lot)
        found.append(Hole(lot[0].centre, radius, "; ".join([*words, *broken]), fitted))
    return found


def _key(centre: Point) -> Point:
    """What centres of one axis share."""
    step = TOLERANCES.closure
    return round(centre[0] / step) * step, round(centre[1] / step) * step


def _round(chamfer: Chamfer) -> Arc | None:
    """The circle that a chamfer follows."""
    first = chamfer.loop.segments[0]
    return first if chamfer.loop.is_circle and isinstance(first, Arc) else None


def _of_bore(bore: Bore, thickness: float) -> str:
    size = f"{bore.fit.text} {FAIR}" if bore.fit is not None else number(bore.diameter)
    through = bore.top + bore.depth >= thickness - TOLERANCES.closure
    if through:
        return f"⌀{size} through" if bore.top <= TOLERANCES.closure else f"⌀{size} through from there"
    deep = f"{bore.depth_text} deep"
    return f"⌀{size}, {deep}" + (f" from {number(bore.top)} on" if bore.top > TOLERANCES.closure else "")


def _of_threads(threads: list[Thread], bores: list[Bore], thickness: float) -> list[str]:
    """Threads with their drills behind a stroke (ISO 6410-1), and all other bores, the widest first."""
    words = []
    rest = sorted(bores, key=lambda one: -one.diameter)
    for thread in threads:
        cores = [bore for bore in rest if abs(bore.diameter - thread.core) <= CORE_PLAY * thread.pitch]
        core = min(cores, key=lambda bore: abs(bore.diameter - thread.core), default=None)
        word = _of_thread(thread, thickness)
        if core is not None:
            rest.remove(core)
            word += f" / {_of_bore(core, thickness)}"
        words.append(word)
    return [*words, *(_of_bore(bore, thickness) for bore in rest)]


def _of_thread(thread: Thread, thickness: float) -> str:
    """Designation, class of tolerance and depth.

    >>> _of_thread(Thread("t", (0, 0), 5.0, 0.8, 7.5), 10.0)
    'M5-6H, 7.5 deep'
    """
    deep = "through" if thread.depth >= thickness - TOLERANCES.closure else f"{number(thread.depth)} deep"
    name, left = thread.designation.removesuffix(" LH"), " LH" if thread.left else ""
    if thread.inch:
        return f"{name}-2B{left}, {deep}"
    if COARSE.get(thread.diameter) == thread.pitch:
        name = f"M{thread.diameter:g}"
    return f"{name}{left}-6H, {deep}"
