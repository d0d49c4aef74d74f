"""Every word of G-code in every kind of block: is it read, refused, or ignored?

A small program for each control has one block of each kind. Each word (each letter with a few numbers, each G
and M number up to 99 with its decimals) is added to each of its blocks in turn, and stands alone before it. A
word that is accepted has to show: in the path, in the modes, or in the modes that come of it.
``python tests/cam/every_word.py`` does all of them, and has LinuxCNC's own interpreter read what is accepted.
"""

import re
import string
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from by_control import BY_NAME, interpret
from klartext_blocks import anew
from rs274 import RS274, run_rs274

from mechwright.errors import ProgramError

NUMBERS = ("0", "1", "-1", "2.5", "7", "99")
WORDS = (
    *(f"{letter}{number}" for letter in string.ascii_uppercase for number in NUMBERS),
    *(f"G{number}" for number in range(100)),
    *(f"G{whole}.{tenth}" for whole in range(100) for tenth in range(1, 10)),
    *(f"M{number}" for number in range(100)),
    *(f"M{whole}.{tenth}" for whole in range(100) for tenth in (1, 5)),
)
SMALL = {
    "linuxcnc": "G17 G21 G40 G49 G80 G90 G94 G91.1\nG64 P0.002\nG53 G0 Z0\nT1 M6\nG54 S900 M3\nG0 X1 Y2\n"
    "G43 H1 Z5\nM8\nG1 Z-1 F90\nX9\nG2 X9 Y8 I0 J3\nG3 Y2 R3\nG98 G81 X5 Y5 Z-3 R2\nX7\nG83 X8 Z-3 R2 Q1\n"
    "G80\nG4 P0.5\nG41.1 D2 G1 X20 Y20\nG1 Y40\nG40 X0\nM9\nM5\nG28\nM0\nM30\n",
    "grbl": "G17 G21 G40 G49 G80 G90 G94 G91.1\nG61\nG53 G0 Z0\nT1\nM0\nG53 G0 Z0\nG54 S900 M3\nG0 X1 Y2\n"
    "G43.1 Z50\nG0 Z5\nM8\nG1 Z-1 F90\nX9\nG2 X9 Y8 I0 J3\nG3 Y2 R4\nG80\nG4 P0.5\nM9\nM5\nG28\nM30\n",
    "mach3": "G17 G21 G40 G49 G80 G90 G94 G91.1\nG64\nG53 G0 Z0\nT1 M6\nG54 S900 M3\nG0 X1 Y2\n"
    "G43 H1 Z5\nM8\nG1 Z-1 F90\nX9\nG2 X9 Y8 I0 J3\nG3 Y2 R3\nG98 G81 X5 Y5 Z-3 R2\nX7\nG83 X8 Z-3 R2 Q1\n"
    "G80\nG4 P0.5\nG41 D1 G1 X20 Y20\nG1 Y40\nG40 X0\nM9\nM5\nG28\nM0\nM30\n",
    "fanuc": "O0001\nG17 G21 G40 G49 G80 G90 G94\nG64\nG91 G28 Z0.\nG90\nT1 M6\nG54 S900 M3\nG0 X1. Y2.\n"
    "G43 H1 Z5.\nM8\nG1 Z-1. F90.\nX9.\nG2 X9. Y8. I0. J3.\nG3 Y2. R3.\nG98 G81 X5. Y5. Z-3. R2.\nX7.\n"
    "G83 X8. Z-3. R2. Q1.\nG80\nG4 P500\nG41 D1 G1 X20. Y20.\nG1 Y40.\nG40 X0.\nM9\nM5\nM0\nM30\n",
}
SMALL["haas"] = SMALL["fanuc"]
SMALL["siemens-840d"] = (
    "G17 G710 G40 G90 G94 COMPOF\nG64\nG0 SUPA Z0 D0\nT1\nM6\nG54 S900 M3\nG0 X1 Y2\nD1 Z5\nM8\nG1 Z-1 F90\n"
    "X9\nG2 X9 Y8 I0 J3\nG3 Y2 CR=3\nG4 F0.5\nG0 Z5\nM9\nM5\nG0 SUPA Z0 D0\nM0\nM30\n"
)
SMALL["heidenhain-tnc"] = """\
0 BEGIN PGM SMALL MM
1 CYCL DEF 247 Q339=+1
2 CYCL DEF 32.0 TOLERANCE
3 CYCL DEF 32.1 T0.002
4 L Z+0 R0 FMAX M91
5 TOOL CALL 1 Z S900
6 M3
7 L X+1 Y+2 R0 FMAX
8 L Z+5 R0 FMAX
9 M8
10 L Z-1 F90
11 L X+9
12 CC X+9 Y+5
13 C X+9 Y+8 DR+
14 CR X+9 Y+2 R+3 DR+
15 CC X+9 Y+5
16 CP IPA+360 IZ-1 DR+
17 CYCL DEF 9.0 DWELL TIME
18 CYCL DEF 9.1 DWELL 0.5
19 TOOL DEF 7
20 L Z+5 R0 FMAX
21 M9
22 M5
23 L Z+0 R0 FMAX M91
24 STOP
25 M30
26 END PGM SMALL MM
"""
KLARTEXT = (
    *(
        f"{name}{number}"
        for name in ("IX", "IY", "IZ", "PR", "PA", "IPA", "IPR", "DL", "DR", "RX")
        for number in NUMBERS
    ),
    *(f"{letter}+{number}" for letter in "XYZRQ" for number in NUMBERS if number[0] != "-"),
    *(
        "R0",
        "RL",
        "RR",
        "FMAX",
        "F MAX",
        "FAUTO",
        "F AUTO",
        "FU0.1",
        "FZ0.1",
        "FT2",
        "DR+",
        "DR-",
        "R",
        "F",
        "X",
        "M",
    ),
    *(
        "L",
        "C",
        "CC",
        "CR",
        "CP",
        "CT",
        "CTP",
        "LP",
        "LN",
        "RND",
        "CHF",
        "APPR LT",
        "DEP LT",
        "FL",
        "FC",
        "STOP",
        "END",
    ),
    *("LBL 1", "LBL 0", "CALL LBL 1", "CALL PGM A", "CYCL CALL", "CYCL DEF 7.0", "CYCL DEF 200 DRILLING"),
    *(
        "TOOL CALL",
        "TOOL CALL 7 Z S900",
        "TOOL CALL Z S500",
        "TOOL DEF 2",
        "PLANE RESET STAY",
        "FN 0: Q1 = +1",
    ),
    *(
        "Q1 = 5",
        "BLK FORM 0.1 Z X+0 Y+0 Z-5",
        "/",
        "~",
        ";",
        "* - A",
        "A+1",
        "B+1",
        "M91",
        "M92",
        "M128",
        "M140 MB5",
    ),
)
"""Words of Klartext, beside which those of the others are tried."""


@dataclass(frozen=True)
class Try:
    """A program with a word more, and the line and the word."""

    control: str
    line: str
    word: str
    alone: bool
    text: str

    def __str__(self) -> str:
        return f"{self.control}: {self.word} {'before' if self.alone else 'in'} {self.line!r}"


def tries(control: str, words: tuple[str, ...] = WORDS) -> Iterator[Try]:
    """Every word in and before every block of a control's program."""
    lines = SMALL[control].splitlines()
    for index, line in enumerate(lines):
        if line.startswith(("O", "0 ")):
            continue
        for word in words:
            for alone in (False, True):
                put = [word, line] if alone else [f"{line} {word}"]
                text = anew("\n".join([*lines[:index], *put, *lines[index + 1 :], ""]))
                yield Try(control, line, word, alone, text)


def words_of(control: str) -> tuple[str, ...]:
    """The words that are tried on a control."""
    return WORDS + KLARTEXT if control == "heidenhain-tnc" else WORDS


def seen(text: str, control: str) -> tuple[list[str], bytes, bytes]:
    """All that a reading says of a program but its lines: states, steps, and what it writes.

    Raises ProgramError if the control refuses it.
    """
    run = interpret(text, BY_NAME[control], diameters={1: 2.0, 7: 2.0})
    steps = np.column_stack((run.kind, run.start, run.end, run.centre, run.sweep, run.feed, run.seconds))
    states = np.array(run.state)
    return (
        [*map(repr, (*run.states, run.writes, run.ended, run.machine_xy.tolist()))],
        steps.tobytes(),
        states.tobytes(),
    )


TABLE = "".join(f"T{number} P{number}\n" for number in (1, 2, 7, 99))
"""LinuxCNC's table of tools, without lengths and diameters."""


@cache
def _plain(control: str) -> tuple[list[str], bytes, bytes]:
    return seen(SMALL[control], control)


MODAL = re.compile(
    r"[FST].*|D[01]|G(17|18|19|20|21|40|43|49|60|61|64|80|8[123]|9[0148]|98|99|90\.1|91\.1|5\d|[0123])|M.*"
)
"""Words that hold until another of their group: one that is said again before it counts shows nowhere."""
SAYS_NOTHING = re.compile(
    r"N.*|O\d+|"  # the numbers of lines and programs
    r"G(9|15|50|69)|M(19|31|33|48|49|88|89)|"  # they change no path (docs/control-reading.md)
    r"/|;|\* - A|BLK .*|D[LR]0|TOOL DEF 7|R\+?0"  # of Klartext: what is skipped, drawn or said, and what is 0
)
"""Words that never show."""
SO_ANYWAY = {"X1", "Z-1", "P1", "Q-1", "G53", "X9", "Y2", "K0", "K1", "L1", "X+1"}
"""Words that say in some blocks what is so without them: a place, one turn, a Q as large as P, a cycle run once."""


def outcome(one: Try) -> str:
    """``refused``, ``read`` if the word shows, ``nothing`` if it need not, or ``ignored``."""
    try:
        found = seen(one.text, one.control)
    except ProgramError as error:
        return "refused" if re.match(r"line \d+: ", str(error)) else "ignored"
    if found != _plain(one.control):
        return "read"
    word = one.word.removesuffix(".0")
    known = MODAL.fullmatch(word) or SAYS_NOTHING.fullmatch(word) or word in SO_ANYWAY
    return "nothing" if known else "ignored"


def witness(one: Try, folder: Path) -> str:
    """What LinuxCNC says against a program that is accepted; nothing if it accepts it too."""
    canon = run_rs274(one.text, folder, TABLE)
    return "" if canon.ok else canon.error.splitlines()[-1]


def judged(control: str, words: tuple[str, ...], folder: Path) -> tuple[dict[str, int], list[str]]:
    """How many tries had which outcome, and those that must not be."""
    count = dict.fromkeys(("refused", "read", "nothing", "ignored", "only LinuxCNC refuses"), 0)
    wrong = []
    for one in tries(control, words):
        found, said = outcome(one), ""
        if (
            control == "linuxcnc"
            and RS274
            and found in {"read", "nothing"}
            and (said := witness(one, folder))
        ):
            found = "only LinuxCNC refuses"
        count[found] += 1
        if found in {"ignored", "only LinuxCNC refuses"}:
            wrong.append(f"{one}: {said or found}")
    return count, wrong


def main(*controls: str) -> int:
    found: list[str] = []
    for control in controls or SMALL:
        with tempfile.TemporaryDirectory() as folder:
            count, wrong = judged(control, words_of(control), Path(folder))
        told = [f"{control}: " + ", ".join(f"{name} {n}" for name, n in count.items()), *wrong]
        sys.stdout.write("\n    ".join(told) + "\n")
        sys.stdout.flush()
        found += wrong
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
