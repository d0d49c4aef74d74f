"""An interpreter of other hands has the tool where we have it, block by block, in SINUMERIK programs."""

import random

import golden_operations
from by_control import BY_NAME
from golden_cases import CASES
from golden_programs import every_operation, with_options
from sinumerik_reader import differences, needs_witness

from mechwright_cam.controls.words.sinumerik import WORDS
from mechwright_cam.controls.words.table import Use

pytestmark = needs_witness
HEAD = "G17 G710 G40 G90 G94\nG54\nG0 X1 Y1 Z5\nG1 X2 Y1 F100\n"
STATES = ("", "G2 X4 Y1 I1 J0\n", "G3 X4 Y1 CR=2\n", "G0\n", "G64\n", "T1\nM6\nD1 Z7\n")
ADDRESSES = ("X3", "Y2", "Z4", "X=6.5", "I1", "J0", "CR=2", "F50", "S9", "T1", "X-.5", "Y+1.25")
MUTANTS = 4000


def test_programs_of_our_own_are_read_alike() -> None:
    control = BY_NAME["siemens-840d"]
    texts = [control.write(one) for one in (every_operation(), with_options())]
    cases = [name for name in CASES if not name.startswith("tap")]
    texts += [one.text for name in cases for one in golden_operations.made(name, "siemens-840d")]
    alike, wrong = differences(texts)
    assert not wrong
    assert alike > 3000


def test_random_blocks_are_read_alike_where_both_accept_them() -> None:
    rng = random.Random(50)  # noqa: S311 - nothing secret
    codes = [
        row.word
        for row in WORDS.known.values()
        if row.use is not Use.REFUSED and row.word not in {"G91", "G700", "$P_UIFR"}
    ]
    words = [*codes, *ADDRESSES, *ADDRESSES]
    texts = []
    for _ in range(MUTANTS):
        blocks = "\n".join(" ".join(rng.sample(words, rng.choice((1, 2, 2, 3)))) for _ in range(2))
        texts.append(f"{HEAD}{rng.choice(STATES)}{blocks}\nG1 X9 Y8 Z7\nM30\n")
    alike, wrong = differences(texts)
    assert not wrong, wrong[:5]
    assert alike > 500
