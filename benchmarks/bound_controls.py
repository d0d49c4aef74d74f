"""Programs in the words of other controls than LinuxCNC: programs for bench_bounds.py.

Each name begins with that of its control, as it stands in :data:`CONTROLS`.
"""

import math
from collections.abc import Callable

from bound_places import MANY, RNG, inside, places

CONTROLS = {
    "Klartext": "heidenhain-tnc",
    "840D": "siemens-840d",
    "Haas": "haas",
    "Fanuc": "fanuc",
    "Grbl": "grbl",
    "Mach3": "mach3",
}


def control_of(name: str) -> str:
    """The control that a program is for, by the name of the program."""
    return CONTROLS.get(name.partition(": ")[0], "linuxcnc")


def _lines(more: str = "") -> list[str]:
    return ["L Z+1 R0 F1000", *(f"L {place}{more}" for place in places(MANY))]


def _klartext_arcs() -> list[str]:
    """Small circles in two halves, wherever they are."""
    out = ["L Z+1 R0 F1000"]
    for _ in range(MANY // 4):
        x, y = RNG.uniform(-20, 20), RNG.uniform(-15, 15)
        out += [f"L X{x + 1:+.3f} Y{y:+.3f}", f"CC X{x:+.3f} Y{y:+.3f}"]
        out += [f"C X{x - 1:+.3f} Y{y:+.3f} DR+", f"C X{x + 1:+.3f} Y{y:+.3f} DR+"]
    return out


def _klartext_radii() -> list[str]:
    return [
        "L X+0 Y+0 R0 FMAX",
        "L Z+1 R0 F1000",
        *(f"CR {inside(9)} R{RNG.choice(('+20', '-15'))} DR{'+-'[k % 2]}" for k in range(MANY)),
    ]


def _klartext_helices() -> list[str]:
    turns = (f"CP IPA{sign}360 IZ{sign}0.5 DR{sign}" for _ in range(MANY // 2) for sign in "-+")
    return ["L X+5 Y+0 R0 FMAX", "L Z+1 R0 F1000", "CC X+0 Y+0", *turns]


def _klartext_modes() -> list[str]:
    pair = ("CYCL DEF 32.0 TOLERANCE", "CYCL DEF 32.1 T{}")
    return [line.format(("0.01", "0.002")[k % 2]) for k in range(MANY // 2) for line in pair]


def _klartext_presets() -> list[str]:
    return ["CYCL DEF 247 DATUM SETTING ~\n  Q339=+1 ;DATUM NUMBER"] * (MANY // 2)


def _klartext_rests() -> list[str]:
    return ["CYCL DEF 9.0 DWELL TIME", "CYCL DEF 9.1 DWELL 0.1"] * (MANY // 2)


def _spiral(word: str = "G1") -> list[str]:
    out = ["G0 X10. Y0.", "G1 Z-.5 F1000."]
    for k in range(MANY):
        reach, turn = 10 * (1 + k / MANY), k / 50
        out.append(f"{word} X{reach * math.cos(turn):.3f} Y{reach * math.sin(turn):.3f}")
    return out


def _usual(control: str, comment: str, *, cycles: bool, sides: bool) -> dict[str, Callable[[], list[str]]]:
    """What is written alike on the controls of one family."""
    found: dict[str, Callable[[], list[str]]] = {
        "100,000 short cuts": _spiral,
        "100,000 rapids": lambda: [f"G0 {place}" for place in places(MANY)],
        "100,000 long comments": lambda: [
            *(
                "G1 Z1. F1000.",
                *(f"G1 {p} {comment.format(f'then {k:30}')}" for k, p in enumerate(places(MANY))),
            )
        ],
        "100,000 comments": lambda: [comment.format(f"PART {k}") for k in range(MANY)],
        "100,000 changes of speed": lambda: [f"S{k % 9000 + 1} M3" for k in range(MANY)],
        "100,000 times coolant on and off": lambda: ["M8", "M9"] * (MANY // 2),
        "100,000 crossing circles": lambda: (
            [
                *("G0 X0. Y0.", "G1 Z-.5 F1000."),
                *(f"G2 I{RNG.uniform(1, 20):.3f} J{RNG.uniform(1, 20):.3f}" for _ in range(MANY)),
            ]
            if control != "840D"
            else ["G0 X0 Y0", "G1 Z-.5 F1000", *(f"G{2 + k % 2} {inside(9)} CR=20" for k in range(MANY))]
        ),
        "100,000 distances and places by turns": lambda: [
            *("G0 X0. Y0.", "G1 Z1. F1000.", *(["G91 G1 X.01", "G90 G1 X0."] * (MANY // 2)))
        ],
        "100,000 line numbers": lambda: [f"N{k % 9999 + 1} G1 {p} F900." for k, p in enumerate(places(MANY))],
        "100,000 deleted blocks": lambda: ["G1 Z1. F1000.", *(f"/G1 {p}" for p in places(MANY))],
    }
    if cycles:
        found |= {
            "33,000 holes": lambda: ["G98 G81 X0. Y0. Z-1. R1. F100.", *places(MANY // 3), "G80"],
            "100,000 moves of pecks": lambda: [
                *("G98 G83 X0. Y0. Z-3. R1. Q.4 F100.", *places(MANY // 30), "G80")
            ],
        }
    if sides:
        found["100,000 times compensation on and off"] = lambda: [
            *(
                "G0 X60. Y0.",
                "G1 Z1. F900.",
                *["G41 D23 G1 X50.", "X45.", "Y5.", "G40 X60.", "Y0."] * (MANY // 5),
            )
        ]
    return {f"{control}: {name}": lines for name, lines in found.items()}


CASES: dict[str, Callable[[], list[str]]] = {
    "Klartext: 100,000 lines": _lines,
    "Klartext: 100,000 lines with all words": lambda: _lines(" R0 F1000"),
    "Klartext: 100,000 feeds": lambda: [f"L {place} F{500 + k % 99}" for k, place in enumerate(places(MANY))],
    "Klartext: 100,000 rapids": lambda: _lines(" R0 FMAX"),
    "Klartext: 100,000 lines in stock": lambda: [
        *("L X+0 Y+0 R0 FMAX", "L Z-0.5 R0 F1000", *(f"L {place}" for place in places(MANY)))
    ],
    "Klartext: 100,000 lines of arcs": _klartext_arcs,
    "Klartext: 100,000 arcs with R": _klartext_radii,
    "Klartext: 100,000 helices": _klartext_helices,
    "Klartext: 100,000 tool calls": lambda: ["TOOL CALL 23 Z S9000"] * MANY,
    "Klartext: 100,000 changes of speed": lambda: [f"TOOL CALL Z S{k % 8000 + 1}" for k in range(MANY)],
    "Klartext: 100,000 tools made ready": lambda: ["TOOL DEF 23"] * MANY,
    "Klartext: 100,000 comments": lambda: [f"; part {k}" for k in range(MANY)],
    "Klartext: 100,000 headings": lambda: [f"* part {k}" for k in range(MANY)],
    "Klartext: 100,000 lines with comments": lambda: _lines(f" ; {'and then on':40}"),
    "Klartext: 100,000 path tolerances": _klartext_modes,
    "Klartext: 50,000 presets": _klartext_presets,
    "Klartext: 100,000 rests": _klartext_rests,
    "Klartext: 100,000 times coolant on and off": lambda: ["M8", "M9"] * (MANY // 2),
    "Klartext: 100,000 lines with M": lambda: [
        f"{line} M{8 + 5 * (k % 2)}" for k, line in enumerate(_lines())
    ],
    "Klartext: 100,000 lines that may be skipped": lambda: [f"/ {line}" for line in _lines()],
    "Klartext: 100,000 retracts": lambda: ["L Z+0 R0 FMAX M91"] * MANY,
    "840D: 100,000 edges": lambda: ["D0", "D1"] * (MANY // 2),
    "840D: 100,000 changes of tool": lambda: ["M5", "M9", *["T23", "M6"] * (MANY // 2)],
    "840D: 100,000 rests": lambda: ["G4 F0.1"] * MANY,
    "840D: 100,000 messages": lambda: [f'MSG("part {k}")' for k in range(MANY)],
    "840D: 100,000 retracts": lambda: ["G0 SUPA Z0 D0"] * MANY,
    **_usual("840D", "; {}", cycles=False, sides=False),
    **_usual("Haas", "({})", cycles=True, sides=True),
    **_usual("Fanuc", "({})", cycles=True, sides=True),
    **_usual("Grbl", "({})", cycles=False, sides=False),
    **_usual("Mach3", "({})", cycles=True, sides=True),
}
