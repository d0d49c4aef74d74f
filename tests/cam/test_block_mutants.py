"""Every kind of block, broken in every way: a sample; ``python benchmarks/mutations.py blocks`` makes them all."""

import re

import golden_operations
import numpy as np
import pytest
from block_mutants import faults, kinds, wrong
from by_control import BY_NAME, prove, read
from mutant_traces import differences, trace

from mechwright.errors import ProgramError

SOURCES = {"linuxcnc": "drill", "fanuc": "slot", "haas": "peck", "mach3": "groove", "grbl": "open-ends"}
EACH = 12


@pytest.mark.parametrize("control", SOURCES)
def test_a_broken_block_is_refused_or_cuts_nothing_of_the_part(control: str) -> None:
    """What passes makes the same moves, or such as the rules allow: no cut is much below the planned ones."""
    rng, reader = np.random.default_rng(16), BY_NAME[control]
    one = golden_operations.made(SOURCES[control], control)[0]
    lines, before = one.text.split("\n"), read(one.text, one.job, reader)
    every = [(kind, fault) for kind in kinds(lines) for fault in faults(kind)]
    refused, said = 0, []
    for place in rng.permutation(len(every))[:EACH].tolist():
        made = wrong(lines, *every[place], rng)
        try:
            failures = prove(made.text, one.job, reader).failures
        except ProgramError as error:
            said.append(str(error))
            continue
        refused += bool(failures)
        if failures or made.text == one.text:
            continue
        after = read(made.text, one.job, reader)
        if differences(trace(before), trace(after)):
            low = [run.end[run.cutting, 2].min() for run in (before, after)]
            assert low[1] >= low[0] - 1.0, made.change  # the limit of ``underside``
    assert all(re.match(r"line \d+: ", text) for text in said)
    assert refused + len(said) >= EACH // 3


def test_a_circle_split_elsewhere_is_the_same_trace_and_another_circle_is_not() -> None:
    start = "G21 G17 G90 G40 G54 G64 P0.001\nT1 M6\nG43 H1\nS900 M3\nG0 X10 Y0 Z0\nG1 F100 X10\n"
    control = BY_NAME["linuxcnc"]
    halves, thirds, turned, other = (
        trace(control.read(f"{start}{arcs}\nM2\n"))
        for arcs in (
            "G3 X-10 Y0 I-10 J0\nX10 Y0 I10 J0",
            "G3 X0 Y10 I-10 J0\nX10 Y0 I0 J-10",
            "G2 X0 Y-10 I-10 J0\nX10 Y0 I0 J10",
            "G3 X0 Y10 I-10 J0\nX10 Y0 I5 J-5",
        )
    )
    assert not differences(halves, thirds)
    assert differences(halves, turned)
    assert differences(halves, other)
