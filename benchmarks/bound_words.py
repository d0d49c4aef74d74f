"""Words, comments, subroutines, loops and cycles: programs for bench_bounds.py."""

from collections.abc import Callable

from bound_places import MANY, RNG, places


def _calls() -> list[str]:
    subs = [line for k in range(10, 30_010) for line in (f"O{k} sub", "#31=1", f"O{k} endsub")]
    return subs + [f"O{RNG.randrange(10, 30_010)} call" for _ in range(400_000)]


def _expressions() -> list[str]:
    return ["G0 X0 Y0", "G1 Z-.5 F1000", "#31=.5", *(f"G1 X[#31*{k % 10}] Y[{k % 7}/7]" for k in range(MANY))]


def _on_and_off() -> list[str]:
    return ["G0 X60 Y0", "G1 Z1 F1000", *["G41 D23 G1 X50", "X45", "Y5", "G40 X60", "Y0"] * (MANY // 5)]


def _one_sub() -> list[str]:
    sub = ["O100 sub", "G91 G1 X.01 Y.001 F500", "G1 X-.01", "G90", "O100 endsub"]
    return [*sub, "G0 X0 Y0", "G1 Z-.5 F100", *["O100 call"] * (MANY // 2)]


def _nested() -> list[str]:
    """Each of nine subroutines calls the next three times; the last one cuts."""
    subs = ["o9 sub", "G91 G1 X.001 F500", "X-.001", "G90", "o9 endsub"]
    for k in range(8, 0, -1):
        subs += [f"o{k} sub", *[f"o{k + 1} call"] * 3, f"o{k} endsub"]
    return [*subs, "G0 X0 Y0", "G1 Z-.5 F100", *["o1 call"] * 4]


def _looped() -> list[str]:
    """A spiral that is worked out in a loop."""
    place = "G1 X[#1 * COS[#2]] Y[#1 * SIN[#2]] F[1000 + #1]"
    loop = ["o1 while [#3 lt 90000]", "#2=[#2+7.2]", "#1=[10+#3/9900]", place, "#3=[#3+1]", "o1 endwhile"]
    return ["G0 X10 Y0", "G1 Z-.5 F1000", "#1=10", "#2=0", "#3=0", *loop]


def _modes_in_each() -> list[str]:
    return [f"G1 G90 G21 G17 {p} F{500 + k % 99} S{8000 + k % 50} M3" for k, p in enumerate(places(MANY))]


CASES: dict[str, Callable[[], list[str]]] = {
    "20,000 times compensation on and off": _on_and_off,
    "100,000 expressions": _expressions,
    "100,000 changes of speed": lambda: [f"S{k % 9000} M3" for k in range(MANY)],
    "100,000 dwells": lambda: ["G4 P0.1"] * MANY,
    "100,000 comments": lambda: [f"(part {k})" for k in range(MANY)],
    "100,000 stops": lambda: ["M5 M9", *["M0"] * MANY],
    "100,000 changes of tool": lambda: ["M5 M9", *["T3 M6"] * MANY],
    "100,000 work offsets": lambda: [f"G5{4 + k % 2}" for k in range(MANY)],
    "100,000 retracts": lambda: ["G53 G0 Z0"] * MANY,
    "100,000 values": lambda: ["#31=0", *(f"#31=[#31+{k}]" for k in range(MANY))],
    "an endless loop": lambda: ["#1=0", "O1 while [1]", "#1=[#1+1]", "O1 endwhile"],
    "30,000 subs, 400,000 calls": _calls,
    "50,000 calls of one sub": _one_sub,
    "subs in subs": _nested,
    "90,000 moves in a loop": _looped,
    "100,000 feeds and speeds": lambda: ["G1 Z1 F1000", *_modes_in_each()],
    "100,000 long comments": lambda: [f"G1 {p} (a long comment {k:200})" for k, p in enumerate(places(MANY))],
    "100,000 path modes": lambda: [f"G64 P0.00{1 + k % 2} Q0" for k in range(MANY)],
    "100,000 line numbers": lambda: [f"N{k % 9999} G1 {p} F900" for k, p in enumerate(places(MANY))],
    "25,000 slots with rests": lambda: [
        "G1 Z-.5 F900",
        *(w for p in places(MANY // 4) for w in (f"G1 {p}", "G4 P0.1", "S8000", f"G1 {p} Z-.4")),
    ],
    "pecks of a micrometre": lambda: [f"G98 G83 {p} Z-5 R1 Q.001 F100" for p in places(1000)],
    "arcs of 1,000 turns in ZX": lambda: ["G18 F100", *(["G2 X0 Z5 I5 K0 P1000"] * 1000)],
}
