"""Time and memory of the proof for long and hostile programs: ``python benchmarks/bench_bounds.py [NAME]``

Each program is a proven one with lines put in front of its last retract, proven in a process of its own.
Times are those of the processor, and stand beside that of an anchor in the same process: the words of 100,000
lines found with one regular expression.
"""

import math
import random
import re
import resource
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
from by_control import prove
from golden_operations import made

from mechwright.errors import ProgramError

MANY = 100_000
LONGEST = 60
"""A program may take so long before it is given up, s."""
_RNG = random.Random(1)


def _places(count: int) -> list[str]:
    return [f"X{_RNG.uniform(-25, 25):.3f} Y{_RNG.uniform(-20, 20):.3f}" for _ in range(count)]


def _spiral() -> list[str]:
    out = []
    for k in range(MANY):
        reach, turn = 10 * (1 + k / MANY), k / 50
        out.append(f"G1 X{reach * math.cos(turn):.3f} Y{reach * math.sin(turn):.3f}")
    return out


def _calls() -> list[str]:
    subs = [line for k in range(10, 30_010) for line in (f"O{k} sub", "#31=1", f"O{k} endsub")]
    return subs + [f"O{_RNG.randrange(10, 30_010)} call" for _ in range(400_000)]


def _small_circles() -> list[str]:
    return [line for place in _places(MANY // 2) for line in (f"G1 {place}", "G2 I1 J0")]


def _deeper() -> list[str]:
    return [f"G1 {place} Z{-4 * k / MANY:.5f}" for k, place in enumerate(_places(MANY))]


def _up_and_down() -> list[str]:
    """Fast plunges and rapids where the bore has been cut."""
    down = "Z-3", "G1 Z-3.5 F9000", "G0 Z5"
    return [line for k in range(MANY // 4) for line in (f"G0 X{k % 40 / 40}", *down)]


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


def _pocket(z: float = -1.0, half: float = 15.0) -> list[str]:
    """A pocket around the middle in 600 passes."""
    passes = [f"G1 X{half * (-1) ** k} Y{half * (k / 300 - 1):.3f}" for k in range(601)]
    return ["G0 Z5", f"G0 X-{half} Y-{half}", f"G1 Z{z} F1000", *passes, "G1 X0 Y0"]


def _in(half: float) -> str:
    return f"X{_RNG.uniform(-half, half):.3f} Y{_RNG.uniform(-half, half):.3f}"


def _rapids_where_cleared() -> list[str]:
    return [*_pocket(), *(f"G0 {_in(14)}" for _ in range(MANY - 600))]


def _rapids_in_steps() -> list[str]:
    """A pocket in 20 steps, each smaller than the one above, and rapids all over each when it is cut."""
    out = []
    for k in range(20):
        half = 15 - k / 4
        passes = [f"G1 X{half * (-1) ** j} Y{half * (j / 20 - 1):.3f}" for j in range(41)]
        out += ["G0 Z5", f"G0 X{-half} Y{-half}", f"G1 Z{-(k + 1) / 8:.3f} F1000", *passes, "G1 X0 Y0"]
        out += [f"G0 {_in(half - 1)}" for _ in range(MANY // 20 - 44)]
    return out


def _rapids_in_slots() -> list[str]:
    """Slots along X and Y, as wide as the mill, that cross; rapids along them, from one to another."""
    at = [-14 + 10 * k for k in range(4)]
    across = [line for y in at for line in ("G0 Z5", f"G0 X-16 Y{y}", "G1 Z-1 F1000", "G1 X16")]
    along = [line for x in at for line in ("G0 Z5", f"G0 X{x} Y-16", "G1 Z-1 F1000", "G1 Y16")]
    out = [*across, *along, "G0 Z5", "G0 X-14 Y-14", "G0 Z-1"]
    while len(out) < MANY:
        out += [f"G0 X{_RNG.choice(at)}", f"G0 Y{_RNG.choice(at)}"]
    return out


def _slots_cut_and_back() -> list[str]:
    """Slot by slot: cut there, back at once, and on to the next, which shaves the wall."""
    rows = [(15 * (k / MANY - 0.5), -0.5 - k / MANY // 0.05 / 20) for k in range(MANY // 3)]
    return [
        *("G0 X-10 Y-7.5", "G1 Z-.5 F1000"),
        *(line for y, z in rows for line in (f"G1 X-10 Y{y:.4f} Z{z:g}", "G1 X10", "G0 X-10")),
    ]


def _loops_and_back() -> list[str]:
    """Slots in 60 layers of half circles, each a little further, and back over what they have cleared."""
    out = []
    for layer in range(60):
        out += ["G0 Z5", "G0 X-10 Y-6", f"G1 Z{-(layer + 1) / 40} F1000", "G1 Y6", "G1 Y-6"]
        for k in range(1, MANY // 180):
            x = f"X{-10 + k / 25:.4f}"
            out += [f"G1 {x}", f"G3 {x} Y6 I0 J6", "G0 Y-6"]
    return out


def _cut_and_rapid(deeper: float) -> list[str]:
    """A cut and a rapid in turns, anywhere in a pocket, in all by so much deeper."""
    cuts = (f"G1 {_in(14.6)} Z{-1 - deeper * k / MANY:.5f}" for k in range(MANY // 2 - 300))
    return [*_pocket(), *(line for cut in cuts for line in (cut, f"G0 {_in(14.6)}"))]


def _arcs_where_cleared() -> list[str]:
    """Links between cuts on arcs, at the full feed of the machine."""
    arcs = (f"G{_RNG.choice((2, 3))} I{_RNG.uniform(1, 7):.3f} J0" for _ in range(MANY - 600))
    return [*_pocket(), "G1 X-7 Y0", "F8000", *arcs]


def _radius_arcs() -> list[str]:
    arcs = (f"G{2 + k % 2} {_in(9)} R{_RNG.choice((20, -15))}" for k in range(MANY))
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


def _rapids_beside_walls() -> list[str]:
    """Rapids all over a pocket from places at less than two tenths of a millimetre off its walls."""
    out = _pocket()
    while len(out) < MANY:
        along, off = f"{_RNG.uniform(-15, 15):.3f}", f"{_RNG.choice((-1, 1)) * _RNG.uniform(14.81, 15):.3f}"
        out.append(_RNG.choice((f"G0 X{along} Y{off}", f"G0 X{off} Y{along}")))
    return out


def _expressions() -> list[str]:
    return ["G0 X0 Y0", "G1 Z-.5 F1000", "#31=.5", *(f"G1 X[#31*{k % 10}] Y[{k % 7}/7]" for k in range(MANY))]


def _on_and_off() -> list[str]:
    return ["G0 X60 Y0", "G1 Z1 F1000", *["G41 D23 G1 X50", "X45", "Y5", "G40 X60", "Y0"] * (MANY // 5)]


def _one_sub() -> list[str]:
    sub = ["O100 sub", "G91 G1 X.01 Y.001 F500", "G1 X-.01", "G90", "O100 endsub"]
    return [*sub, "G0 X0 Y0", "G1 Z-.5 F100", *["O100 call"] * (MANY // 2)]


def _helices() -> list[str]:
    """Down on a helix of ten half turns, anywhere, and up again."""
    out = ["G0 Z5"]
    for place in _places(MANY // 12):
        out += [f"G0 {place} Z1", "G91 G1 Z-1 F1000"]
        out += [f"G3 X{(-1) ** (k + 1) * 4} Z-.2 I{(-1) ** (k + 1) * 2}" for k in range(10)]
        out += ["G90 G0 Z5"]
    return out


def _holes_of_all_kinds() -> list[str]:
    kinds = "G81 {} Z-3 R1", "G82 {} Z-2 R1 P0.1", "G83 {} Z-3 R1 Q1", "G73 {} Z-3 R1 Q1", "G85 {} Z-2 R1"
    holes = (f"G98 {kinds[k % 5].format(place)} F100" for k, place in enumerate(_places(10_000)))
    return [*holes, "G80"]


def _arcs_in_planes() -> list[str]:
    """Half circles that scoop, in ZX and YZ by turns."""
    out = ["G0 X0 Y0", "G1 Z1 F1000"]
    for _ in range(200):
        out += [f"G1 {_in(10)}", "G91", "G18", "G3 X4 I2 K0", "G19", "G2 Y4 J2 K0", "G17", "G90"]
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


def _zigzag() -> list[str]:
    """The whole plate faced in strokes of chords, in layers of a hundredth of a millimetre."""
    out = []
    for layer in range(1, 26):
        out += ["G0 Z5", "G0 X-36 Y-31", f"G1 Z{-layer / 100} F1500"]
        for row in range(40):
            side = (-1) ** row
            out += [f"X{side * (-36 + 72 * k / 98):.3f} Y{-31 + row * 1.6:.2f}" for k in range(99)]
    return out


def _offcuts() -> list[str]:
    """Small discs cut off the frame, all over it and again."""
    out = ["G0 Z5"]
    for place in _places(MANY // 5):
        out += [f"G0 {place}", "G1 Z-4.2 F300", "G91 G2 I2.6 J0 F900", "G90 G0 Z5"]
    return out[:MANY]


def _modes_in_each() -> list[str]:
    return [f"G1 G90 G21 G17 {p} F{500 + k % 99} S{8000 + k % 50} M3" for k, p in enumerate(_places(MANY))]


CASES: dict[str, Callable[[], list[str]]] = {
    "100,000 cuts in air": lambda: ["G1 Z1 F1000", *(f"G1 {p}" for p in _places(MANY))],
    "100,000 rapids": lambda: [f"G0 {p}" for p in _places(MANY)],
    "100,000 short cuts": lambda: ["G0 X0 Y0", "G1 Z-.5 F1000", *_spiral()],
    "100,000 crossing cuts": lambda: ["G1 Z-.5 F1000", *(f"G1 {p}" for p in _places(MANY))],
    "100,000 crossing cuts, each deeper": lambda: ["F1000", *_deeper()],
    "100,000 cuts beside a wall": lambda: ["G0 X0 Y19.1", "G1 Z-4 F1000", *_beside()],
    "100,000 through cuts": lambda: ["G1 Z-4.3 F1000", *(f"G1 {p}" for p in _places(MANY))],
    "100,000 crossing circles": lambda: [
        *("G0 X0 Y0", "G1 Z-.5 F1000"),
        *(f"G2 I{_RNG.uniform(1, 20):.3f} J{_RNG.uniform(1, 20):.3f}" for _ in range(MANY)),
    ],
    "50,000 small circles": lambda: ["G1 Z-.5 F1000", *_small_circles()],
    "50,000 small through circles": lambda: ["G1 Z-4.3 F1000", *_small_circles()],
    "100,000 circles in one place": lambda: ["G0 X5 Y0", "G1 Z-1 F1000", *["G2 I-5 J0"] * MANY],
    "100,000 turns up and down": lambda: [
        *("G0 X5 Y0", "G1 Z0 F1000"),
        *["G2 X5 Y0 Z-.5 I-5 J0", "G2 X5 Y0 Z0 I-5 J0"] * (MANY // 2),
    ],
    "33,000 holes": lambda: ["G98 G81 X0 Y0 Z-1 R1 F100", *_places(MANY // 3), "G80"],
    "100,000 moves of pecks": lambda: ["G98 G83 X0 Y0 Z-3 R1 Q.4 F100", *_places(MANY // 30), "G80"],
    "100,000 rapids in stock": lambda: ["G0 Z-1", *(f"G0 {p}" for p in _places(MANY))],
    "99,400 rapids where cleared": _rapids_where_cleared,
    "100,000 rapids in slots": _rapids_in_slots,
    "100,000 rapids in a pocket of steps": _rapids_in_steps,
    "50,000 cuts and rapids in turns": lambda: _cut_and_rapid(0.0),
    "50,000 cuts and rapids, each deeper": lambda: _cut_and_rapid(2.0),
    "33,000 slots and back": _slots_cut_and_back,
    "33,000 loops and back": _loops_and_back,
    "99,400 fast arcs where cleared": _arcs_where_cleared,
    "99,400 rapids under a holder": _rapids_where_cleared,
    "99,400 arcs under a holder": _arcs_where_cleared,
    "100,000 arcs with R": _radius_arcs,
    "100,000 distances": _distances,
    "100,000 moves over a surface": _surface,
    "99,400 rapids beside walls": _rapids_beside_walls,
    "20,000 times compensation on and off": _on_and_off,
    "100,000 expressions": _expressions,
    "100,000 moves in the bore": lambda: ["G0 X0 Y0", *_up_and_down()],
    "100,000 changes of speed": lambda: [f"S{k % 9000} M3" for k in range(MANY)],
    "100,000 dwells": lambda: ["G4 P0.1"] * MANY,
    "100,000 comments": lambda: [f"(part {k})" for k in range(MANY)],
    "100,000 stops": lambda: ["M5 M9", *["M0"] * MANY],
    "100,000 changes of tool": lambda: ["M5 M9", *["T3 M6"] * MANY],
    "100,000 work offsets": lambda: [f"G5{4 + k % 2}" for k in range(MANY)],
    "100,000 retracts": lambda: ["G53 G0 Z0"] * MANY,
    "100,000 compensated cuts": lambda: ["G0 X60 Y0", *_compensated(), "G40 G1 X60"],
    "100,000 compensated cuts in stock": lambda: [
        "G0 X60 Y0",
        "G1 Z-.5 F1000",
        *_compensated(),
        "G40 G1 X60",
    ],
    "100,000 values": lambda: [f"#31=[#31+{k}]" for k in range(MANY)],
    "an endless loop": lambda: ["O1 while [1]", "#1=[#1+1]", "O1 endwhile"],
    "30,000 subs, 400,000 calls": _calls,
    "50,000 calls of one sub": _one_sub,
    "8,300 helices": _helices,
    "10,000 holes of all kinds": _holes_of_all_kinds,
    "400 arcs in ZX and YZ": _arcs_in_planes,
    "14,000 contours with compensation": _compensated_contours,
    "subs in subs": _nested,
    "90,000 moves in a loop": _looped,
    "100,000 steps of a micrometre": _tiny,
    "30 spiral pockets": _pockets,
    "5,000 rounds over tabs": _tabbed,
    "a contour at 990 depths": _same_at_depths,
    "25 times over the plate": _zigzag,
    "20,000 offcuts": _offcuts,
    "100,000 feeds and speeds": lambda: ["G1 Z1 F1000", *_modes_in_each()],
    "100,000 long comments": lambda: [
        f"G1 {p} (a long comment {k:200})" for k, p in enumerate(_places(MANY))
    ],
    "100,000 path modes": lambda: [f"G64 P0.00{1 + k % 2} Q0" for k in range(MANY)],
    "100,000 line numbers": lambda: [f"N{k % 9999} G1 {p} F900" for k, p in enumerate(_places(MANY))],
    "25,000 slots with rests": lambda: [
        "G1 Z-.5 F900",
        *(w for p in _places(MANY // 4) for w in (f"G1 {p}", "G4 P0.1", "S8000", f"G1 {p} Z-.4")),
    ],
    "pecks of a micrometre": lambda: [f"G98 G83 {p} Z-5 R1 Q.001 F100" for p in _places(1000)],
    "arcs of 1,000 turns in ZX": lambda: ["G18 F100", *(["G2 X0 Z5 I5 K0 P1000"] * 1000)],
}


def one(name: str) -> None:
    """Prove one program and tell what it took."""
    job = made("profile-outside", "linuxcnc")[0]
    lines = job.text.splitlines()
    last = next(k for k, line in enumerate(lines) if line.startswith("M9"))
    text = "\n".join([*lines[:last], "G0 Z5", *CASES[name](), "G0 Z5", *lines[last:], ""])
    words = re.compile("([A-Z])([-+.0-9]+)")
    if "holder" in name:
        short = {"flute_length": 0.5, "stick_out": 0.5, "holder_diameter": 12.0}
        tools = tuple(tool.model_copy(update=short) for tool in job.job.tools)
        job = replace(job, job=replace(job.job, tools=tools))
    start = time.process_time()
    for line in ["G1 X12.345 Y-6.789 F1000"] * MANY:
        words.findall(line)
    anchor, start = time.process_time() - start, time.process_time()
    try:
        proof = prove(text, job.job)
        said = "proven" if proof.ok else f"refused by {proof.failures[0].name}"
    except ProgramError as error:
        said = str(error)
    took, most = time.process_time() - start, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{name:34} {took:5.1f} s {took / anchor:5.1f} anchors {most:5.0f} MB  {said}", flush=True)


def main(*names: str) -> None:
    for name in names or CASES:
        call = [sys.executable, __file__, "--one", name]
        try:
            subprocess.run(call, check=True, timeout=LONGEST)
        except subprocess.TimeoutExpired:
            print(f"{name:28} more than {LONGEST} s")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        one(sys.argv[2])
    else:
        main(*sys.argv[1:])
