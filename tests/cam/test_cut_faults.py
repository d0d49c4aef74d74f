"""Programs of beams with one thing wrong: no proof passes any of them.

Kerf side, order, power in rapids, leads on flanks and through walls, open contours, pieces that fall before
their holes are cut, passes, marks, the sheet: each fault has many places in the text.
"""

from collections import Counter
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from beam_faults import FAULTS, blocks
from by_night import examples
from cut_sheets import beam, plate, sheet_of, toothed
from planning_parts import bore

from mechwright.contracts.details import Engraving
from mechwright_cut.proof.judge import prove

WANTED = examples(60, 320)


@cache
def good(control):
    mark = Engraving("mark", (((-5.0, 4.0), (5.0, 4.0)),), 0.1)
    part = plate("plate", bore(5), bore(3, (8, 0)), size=(26, 18, 3), details=(mark,))
    return beam(sheet_of(toothed(), part), control)


def harmless(before, after):
    """Faults that change nothing that is cut: a lead that is moved in the waste, an overcut that is left out."""
    return before == after


@pytest.mark.parametrize("control", ["grbl-laser", "linuxcnc-beam"])
def test_no_planted_fault_is_passed(control):
    text, asked = good(control)
    assert prove(text, asked).ok
    lines = text.splitlines()
    rng = np.random.default_rng(7)
    passed, killed = [], Counter()
    while sum(killed.values()) < WANTED // 2 and len(passed) < 5:
        fault = FAULTS[int(rng.integers(len(FAULTS)))]
        wrong = fault(list(lines), rng)
        if wrong is None or harmless(lines, wrong):
            continue
        proof = prove("\n".join(wrong) + "\n", asked)
        if proof.ok:
            changed = [(a, b) for a, b in zip(lines, wrong, strict=False) if a != b][:2]
            passed.append((fault.__name__, changed))
        else:
            killed[fault.__name__] += 1
    assert passed == []
    assert len(killed) >= 12


@pytest.mark.parametrize("by", [-1.0, -0.5, -0.1, -0.07, 0.07, 0.1, 0.5, 1.0])
def test_another_kerf_is_not_passed(by):
    text, asked = good("grbl-laser")
    assert not prove(text, replace(asked, kerf=asked.kerf * (1 + by) if by > -1 else 2 * asked.kerf)).ok


def test_what_must_not_be_cut_is_not_passed():
    text, asked = good("grbl-laser")
    assert not prove(text, replace(asked, refused="chlorine")).ok


def test_a_lead_on_a_flank_is_not_passed():
    """The wheel entered straight, in the middle of a flank."""
    text, asked = good("grbl-laser")
    wheel = next(one for one in asked.pieces if one.name == "wheel")
    flank = next(s for s in wheel.outline.outer.segments if s.tag == "flank")
    (x, y), (dx, dy) = flank.at(0.5)[0], flank.derivative(0.5)[0]
    n = np.array((dy, -dx)) / np.hypot(dx, dy)
    foot, far = np.array((x, y)) + asked.kerf / 2 * n, np.array((x, y)) + 0.8 * n
    from mechwright_cut.paths.parallels import beam_path, turned_to
    from mechwright_cut.programs.words import moves
    from mechwright_plane.places import candidates

    path = beam_path(wheel.outline.outer, asked.kerf, True, "wheel")
    ways, points, _ = candidates(path)
    whole = turned_to(path, float(ways[np.argmin(np.hypot(*(points - foot).T))]))
    lines = text.splitlines()
    a, b = next((a, b) for a, b in blocks(lines) if lines[a] == "(wheel outside)")
    block = [
        lines[a],
        "M4 S0",
        f"G0 X{far[0]:.4f} Y{far[1]:.4f}",
        f"G1 X{whole.start[0]:.4f} Y{whole.start[1]:.4f} S800 F600",
        *moves(whole),
        "M5 S0",
    ]
    proof = prove("\n".join([*lines[:a], *block, *lines[b:]]) + "\n", asked)
    assert [check.name for check in proof.failures] == ["leads off flanks"]
