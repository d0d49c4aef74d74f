"""Programs of wires, read a second time by a table that was written by hand, and with faults planted."""

import itertools
import math
import re
from collections import Counter
from functools import cache

import numpy as np
import pytest
from by_night import examples
from cut_sheets import plate, sheet_of, toothed, wire
from planning_parts import bore, keyed_bore

from mechwright.contracts.part import Part
from mechwright.geometry import Loop, Outline
from mechwright_cut.proof.wire_judge import prove_wire
from mechwright_cut.settings.cut_settings import CutSettings

WANTED = examples(60, 160)
TILE = Part(
    "tile", Outline(Loop.polygon([(0, 0), (20, 0), (20, 20), (0, 20)]), (bore(8, (10, 10)),)), 5, "steel"
)

TABLE = {
    ("outside", 41, "clockwise"): "outside",
    ("outside", 42, "counter-clockwise"): "outside",
    ("inside", 41, "counter-clockwise"): "inside",
    ("inside", 42, "clockwise"): "inside",
}
"""Loop, word and sense of turning to where the wire runs: left of its way with G41, right of it with G42."""


@cache
def good(passes=3):
    job = sheet_of(
        toothed(material="steel", hole=6.0),
        plate("p", bore(6), size=(22, 18, 3), material="steel"),
        process="wire",
        kerf=0.28,
        passes=passes,
    )
    return wire(job)


def passes_of(text):
    """Word, register and net points of each pass, by patterns alone."""
    here, found, on = None, [], None
    for line in text.splitlines():
        at = {letter: float(value) for letter, value in re.findall(r"([XYIJD])([-+]?\d*\.?\d+)", line)}
        if line.startswith("("):
            continue
        if word := re.search(r"G(41|42)", line):
            on = (int(word[1]), int(at["D"]), [])
        if "X" in at:
            end = (at["X"], at.get("Y", here[1] if here else 0.0))
            if on is not None and "G40" not in line:
                on[2].append((re.search(r"G([123])\b", line)[1], here, end, at))
            here = end
        if "G40" in line and on is not None:
            found.append(on)
            on = None
    return found


def area_of(moves):
    """Signed area of the net contour of a pass, closed by a straight line: positive counter-clockwise."""
    points = [moves[0][2]]
    for code, start, end, at in moves[1:]:
        if code != "1":
            centre = complex(start[0] + at.get("I", 0.0), start[1] + at.get("J", 0.0))
            one, two = complex(*start) - centre, complex(*end) - centre
            sweep = np.angle(two / one) % math.tau
            sweep = sweep if code == "3" else sweep - math.tau
            points += [
                (z.real, z.imag) for z in centre + one * np.exp(1j * sweep * np.linspace(0, 1, 33)[1:])
            ]
        points.append(end)
    x, y = np.array(points).T
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2)


@pytest.mark.parametrize("passes", [1, 2, 3, 4])
def test_a_tile_with_a_hole_by_hand(passes):
    text, asked = wire(sheet_of(TILE, process="wire", kerf=0.28, passes=passes))
    assert prove_wire(text, asked).ok
    found = passes_of(text)
    assert len(found) == 2 * (passes + 1)
    for loop, rows in (("inside", found[: passes + 1]), ("outside", found[passes + 1 :])):
        for number, (word, register, moves) in enumerate(rows[:-1], start=1):
            area = area_of(moves)
            sense = "counter-clockwise" if area > 0 else "clockwise"
            assert TABLE[loop, word, sense] == loop, text
            assert register == number
            wanted = math.pi * 16 if loop == "inside" else 400.0
            assert abs(area) == pytest.approx(wanted, rel=0.03)  # but for the tab
        assert rows[-1][1] == passes


def test_registers_fall_to_half_the_kerf():
    for passes in (1, 2, 3, 4):
        found = CutSettings(passes=passes).registers(0.28)
        assert len(found) == passes
        assert found[-1] == 0.14
        assert all(a > b for a, b in itertools.pairwise(found))


def test_the_program_has_its_frame():
    text, _ = good()
    lines = text.splitlines()
    assert (lines[0], lines[-1], lines[-2], lines[-3]) == ("%", "%", "M2", "M50")
    assert text.count("M60") == text.count("M50") == text.count("M1\n") == 4
    assert text.count("G92") == 1
    assert [line for line in lines if line.startswith("(D")] == ["(D1=0.19)", "(D2=0.15)", "(D3=0.14)"]
    assert not re.search(r"G[023] .*G4[012]|G4[012] (D\d )?G[023]", text), "offsets change on G1 alone"


def test_a_keyway_is_cut_in_one_with_its_bore():
    part = plate("p", keyed_bore(10, 3, 6.4), size=(30, 26, 3), material="steel", thickness=8.0)
    text, asked = wire(sheet_of(part, process="wire", kerf=0.28, passes=2))
    assert prove_wire(text, asked).ok


def lines_with(lines, pattern):
    return [k for k, line in enumerate(lines) if re.search(pattern, line)]


def pick(rng, items):
    return items[int(rng.integers(len(items)))]


def other_side(lines, rng):
    k = pick(rng, lines_with(lines, "G4[12]"))
    swap = {"G41": "G42", "G42": "G41"}
    return [*lines[:k], re.sub("G4[12]", lambda m: swap[m[0]], lines[k]), *lines[k + 1 :]]


def other_register(lines, rng):
    k = pick(rng, lines_with(lines, "^G4.*D"))
    return [*lines[:k], re.sub(r"D(\d)", lambda m: f"D{int(m[1]) % 3 + 1}", lines[k]), *lines[k + 1 :]]


def line_gone(lines, rng):
    k = pick(rng, lines_with(lines, "^(M60|M50|M1|M2|G4[012]|G92|G9)"))
    return [*lines[:k], *lines[k + 1 :]]


def move_gone(lines, rng):
    k = pick(rng, lines_with(lines, "^G[123] X"))
    return [*lines[:k], *lines[k + 1 :]]


def point_off(lines, rng):
    k = pick(rng, lines_with(lines, "^G[123] X"))
    by, letter = float(rng.choice([-1, 1]) * rng.uniform(0.03, 2)), str(rng.choice(["X", "Y"]))
    wrong = re.sub(rf"{letter}([-\d.]+)", lambda m: f"{letter}{float(m[1]) + by:.4f}", lines[k], count=1)
    return [*lines[:k], wrong, *lines[k + 1 :]]


def outside_first(lines, rng):
    heads = lines_with(lines, r"^\(.*(opening|outside)")
    parts = [lines[a:b] for a, b in zip(heads, [*heads[1:], len(lines) - 2], strict=True)]
    order = [parts[-1], *parts[:-1]] if rng.integers(2) else parts[::-1]
    flat = [line.replace("G92 ", "G0 ") for part in order for line in part]
    first = next(k for k, line in enumerate(flat) if line.startswith("G0 "))
    flat[first] = flat[first].replace("G0 ", "G92 ")
    return [*lines[: heads[0]], *flat, *lines[-2:]]


def contour_gone(lines, rng):
    heads = lines_with(lines, r"^\(.*(opening|outside)")
    k = int(rng.integers(1, len(heads)))
    end = heads[k + 1] if k + 1 < len(heads) else len(lines) - 2
    return [*lines[: heads[k]], *lines[end:]]


def wrong_turn(lines, rng):
    k = pick(rng, lines_with(lines, "^G[23] X"))
    return [*lines[:k], {"2": "G3", "3": "G2"}[lines[k][1]] + lines[k][2:], *lines[k + 1 :]]


def rapid_in_a_cut(lines, rng):
    k = pick(rng, lines_with(lines, "^G1 X"))
    return [*lines[:k], "G0" + lines[k][2:], *lines[k + 1 :]]


FAULTS = [
    other_side,
    other_register,
    line_gone,
    move_gone,
    point_off,
    outside_first,
    contour_gone,
    wrong_turn,
    rapid_in_a_cut,
]


def test_no_planted_fault_is_passed():
    text, asked = good()
    assert prove_wire(text, asked).ok, prove_wire(text, asked).failures
    lines, rng = text.splitlines(), np.random.default_rng(11)
    passed, killed = [], Counter()
    while sum(killed.values()) < WANTED and len(passed) < 5:
        fault = FAULTS[int(rng.integers(len(FAULTS)))]
        wrong = fault(list(lines), rng)
        if wrong == lines:
            continue
        if prove_wire("\n".join(wrong) + "\n", asked).ok:
            passed.append(
                (fault.__name__, [(a, b) for a, b in zip(lines, wrong, strict=False) if a != b][:2])
            )
        else:
            killed[fault.__name__] += 1
    assert passed == []
    assert killed.keys() == {fault.__name__ for fault in FAULTS}
