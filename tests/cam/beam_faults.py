"""Faults of programs of beams: each takes the lines and a random generator, and gives other lines."""

import re

WORD = re.compile(r"([XYIJ])([-+]?\d+\.?\d*)")


def blocks(lines):
    """Start and end of each contour among the lines: from its comment to the next one."""
    heads = [k for k, line in enumerate(lines) if line.startswith("(") and k > 3]
    last = next(k for k, line in enumerate(lines) if line == "G0 X0 Y0")
    return list(zip(heads, [*heads[1:], last], strict=True))


def pick(rng, items):
    return items[int(rng.integers(len(items)))] if items else None


def moved(line, letter, by):
    return WORD.sub(lambda m: f"{m[1]}{float(m[2]) + by:.4f}" if m[1] == letter else m[0], line)


def cuts(lines):
    return [k for k, line in enumerate(lines) if re.match(r"G[123] X", line)]


def shifted_point(lines, rng):
    """A point of a contour that is 20 µm and more off: into the part, or open."""
    k = pick(rng, cuts(lines))
    by = float(rng.choice([-1, 1]) * rng.uniform(0.05, 2))
    return [*lines[:k], moved(lines[k], str(rng.choice(["X", "Y"])), by), *lines[k + 1 :]]


def shifted_contour(lines, rng):
    """A whole contour that stands elsewhere."""
    a, b = pick(rng, blocks(lines))
    by, letter = float(rng.choice([-1, 1]) * rng.uniform(0.02, 3)), str(rng.choice(["X", "Y"]))
    return [*lines[:a], *(moved(line, letter, by) for line in lines[a:b]), *lines[b:]]


def missing_contour(lines, rng):
    a, b = pick(rng, blocks(lines))
    return [*lines[:a], *lines[b:]]


def missing_move(lines, rng):
    k = pick(rng, cuts(lines))
    return [*lines[:k], *lines[k + 1 :]]


def swapped_order(lines, rng):
    """An outside before the openings in it."""
    found = blocks(lines)
    outer = [(a, b) for a, b in found if "outside" in lines[a]]
    name = lines[outer[0][0]].split()[0]
    a, b = pick(
        rng, [one for one in outer if any(lines[x].startswith(lines[one[0]].split()[0]) for x, _ in found)]
    )
    name = lines[a].split()[0]
    first = min(x for x, _ in found if lines[x].startswith(name) and "opening" in lines[x])
    return [*lines[:first], *lines[a:b], *lines[first:a], *lines[b:]]


def wrong_turn(lines, rng):
    k = pick(rng, [k for k in cuts(lines) if lines[k].startswith(("G2", "G3"))])
    other = "G2" if lines[k].startswith("G3") else "G3"
    return [*lines[:k], other + lines[k][2:], *lines[k + 1 :]]


def rapid_in_place_of_cut(lines, rng):
    k = pick(rng, [k for k in cuts(lines) if lines[k].startswith("G1")])
    return None if k is None else [*lines[:k], "G0" + lines[k][2:], *lines[k + 1 :]]


def cut_in_place_of_rapid(lines, rng):
    """The way between two contours with the beam on."""
    k = pick(rng, [k for k, line in enumerate(lines) if line.startswith("G0 X") and line != "G0 X0 Y0"][1:])
    if "G64" in "".join(lines):  # there M3 alone switches it on, in rapids as well
        return [*lines[:k], "M3 S800", *lines[k:]]
    return [*lines[:k], f"G1{lines[k][2:]} S800 F600", *lines[k + 1 :]]


def never_off(lines, rng):
    """M5 left out in the middle of a LinuxCNC program, or at the end of any."""
    offs = [k for k, line in enumerate(lines) if line.startswith("M5")][1:]
    k = pick(rng, offs if "G64" in "".join(lines) else offs[-1:])
    return [*lines[:k], *lines[k + 1 :]]


def no_beam(lines, rng):
    k = pick(rng, [k for k, line in enumerate(lines) if "S800" in line])
    return [*lines[:k], lines[k].replace("S800", "S0"), *lines[k + 1 :]]


def wrong_power(lines, rng):
    k = pick(rng, [k for k, line in enumerate(lines) if re.search(r"S[28]00", line)])
    power = int(rng.choice([90, 400, 700, 1000, 4000]))
    return [*lines[:k], re.sub(r"S[28]00", f"S{power}", lines[k]), *lines[k + 1 :]]


def mark_cut_through(lines, rng):
    return [line.replace("S200", "S800") for line in lines]


def twice(lines, rng):
    """A contour once more: what is loose is cut."""
    a, b = pick(rng, blocks(lines))
    return [*lines[:b], *lines[a:b], *lines[b:]]


def mirrored(lines, rng):
    """X counted from the right."""
    turned = {"G2": "G3", "G3": "G2"}
    found = []
    for line in lines:
        if re.match(r"G[0123] X", line):
            line = turned.get(line[:2], line[:2]) + line[2:]
            line = re.sub(r"X([-\d.]+)", lambda m: f"X{90 - float(m[1]):.4f}", line)
            line = re.sub(r"I([-\d.]+)", lambda m: f"I{-float(m[1]):.4f}", line)
        found.append(line)
    return found


def word_wrong(lines, rng):
    """A word that the control reads otherwise, or not at all."""
    k = pick(rng, [k for k, line in enumerate(lines) if line.startswith("G21")])
    word = str(rng.choice(["G20", "G91", "G18", "G93"]))
    old = {"G20": "G21", "G91": "G90", "G18": "G17", "G93": "G94"}[word]
    return [*lines[:k], re.sub(rf"\b{old}\b", word, lines[k]), *lines[k + 1 :]]


def no_end(lines, rng):
    return [line for line in lines if line != "M2"]


FAULTS = [
    shifted_point,
    shifted_contour,
    missing_contour,
    missing_move,
    swapped_order,
    wrong_turn,
    rapid_in_place_of_cut,
    cut_in_place_of_rapid,
    never_off,
    no_beam,
    wrong_power,
    mark_cut_through,
    twice,
    mirrored,
    word_wrong,
    no_end,
]
