"""Rapids, and cuts between them, where cuts have cleared the way: programs for bench_bounds.py."""

from collections.abc import Callable

from bound_places import MANY, RNG, inside, places


def _up_and_down() -> list[str]:
    """Fast plunges and rapids where the bore has been cut."""
    down = "Z-3", "G1 Z-3.5 F9000", "G0 Z5"
    return [line for k in range(MANY // 4) for line in (f"G0 X{k % 40 / 40}", *down)]


def _pocket(z: float = -1.0, half: float = 15.0) -> list[str]:
    """A pocket around the middle in 600 passes."""
    passes = [f"G1 X{half * (-1) ** k} Y{half * (k / 300 - 1):.3f}" for k in range(601)]
    return ["G0 Z5", f"G0 X-{half} Y-{half}", f"G1 Z{z} F1000", *passes, "G1 X0 Y0"]


def _rapids_where_cleared() -> list[str]:
    return [*_pocket(), *(f"G0 {inside(14)}" for _ in range(MANY - 600))]


def _rapids_in_steps() -> list[str]:
    """A pocket in 20 steps, each smaller than the one above, and rapids all over each when it is cut."""
    out = []
    for k in range(20):
        half = 15 - k / 4
        passes = [f"G1 X{half * (-1) ** j} Y{half * (j / 20 - 1):.3f}" for j in range(41)]
        out += ["G0 Z5", f"G0 X{-half} Y{-half}", f"G1 Z{-(k + 1) / 8:.3f} F1000", *passes, "G1 X0 Y0"]
        out += [f"G0 {inside(half - 1)}" for _ in range(MANY // 20 - 44)]
    return out


def _rapids_in_slots() -> list[str]:
    """Slots along X and Y, as wide as the mill, that cross; rapids along them, from one to another."""
    at = [-14 + 10 * k for k in range(4)]
    across = [line for y in at for line in ("G0 Z5", f"G0 X-16 Y{y}", "G1 Z-1 F1000", "G1 X16")]
    along = [line for x in at for line in ("G0 Z5", f"G0 X{x} Y-16", "G1 Z-1 F1000", "G1 Y16")]
    out = [*across, *along, "G0 Z5", "G0 X-14 Y-14", "G0 Z-1"]
    while len(out) < MANY:
        out += [f"G0 X{RNG.choice(at)}", f"G0 Y{RNG.choice(at)}"]
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
    cuts = (f"G1 {inside(14.6)} Z{-1 - deeper * k / MANY:.5f}" for k in range(MANY // 2 - 300))
    return [*_pocket(), *(line for cut in cuts for line in (cut, f"G0 {inside(14.6)}"))]


def _arcs_where_cleared() -> list[str]:
    """Links between cuts on arcs, at the full feed of the machine."""
    arcs = (f"G{RNG.choice((2, 3))} I{RNG.uniform(1, 7):.3f} J0" for _ in range(MANY - 600))
    return [*_pocket(), "G1 X-7 Y0", "F8000", *arcs]


def _rapids_beside_walls() -> list[str]:
    """Rapids all over a pocket from places at less than two tenths of a millimetre off its walls."""
    out = _pocket()
    while len(out) < MANY:
        along, off = f"{RNG.uniform(-15, 15):.3f}", f"{RNG.choice((-1, 1)) * RNG.uniform(14.81, 15):.3f}"
        out.append(RNG.choice((f"G0 X{along} Y{off}", f"G0 X{off} Y{along}")))
    return out


def _zigzag() -> list[str]:
    """The whole plate faced in strokes of chords, in layers of a hundredth of a millimetre."""
    out = []
    for layer in range(1, 26):
        out += ["G0 Z5", "G0 X-36 Y-31", f"G1 Z{-layer / 100} F1500"]
        for row in range(40):
            side = (-1) ** row
            out += [f"X{side * (-36 + 72 * k / 98):.3f} Y{-31 + row * 1.6:.2f}" for k in range(99)]
    return out


CASES: dict[str, Callable[[], list[str]]] = {
    "100,000 rapids": lambda: [f"G0 {p}" for p in places(MANY)],
    "100,000 rapids in stock": lambda: ["G0 Z-1", *(f"G0 {p}" for p in places(MANY))],
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
    "99,400 rapids beside walls": _rapids_beside_walls,
    "100,000 moves in the bore": lambda: ["G0 X0 Y0", *_up_and_down()],
    "25 times over the plate": _zigzag,
}
