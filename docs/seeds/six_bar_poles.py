"""The part of the page on acceleration poles about six-bars: on the ground, and of links to links."""

import math
from collections.abc import Mapping

import numpy as np

from mechwright.mechanics.planar import BodyMotion, Turning, acceleration_pole
from mechwright.mechanics.planar.machine import Drive, Machine, Revolute
from mechwright.mechanics.planar.positions import solve
from mechwright.mechanics.planar.relative_motion import relative, relative_pole
from mechwright.pipeline.figures.sheet import INK, Window, linkage

CRANK, COUPLER, FOLLOWER, GROUND = 40, 120, 80, 100
PIVOT = 190 + 80j
"""E0 of the second follower, mm from A0."""

SIX_BARS = {
    "Stephenson": ("coupler", 60 + 50j, 150.0, 110.0),
    "Watt": ("follower", 60 - 30j, 130.0, 110.0),
}
"""The body that carries C, and where; lengths of the floating link C-D and of the follower E0-D, mm."""

TURN = np.linspace(0, math.tau, 1441)
ANGLES, RATIOS = (60, 200, 300), (0.0, 0.5)
STEP = 1e-3
"""rad, of the differences that the poles are compared with."""


def machine(name: str) -> Machine:
    """The four-bar A0 A B B0, and the links ``floating`` from C to D and ``second`` from E0 to D."""
    carrier, place, long, short = SIX_BARS[name]
    joints = [
        Revolute("A0", "ground", "crank", 0, 0),
        Revolute("A", "crank", "coupler", CRANK, 0),
        Revolute("B", "coupler", "follower", COUPLER, FOLLOWER),
        Revolute("B0", "ground", "follower", GROUND, 0),
        Revolute("C", carrier, "floating", place, 0),
        Revolute("D", "floating", "second", long, short),
        Revolute("E0", "ground", "second", PIVOT, 0),
    ]
    return Machine(joints, [Drive("crank")])


def bodies(name: str, drive: Turning) -> Mapping[str, BodyMotion]:
    """All links."""
    return solve(machine(name), [drive]).bodies


def left(name: str, degrees: float, ratio: float, seen_from: str = "ground") -> float:
    """Acceleration of the pole's point of the floating link, by differences of its positions, mm/rad².

    Pole and positions are those that ``seen_from`` sees.
    """
    phi, k = math.radians(degrees), ratio
    found = bodies(name, Turning.of([phi], 1.0, k))
    pole, _ = relative_pole(found["floating"], found[seen_from])
    # From phi on the crank turns by t + k t²/2: its speed is 1 and its acceleration k there.
    times = STEP * np.arange(-2, 3)
    moved = bodies(name, Turning.of(phi + times + k * times**2 / 2, 1.0))
    places = relative(moved["floating"], moved[seen_from]).point(pole.moving).position
    return float(abs(np.array([-1, 16, -30, 16, -1]) @ places) / (12 * STEP**2))


def table() -> list[str]:
    rows = [
        "| six-bar, φ | k | ω/ωa | α/ωa² | G on the ground | G in the link |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for name in SIX_BARS:
        for degrees in ANGLES:
            for ratio in RATIOS:
                link = bodies(name, Turning.of([math.radians(degrees)], 1.0, ratio))["floating"]
                pole = acceleration_pole(link)
                g, own = complex(pole.fixed[0]), complex(pole.moving[0])
                first = f"{name}, {degrees}°" if ratio == RATIOS[0] else ""
                rows.append(
                    f"| {first} | {ratio:g} | {link.turning.omega[0]:.9f} | {link.turning.alpha[0]:.9f} | "
                    f"{g.real:.6f}, {g.imag:.6f} | {own.real:.6f}, {own.imag:.6f} |"
                )
    return rows


SEEN_FROM = {"Stephenson": ("crank", "follower"), "Watt": ("crank", "coupler")}
"""Links to which C-D is not pinned: of one that it is pinned to the pole is the pin."""


def relative_table() -> list[str]:
    rows = [
        "| six-bar, φ | seen from | relative ω/ωa | relative α/ωa² | G there | G in C-D | G on the ground |",
        "| --- | --- | --- | --- | --- | --- | --- |",
    ]
    for name in SIX_BARS:
        for degrees in ANGLES:
            found = bodies(name, Turning.of([math.radians(degrees)], 1.0))
            for seen_from in SEEN_FROM[name]:
                link = relative(found["floating"], found[seen_from]).turning
                pole, ground = relative_pole(found["floating"], found[seen_from])
                places = (complex(one[0]) for one in (pole.fixed, pole.moving, ground))
                first = f"{name}, {degrees}°" if seen_from == SEEN_FROM[name][0] else ""
                cells = (f"{place.real:.6f}, {place.imag:.6f}" for place in places)
                rates = f"{link.omega[0]:.9f} | {link.alpha[0]:.9f}"
                rows.append(f"| {first} | {seen_from} | {rates} | {' | '.join(cells)} |")
    return rows


def worst() -> tuple[float, float]:
    """The largest of what is left of the acceleration in the poles of both tables, mm/rad²."""
    ground = max(left(name, at, ratio) for name in SIX_BARS for at in ANGLES for ratio in RATIOS)
    links = max(left(name, at, 0.0, one) for name in SIX_BARS for at in ANGLES for one in SEEN_FROM[name])
    return ground, links


def picture(name: str) -> str:
    """The six-bar with the locus of the floating link's pole over a turn of the crank."""
    found = bodies(name, Turning.of(TURN, 1.0))
    at = 240  # 60 degrees
    carrier, place, long, _ = SIX_BARS[name]

    def end(body: str, where: complex) -> complex:
        return complex(found[body].point(where).position[at])

    joints = {"A0": 0j, "A": end("crank", CRANK), "B": end("coupler", COUPLER)}
    joints |= {"B0": complex(GROUND), "C": end(carrier, place), "D": end("floating", long), "E0": PIVOT}
    own = {"coupler": ("A", "B"), "follower": ("B0", "B")}[carrier]
    pairs = (("A0", "A"), ("A", "B"), ("B0", "B"), (own[0], "C"), (own[1], "C"), ("C", "D"), ("E0", "D"))
    locus = acceleration_pole(found["floating"]).fixed
    window = Window(-250 - 250j, 450 + 450j)
    inside = (np.abs(locus.real - 100) < 350) & (np.abs(locus.imag - 100) < 350)
    shown = np.where(inside, locus, np.nan + 0j)
    drawn = [window.line(shown, "#b3261e", 1.4)]
    drawn += linkage(window, joints, [[joints[one], joints[two]] for one, two in pairs])
    drawn.append(window.dot(complex(locus[at]), "#b3261e", "G", 1.3))
    key = window.key([(f"{name}: pole of the link C-D over a turn", INK)])
    return window.picture([*drawn, window.scale(), key], f"acceleration poles of a {name} six-bar")


def six_bars() -> list[str]:
    """The part of the page."""
    on_ground, of_links = (10.0 ** math.ceil(math.log10(value)) for value in worst())
    pictures = (f"![{name}](../images/poles-six-bar-{name.lower()}.svg)" for name in SIX_BARS)
    return [
        "## Six-bars",
        "",
        "The source ends with four links. G = A − a_A/(i α − ω²) holds for any body. A six-bar is a four-bar "
        "with one more dyad: the link C-D on a point C of the coupler (Stephenson) or of the follower "
        "(Watt), guided by D-E0. `mechwright.mechanics.planar` solves such machines; the family "
        "[`linkage`](../linkage.md) builds them.",
        "",
        f"Four-bar 40, 120, 80, 100 mm, E0 in ({PIVOT.real:g}, {PIVOT.imag:g}), D-E0 110 mm. Stephenson: C "
        "in (60, 50) of the coupler from A, C-D 150 mm. Watt: C in (60, −30) of the follower from B0, C-D "
        f"130 mm. Differences of positions leave at most {on_ground:.0e} mm/rad² of acceleration there.",
        "",
        *table(),
        "",
        "With the relative motion the formula gives the pole of any link relative to any other. The table "
        "has the point of C-D without acceleration relative to two links: the crank, and the link of the "
        "four-bar that C-D is not pinned to. The crank's speed is constant. For links pinned to each "
        f"other the pole is the pin. Differences of the relative positions leave at most {of_links:.0e} "
        "mm/rad².",
        "",
        *relative_table(),
        "",
        *(line for picture in pictures for line in (picture, "")),
    ]
