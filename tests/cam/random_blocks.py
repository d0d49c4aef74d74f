"""Random blocks for a control, and what its own interpreter makes of them beside our reader.

A program is a start, blocks that set a state (an arc, a cycle, G80, G53 ...), and one to three blocks with words
added, taken out or changed. What our reader accepts, the control has to accept as well, with the same ends of
all moves. What our reader refuses may be anything to the control.
"""

import math
import random
import re
import tempfile
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
from by_control import BY_NAME
from rs274 import run_rs274
from test_rs274 import distinct

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.controls.reading.read import interpret
from mechwright_cam.controls.words.table import Use

NEAR = 1.1e-3
"""Ends of moves are the same within this, mm: Grbl counts in single precision."""
MOVES = (Kind.RAPID, Kind.FEED, Kind.ARC, Kind.HOME)
VALUES = ("0", "1", "2", "5", "-1", "-2", "10", ".5", "0.01", "256", "1.", "7")
LETTERS = "DFGHIJKLMNPQRSTXYZ"
STATES = {
    "": (
        "G0 X1 Y1 Z5",
        "G1 X2 Y1 Z4",
        "G2 X4 Y1 I1 J0",
        "G3 X2 Y1 R1.5",
        "G80",
        "G53 G0 Z0",
        "G91",
        "G18",
        "G20",
    ),
    "linuxcnc": (
        "G81 X1 Y1 Z-1 R2",
        "G83 X2 Y1 Z-1 R2 Q0.5",
        "G82 X1 Y2 Z-1 R2 P0.1",
        "G73 X1 Y1 Z-1 R2 Q1",
        "G64 P0.01",
    ),
}
BLOCKS = {
    "": (
        *(
            "G0 X1 Y2",
            "G0 Z5",
            "G1 X2 Y3 Z1 F200",
            "X3",
            "Y2 Z4",
            "Z5",
            "G4 P0.1",
            "M3 S500",
            "M4 S200",
            "M5",
            "M8",
        ),
        *(
            "M9",
            "M7",
            "G54",
            "G55",
            "G17",
            "G18",
            "G19",
            "G20",
            "G21",
            "G90",
            "G91",
            "G80",
            "G49",
            "G40",
            "G61",
        ),
        *(
            "G94",
            "G53 G0 Z0",
            "G53 G1 X0",
            "G28",
            "G28 Z2",
            "G91 G28 Z0",
            "T1",
            "G10 L2 P1 X0 Y0",
            "G10 L2 P2 Z0",
        ),
        *(
            "M0",
            "M1",
            "N12",
            "F200",
            "S800",
            "G91.1",
            "G2 X4 Y1 I1 J0",
            "G3 X2 Y1 R1.5",
            "G2 X4 I1",
            "G43.1 Z0",
        ),
        *(
            "G2 X1 Y1 Z2 I1 J0",
            "G30",
            "G59",
            "M30",
            "I1",
            "G0",
            "G1",
            "G2",
            "M2",
            "M6",
            "G93",
            "G38.2 Z-1",
            "G92.1",
        ),
        *(
            "G92 X0",
            "G28.1",
            "G43.1 Z1",
            "M7 M8",
            "M3 M8",
            "G4 P0",
            "G53 X0 Y0",
            "G94 F50",
            "m3 s9",
        ),
    ),
    "linuxcnc": (
        *(
            "G43 H0",
            "G43 H1",
            "G64",
            "G64 P0.01",
            "G64 P0.01 Q0.02",
            "G61.1",
            "G81 X1 Y1 Z-1 R2",
            "G98",
            "G99",
            "M6 T1",
        ),
        *(
            "G83 X2 Y1 Z-1 R2 Q0.5",
            "G82 X1 Y2 Z-1 R2 P0.1",
            "G73 X1 Y1 Z-1 R2 Q1",
            "G85 X1 Z-1 R2",
            "G89 X1 Z-1 R2 P0",
        ),
        *(
            "G59.1",
            "G90.1",
            "G97",
            "G10 L1 P1 Z0",
            "G10 L2 P0 X0",
            "G41 D1",
            "G42.1 D2",
            "G33.1 Z-1 K1",
            "G92.1",
        ),
        *("#100=3", "X#100", "X[1+2]", "#<a>=2", "Z#<a>", "G2 X4 Y1 I1 J0 P2", "@3 ^20", "G52 X0"),
    ),
}


def programs(control: str, count: int, seed: int) -> list[str]:
    """Random programs for a control."""
    rng = random.Random(seed)  # noqa: S311 - nothing secret
    states, blocks = STATES[""] + STATES.get(control, ()), BLOCKS[""] + BLOCKS.get(control, ())
    made = []
    for _ in range(count):
        lines = ["G21 G90 G17 G94 G91.1 G40 G49 G54 G61", "G0 X1 Y1 Z5", "G1 X2 Y1 F100"]
        if control == "linuxcnc":
            lines[0] += " G98"
        lines += rng.choices(states, k=rng.choice((0, 1, 1, 2)))
        lines += [changed(rng.choice(blocks), blocks, rng) for _ in range(rng.choice((1, 1, 2, 3)))]
        made.append("\n".join([*lines, "M2", ""]))
    return made


ADDRESSES = (
    "X3",
    "Y2",
    "Z4",
    "I1",
    "J0",
    "K0",
    "R1.5",
    "P1",
    "Q0.5",
    "L1",
    "L2",
    "D1",
    "H1",
    "F50",
    "S9",
    "T1",
    "N7",
)
"""Words that are no codes, for pairs and triples of all words."""


def of_alphabet(control: str, size: int, count: int, seed: int) -> list[str]:
    """Programs with a block of so many words of the control's table, behind a state: all, or so many drawn."""
    rng = random.Random(seed)  # noqa: S311 - nothing secret
    rows = BY_NAME[control].dialect.words.known.values()
    words = [*(row.word for row in rows if row.use is not Use.REFUSED), *ADDRESSES]
    states = ("", *STATES[""], *STATES.get(control, ()))
    blocks = [(state, block) for block in combinations(words, size) for state in states]
    chosen = blocks if count >= len(blocks) else rng.sample(blocks, count)
    head = ["G21 G90 G17 G94 G91.1 G40 G49 G54 G61", "G0 X1 Y1 Z5", "G1 X2 Y1 F100"]
    head[0] += " G98" if control == "linuxcnc" else ""
    return ["\n".join([*head, *filter(None, [state]), " ".join(block), "M2", ""]) for state, block in chosen]


def changed(block: str, blocks: tuple[str, ...], rng: random.Random) -> str:
    """A block with a few words added, taken out or changed; or as it is."""
    words = block.split()
    for _ in range(rng.choice((0, 1, 1, 1, 2, 3))):
        place = rng.randrange(len(words) + 1)
        match rng.randrange(5):
            case 0:
                words.insert(place, rng.choice(LETTERS) + rng.choice(VALUES))
            case 1:
                words[place:place] = rng.choice(blocks).split()
            case 2 if place < len(words):
                del words[place]
            case 3 if place < len(words):
                words[place] = words[place][0] + rng.choice(VALUES)
            case _ if place < len(words) and words[place][0] not in "#[":
                words[place] = rng.choice(LETTERS) + words[place][1:]
    return " ".join(words)


def ours(text: str, control: str) -> Run | None:
    """What our reader makes of a program; None if it refuses."""
    reader = BY_NAME[control]
    try:
        return interpret(
            text,
            replace(reader.dialect, words=reader.dialect.words.with_tools(reader.highest_tool)),
            start=(0.0, 0.0, 0.0),
            diameters={1: 4.0, 2: 2.0},
            upper_end=math.inf,
        )
    except ProgramError:
        return None


SHIFTED = re.compile(r"^(?=.*(?:G53|G10|G43\.1|G28|G30|G52)).*[XYZ][-+.0]*[1-9\[#]", re.MULTILINE)
"""Places in machine coordinates and offsets other than 0: what they make of later moves our reader leaves open."""


def difference(text: str, run: Run, ends: np.ndarray) -> str:
    """How the ends (n, 3) of the control's moves differ from those of a run; empty if they do not."""
    moves = np.isin(run.kind, MOVES)
    still = moves & (run.kind != Kind.HOME)
    if SHIFTED.search(text) or not (
        np.isfinite(run.end[still]).all() and np.isfinite(run.start[moves]).all()
    ):
        return ""
    mine = run.end[np.isin(run.kind, MOVES) & ~run.piece]
    mine = np.concatenate((np.zeros((1, 3)), np.where(np.isfinite(mine), mine, 0.0)))
    one, two = distinct(mine), distinct(np.concatenate((np.zeros((1, 3)), ends)))
    if one.shape != two.shape:
        return f"{len(one) - 1} moves, there {len(two) - 1}"
    off = np.abs(one - two)
    return f"{off.max():.4f} mm apart" if off.max() > NEAR else ""


def by_rs274(text: str) -> tuple[bool, str]:
    """Whether our reader accepts a program, and how LinuxCNC differs then."""
    run = ours(text, "linuxcnc")
    if run is None:
        return False, ""
    with tempfile.TemporaryDirectory() as folder:
        canon = run_rs274(text, Path(folder), "T1 P1 Z0 D0.15748\nT2 P2 Z0 D0.0787\n")
    if "Requested tool" in canon.error or (not canon.ok and SHIFTED.search(text)):
        return True, ""  # the table has two tools; an arc may not fit where offsets have moved its ends
    if not canon.ok:
        return True, "refused there: " + " / ".join(canon.error.splitlines()[-2:])
    inches = "USE_LENGTH_UNITS(CANON_UNITS_INCHES)" in canon.text.partition("SET_FEED_REFERENCE")[2]
    return True, "" if inches else difference(text, run, canon.ends)
