"""The part of the page on acceleration poles about couplers of six-bars: the formula on one more dyad."""

import math

import numpy as np

from mechwright.mechanics.planar import BodyMotion, PointMotion, Turning, acceleration_pole
from mechwright.mechanics.planar.dyad import joined
from mechwright.pipeline.figures.sheet import INK, Window, linkage
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.loop import close

FOUR = FourBar(40, 120, 80, 100)
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


def bodies(name: str, drive: Turning) -> dict[str, BodyMotion]:
    """All links; ``floating`` from C, ``second`` from E0."""
    carrier, place, long, short = SIX_BARS[name]
    found = close(FOUR, drive.theta).bodies(FOUR, drive)
    pivot = PointMotion.of(np.full(drive.theta.shape, PIVOT))
    floating, second = joined(found[carrier].point(place), pivot, long, short, 1)
    return {**found, "floating": floating, "second": second}


def left(name: str, degrees: float, ratio: float) -> float:
    """Acceleration of the pole's point of the floating link, by differences of its positions, mm/rad²."""
    phi, k = math.radians(degrees), ratio
    pole = acceleration_pole(bodies(name, Turning.of([phi], 1.0, k))["floating"])
    # From phi on the crank turns by t + k t²/2: its speed is 1 and its acceleration k there.
    times = STEP * np.arange(-2, 3)
    moved = bodies(name, Turning.of(phi + times + k * times**2 / 2, 1.0))["floating"]
    places = moved.point(pole.moving).position
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


def worst() -> float:
    """The largest of what is left of the acceleration in the poles of the table, mm/rad²."""
    return max(left(name, degrees, ratio) for name in SIX_BARS for degrees in ANGLES for ratio in RATIOS)


def picture(name: str) -> str:
    """The six-bar with the locus of the floating link's pole over a turn of the crank."""
    found = bodies(name, Turning.of(TURN, 1.0))
    at = 240  # 60 degrees
    carrier, place, long, _ = SIX_BARS[name]

    def end(body: str, where: complex) -> complex:
        return complex(found[body].point(where).position[at])

    joints = {"A0": 0j, "A": end("crank", FOUR.crank), "B": end("coupler", FOUR.coupler)}
    joints |= {"B0": complex(FOUR.ground), "C": end(carrier, place), "D": end("floating", long), "E0": PIVOT}
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
    left_over = 10.0 ** math.ceil(math.log10(worst()))
    pictures = (f"![{name}](../images/poles-six-bar-{name.lower()}.svg)" for name in SIX_BARS)
    return [
        "## Couplers of six-bars",
        "",
        "The source ends with four links. G = A − a_A/(i α − ω²) holds for any body, and a six-bar is a "
        "four-bar with one more dyad: on a point C of the coupler (Stephenson) or of the follower (Watt), "
        "the link C-D, held by D-E0. `joined` of `mechwright.mechanics.planar.dyad` gives its motion. "
        f"Four-bar 40, 120, 80, 100, E0 in ({PIVOT.real:g}, {PIVOT.imag:g}); C in (60, 50) of the coupler "
        "from A, C-D 150, or in (60, −30) of the follower from B0, C-D 130; D-E0 110 mm. At the poles below "
        f"differences of positions leave an acceleration of at most {left_over:.0e} mm/rad².",
        "",
        *table(),
        "",
        *(line for picture in pictures for line in (picture, "")),
    ]
