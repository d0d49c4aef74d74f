"""Random blocks, read by a control's own interpreter and by ours (``tests/cam/random_blocks.py``).

``python benchmarks/block_witness.py linuxcnc COUNT [SEED]``
``python benchmarks/block_witness.py grbl COUNT [SEED] --parser PROGRAM``
``... --words 2``: blocks of two words of the control's table, or three, instead, so many of them or all.

Prints programs that our reader accepts and that the control refuses, or moves otherwise by; the exit code
is 1 if there are any. LinuxCNC is ``rs274`` of the Debian package linuxcnc-uspace. ``--parser`` is Grbl's
own ``gcode.c`` with a main function around it, which is built outside of this project: a line ``#`` begins
a program; each other line is answered by its moves (``R``, ``F`` or ``A``, and X,Y,Z) and ``=`` with its
status.
"""

import argparse
import re
import subprocess
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
from random_blocks import SHIFTED, by_rs274, difference, of_alphabet, ours, programs


def by_grbl(texts: list[str], parser: str) -> list[tuple[bool, str]]:
    """The same of Grbl, all programs at once."""
    lines = "".join("#\n" + text for text in texts)
    said = subprocess.run([parser], input=lines, capture_output=True, text=True, check=True).stdout
    found = []
    for text, answer in zip(texts, said.split("#\n")[1:], strict=True):
        run = ours(text, "grbl")
        if run is None:
            found.append((False, ""))
            continue
        answers = answer.splitlines()
        ended = next(
            (n for n, line in enumerate(text.splitlines(), 1) if re.search(r"\bM0*(2|30)\b", line, re.I)), 0
        )
        answers = answers[: ended or None]
        bad = [n for n, line in enumerate(answers, 1) if line.rpartition("=")[2] != "0"]
        ends = [
            [float(v) for v in move[1].split(",")[:3]]
            for line in answers
            for move in re.finditer(r" [RFA]([-0-9.e,+]+)", line)
        ]
        why = (
            f"refused there: line {bad[0]} {answers[bad[0] - 1]}"
            if bad and not SHIFTED.search(text)  # an arc may not fit where offsets have moved its ends
            else difference(text, run, np.array(ends).reshape(-1, 3))
        )
        found.append((True, why))
    return found


def main() -> int:
    asked = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    asked.add_argument("control", choices=("linuxcnc", "grbl"))
    asked.add_argument("count", type=int)
    asked.add_argument("seed", type=int, nargs="?", default=1)
    asked.add_argument("--parser", help="Grbl's parser as a program")
    asked.add_argument("--words", type=int, default=0, help="blocks of so many words of the table")
    asked.add_argument("--processes", type=int, default=2)
    given = asked.parse_args()
    if given.words:
        texts = of_alphabet(given.control, given.words, given.count, given.seed)
    else:
        texts = programs(given.control, given.count, given.seed)
    if given.control == "grbl":
        found = by_grbl(texts, given.parser)
    else:
        with ProcessPoolExecutor(given.processes) as pool:
            found = list(pool.map(by_rs274, texts, chunksize=50))
    told = Counter[str]()
    for text, (_, why) in zip(texts, found, strict=True):
        if why:
            told[why] += 1
            if told[why] <= 2:
                print("---", why, *text.splitlines()[3:-1], sep="\n")
    accepted = sum(ok for ok, _ in found)
    print(
        f"{len(found)} programs, {accepted} accepted by our reader, {sum(told.values())} read otherwise there"
    )
    return int(bool(told))


if __name__ == "__main__":
    sys.exit(main())
