"""Lines and texts of any length are read in time in proportion to it."""

import time
from contextlib import suppress

import pytest
from by_control import BY_NAME, interpret, prove
from golden_operations import made

from mechwright.errors import ProgramError

LONG = 60_000


def seconds(text: str, control: str) -> float:
    start = time.process_time()
    with suppress(ProgramError):
        interpret(text, BY_NAME[control])
    return time.process_time() - start


@pytest.mark.parametrize("control", ["linuxcnc", "grbl"])
@pytest.mark.parametrize(
    "more",
    [
        "\n" * LONG,
        " " * LONG,
        " \t" * LONG,
        f"(a){' ' * LONG}X1",
        f"X1{'()' * LONG}",
        f"O1{'()' * LONG}",
        f"X1{'(' * LONG}",
        f"/{' ' * LONG}(a)X1",
        "N" * LONG,
        ".1" * LONG,
        f"G1 X[{'[' * LONG}",
        f"#1={'#' * LONG}1",
        f"; {'N1' * LONG}",
    ],
)
@pytest.mark.parametrize("behind", [False, True])
def test_what_is_long_takes_no_longer_than_it_is(more: str, behind: bool, control: str) -> None:
    text = made("profile-outside", control)[0].text
    at = len(text) if behind else text.index("M9")
    assert seconds(f"{text[:at]}\n{more}\n{text[at:]}", control) < 1.0


def test_empty_lines_are_looked_through_once_for_those_that_a_switch_skips() -> None:
    one = made("profile-outside", "linuxcnc")[0]
    start = time.process_time()
    prove(one.text, one.job)
    usual, start = time.process_time() - start, time.process_time()
    assert prove(one.text + "\n" * LONG, one.job).ok
    assert time.process_time() - start < usual + 1.0
