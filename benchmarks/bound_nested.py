"""Subroutines, calls and loops in each other: programs for bench_bounds.py."""

from collections.abc import Callable

from bound_places import MANY, inside


def _tree(calls: int, depth: int, *body: str) -> list[str]:
    """Each of so many subroutines calls the next so many times; the last one has a body."""
    subs = [f"o{depth} sub", *body, f"o{depth} endsub"]
    for k in range(depth - 1, 0, -1):
        subs += [f"o{k} sub", *[f"o{k + 1} call"] * calls, f"o{k} endsub"]
    return [*subs, "G0 X0 Y0", "G1 Z-.5 F100", "o1 call"]


def _by_number() -> list[str]:
    """A subroutine of M98 that is run 50,000 times by one line, and one that a thousand lines call."""
    out = ["G0 X0 Y0", "G1 Z1 F900", "G91", "M98 P100 L20000", *["M98 P100 L20"] * 1000, "G90"]
    return [*out, "o1 if [0]", "O100", "G1 X.01", "G1 X-.01", "M99", "o1 endif"]


def _loops_in_loops() -> list[str]:
    out = ["G0 X0 Y0", "G1 Z1 F900", "G91"]
    out += [f"o{k} repeat [{6}]" for k in range(1, 7)] + ["G1 X.01", "G1 X-.01"]
    return [*out, *(f"o{k} endrepeat" for k in range(6, 0, -1)), "G90"]


def _arguments() -> list[str]:
    sub = ["O100 sub", "G1 X#1 Y#2", "O100 endsub"]
    return [*sub, "G0 X0 Y0", "G1 Z1 F900", *(f"O100 call [{k % 9}] [{k % 7}]" for k in range(MANY // 2))]


def _long_sub() -> list[str]:
    """A subroutine of a thousand lines, a hundred times."""
    sub = ["O100 sub", *(f"G1 {inside(9)}" for _ in range(1000)), "O100 endsub"]
    return [*sub, "G0 X0 Y0", "G1 Z1 F900", *["O100 call"] * 100]


def _defined_in_a_loop() -> list[str]:
    """A loop passes a subroutine of 10,000 comments again and again."""
    sub = ["o1 sub", *["(on)"] * 10_000, "o1 endsub"]
    return ["o2 repeat [200000]", *sub, "o2 endrepeat"]


def _many_branches() -> list[str]:
    """Ten thousand branches, of which each round asks all."""
    return ["o1 repeat [50000]", "o2 if [0]", *["o2 elseif [0]"] * 10_000, "o2 endif", "o1 endrepeat"]


def _called_before() -> list[str]:
    """A subroutine that stands behind all its calls."""
    return [*["o1 call"] * MANY, "G0 Z5", "M9", "M5", "G53 G0 Z0", "M2", "o1 sub", "G1 X1 F900", "o1 endsub"]


def _same_labels() -> list[str]:
    """Thirty thousand subroutines that all name their branches alike."""
    body = ["o1 if [1]", "G1 X1", "o1 else", "o1 endif"]
    subs = [line for k in range(10, 30_010) for line in (f"o{k} sub", *body, f"o{k} endsub")]
    return [*subs, "G1 Z1 F900", *(f"o{k} call" for k in range(10, 30_010))]


CASES: dict[str, Callable[[], list[str]]] = {
    "subs in subs, of comments": lambda: _tree(4, 9, *(f"(part {k})" for k in range(5))),
    "subs in subs, of empty lines": lambda: _tree(4, 9, *[""] * 5),
    "subs in subs, of nothing": lambda: _tree(4, 9),
    "subs in subs, with comments beside moves": lambda: _tree(4, 8, "G1 X1 (on)", "G1 X0 (back)"),
    "subs in subs, of changes of speed": lambda: _tree(3, 9, "S8000 M3", "S8001 M3", "M8", "M9"),
    "60,000 rounds of a sub by number": _by_number,
    "loops in loops": _loops_in_loops,
    "50,000 calls with values": _arguments,
    "a long sub, 100 times": _long_sub,
    "a sub defined in a loop": _defined_in_a_loop,
    "10,000 branches, again and again": _many_branches,
    "100,000 calls before the sub": _called_before,
    "30,000 subs with branches": _same_labels,
}
