"""Cuts of all forms: programs for bench_bounds.py."""

import math
from collections.abc import Callable

from bound_places import MANY, RNG, inside, places


def _spiral() -> list[str]:
    out = []
    for k in range(MANY):
        reach, turn = 10 * (1 + k / MANY), k / 50
        out.append(f"G1 X{reach * math.cos(turn):.3f} Y{reach * math.sin(turn):.3f}")
    return out


def _small_circles() -> list[str]:
    return [line for place in places(MANY // 2) for line in (f"G1 {place}", "G2 I1 J0")]


def _deeper() -> list[str]:
    return [f"G1 {place} Z{-4 * k / MANY:.5f}" for k, place in enumerate(places(MANY))]


def _beside() -> list[str]:
    """To and fro along the outside, a tenth of a millimetre away from it."""
    return [f"G1 X{(-1) ** k * 15} Y{19.1 + k % 1000 / 1e4:.4f}" for k in range(MANY)]


def _compensated() -> list[str]:
    """Round and round on a wave with inner and outer bends, on its left, each turn a little further out."""
    wave = [(15 + math.sin(7 * k * math.tau / 1000) + k / MANY, k * math.tau / 1000) for k in range(MANY)]
    return [
        *("G41 D23 G1 X50 F1000", "X15"),
        *(f"G1 X{r * math.cos(turn):.4f} Y{r * math.sin(turn):.4f}" for r, turn in wave[1:]),
    ]


def _radius_arcs() -> list[str]:
    arcs = (f"G{2 + k % 2} {inside(9)} R{RNG.choice((20, -15))}" for k in range(MANY))
    return ["G0 X0 Y0", "G1 Z-.5 F1000", *arcs]


def _distances() -> list[str]:
    arcs = ["G2 X1 Y1 I1 J0", "G3 X-1 Y-1 R1", "G1 X.5 F900 Y.2", "G1 X-.5 Y-.2"] * (MANY // 4)
    return ["G0 X0 Y0", "G1 Z-.5 F1000", "G91", *arcs, "G90"]


def _surface() -> list[str]:
    """Rows of short moves over a wavy floor."""
    out = ["G0 X-15 Y-15", "G1 Z-1 F1000"]
    for k in range(MANY):
        row, at = divmod(k, 1000)
        x, y = (at * 0.03 - 15) * (-1) ** row, row * 0.3 - 15
        out.append(f"X{x:.3f} Y{y:.3f} Z{-1 - math.sin(x / 3) * math.cos(y / 3) / 2:.4f}")
    return out


def _helices() -> list[str]:
    """Down on a helix of ten half turns, anywhere, and up again."""
    out = ["G0 Z5"]
    for place in places(MANY // 12):
        out += [f"G0 {place} Z1", "G91 G1 Z-1 F1000"]
        out += [f"G3 X{(-1) ** (k + 1) * 4} Z-.2 I{(-1) ** (k + 1) * 2}" for k in range(10)]
        out += ["G90 G0 Z5"]
    return out


def _holes_of_all_kinds() -> list[str]:
    kinds = "G81 {} Z-3 R1", "G82 {} Z-2 R1 P0.1", "G83 {} Z-3 R1 Q1", "G73 {} Z-3 R1 Q1", "G85 {} Z-2 R1"
    holes = (f"G98 {kinds[k % 5].format(place)} F100" for k, place in enumerate(places(10_000)))
    return [*holes, "G80"]


def _arcs_in_planes() -> list[str]:
    """Half circles that scoop, in ZX and YZ by turns."""
    out = ["G0 X0 Y0", "G1 Z1 F1000"]
    for _ in range(200):
        out += [f"G1 {inside(10)}", "G91", "G18", "G3 X4 I2 K0", "G19", "G2 Y4 J2 K0", "G17", "G90"]
    return out


def _compensated_contours() -> list[str]:
    """Discs, each around with compensation of its own."""
    out = ["G0 X60 Y0", "G1 Z1 F1000"]
    for k in range(MANY // 7):
        r = 12 + k % 100 / 100
        out += [
            "G1 X0 Y40",
            f"G41 D23 G1 X-6 Y{r}",
            f"X0 Y{r}",
            f"G2 X{r} Y0 I0 J{-r}",
            f"G2 X0 Y{-r} I{-r} J0",
        ]
        out += [f"G1 X-9 Y{-r}", "G40 G1 X-9 Y-40"]
    return out


def _tiny() -> list[str]:
    """Steps of a micrometre around a circle."""
    return [
        f"G1 X{8 * math.cos(k / 8000):.5f} Y{8 * math.sin(k / 8000):.5f}{'' if k else ' Z-1 F1000'}"
        for k in range(MANY)
    ]


def _pockets() -> list[str]:
    """Spiral pockets in layers, side by side."""
    out = []
    for x in (-12, 0, 12):
        for layer in range(1, 11):
            out += ["G0 Z5", f"G0 X{x} Y0", f"G1 Z{-layer / 4} F1000"]
            turns = MANY // 30
            spots = ((k * 5 / turns, k * math.tau / 60) for k in range(turns))
            out += [f"G1 X{x + r * math.cos(t):.4f} Y{r * math.sin(t):.4f}" for r, t in spots]
    return out


def _tabbed() -> list[str]:
    """The outside again and again, over four tabs each time."""
    out = ["G0 Z5", "G0 X-24.2 Y-19.2", "G1 Z-3 F1000"]
    for k in range(MANY // 20):
        o = k % 100 / 1000
        for x, y in ((24.2 + o, None), (None, 19.2 + o), (-24.2 - o, None), (None, -19.2 - o)):
            axis, to = ("X", x) if y is None else ("Y", y)
            half = -3.0 if to > 0 else 3.0
            out += [f"G1 {axis}{half} Z-3", "Z-2", f"{axis}{-half}", "Z-3", f"{axis}{to}"]
    return out


def _same_at_depths() -> list[str]:
    """One contour of a hundred lines at a thousand depths."""
    round_ = [
        f"X{12 * math.cos(k / 50 * math.pi):.4f} Y{9 * math.sin(k / 50 * math.pi):.4f}" for k in range(1, 101)
    ]
    layers = range(1, MANY // 101)
    return [
        "G0 X12 Y0",
        "F1000",
        *(w for k in layers for w in (f"G1 Z{-k * 3.9 / len(layers):.4f}", *round_)),
    ]


def _offcuts() -> list[str]:
    """Small discs cut off the frame, all over it and again."""
    out = ["G0 Z5"]
    for place in places(MANY // 5):
        out += [f"G0 {place}", "G1 Z-4.2 F300", "G91 G2 I2.6 J0 F900", "G90 G0 Z5"]
    return out[:MANY]


CASES: dict[str, Callable[[], list[str]]] = {
    "100,000 cuts in air": lambda: ["G1 Z1 F1000", *(f"G1 {p}" for p in places(MANY))],
    "100,000 short cuts": lambda: ["G0 X0 Y0", "G1 Z-.5 F1000", *_spiral()],
    "100,000 crossing cuts": lambda: ["G1 Z-.5 F1000", *(f"G1 {p}" for p in places(MANY))],
    "100,000 crossing cuts, each deeper": lambda: ["F1000", *_deeper()],
    "100,000 cuts beside a wall": lambda: ["G0 X0 Y19.1", "G1 Z-4 F1000", *_beside()],
    "100,000 through cuts": lambda: ["G1 Z-4.3 F1000", *(f"G1 {p}" for p in places(MANY))],
    "100,000 crossing circles": lambda: [
        *("G0 X0 Y0", "G1 Z-.5 F1000"),
        *(f"G2 I{RNG.uniform(1, 20):.3f} J{RNG.uniform(1, 20):.3f}" for _ in range(MANY)),
    ],
    "50,000 small circles": lambda: ["G1 Z-.5 F1000", *_small_circles()],
    "50,000 small through circles": lambda: ["G1 Z-4.3 F1000", *_small_circles()],
    "100,000 circles in one place": lambda: ["G0 X5 Y0", "G1 Z-1 F1000", *["G2 I-5 J0"] * MANY],
    "100,000 turns up and down": lambda: [
        *("G0 X5 Y0", "G1 Z0 F1000"),
        *["G2 X5 Y0 Z-.5 I-5 J0", "G2 X5 Y0 Z0 I-5 J0"] * (MANY // 2),
    ],
    "33,000 holes": lambda: ["G98 G81 X0 Y0 Z-1 R1 F100", *places(MANY // 3), "G80"],
    "100,000 moves of pecks": lambda: ["G98 G83 X0 Y0 Z-3 R1 Q.4 F100", *places(MANY // 30), "G80"],
    "100,000 arcs with R": _radius_arcs,
    "100,000 distances": _distances,
    "100,000 moves over a surface": _surface,
    "100,000 compensated cuts": lambda: ["G0 X60 Y0", *_compensated(), "G40 G1 X60"],
    "100,000 compensated cuts in stock": lambda: [
        "G0 X60 Y0",
        "G1 Z-.5 F1000",
        *_compensated(),
        "G40 G1 X60",
    ],
    "8,300 helices": _helices,
    "10,000 holes of all kinds": _holes_of_all_kinds,
    "400 arcs in ZX and YZ": _arcs_in_planes,
    "14,000 contours with compensation": _compensated_contours,
    "100,000 steps of a micrometre": _tiny,
    "30 spiral pockets": _pockets,
    "5,000 rounds over tabs": _tabbed,
    "a contour at 990 depths": _same_at_depths,
    "20,000 offcuts": _offcuts,
}
