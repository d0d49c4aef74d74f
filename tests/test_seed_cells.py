"""What the five sources tabulate and draw comes out of design files: `solve` refuses none of it."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from mechwright.contracts.finding import Stage, errors
from mechwright.designs.design import load
from mechwright.plugins.host import host
from mechwright.testing.rules import motion_faults

Run = Callable[..., tuple[int, str, str]]
MOTIONS = sorted((Path(__file__).parents[1] / "examples" / "motion").glob("*.toml"))

WRITTEN = ("motion.csv", "motion.html", "summary.json")
PAGES = {
    "figure-eight-08": ["figure-eight.html"],
    "four-bar-change-point": ["poles.html"],
    "four-bar-triple-rocker": ["poles.html"],
    "slider-crank-limit": ["poles.html"],
}
"""Examples of motions to the pages that they have besides."""


def moving(family, samples=361, **parameters):
    found = host().family(family)
    params = found.Params.model_validate(parameters)
    assert errors(found.check(params), Stage.MOTION) == []
    motion = found.solve(params, samples)
    assert motion_faults(motion) == []
    return motion


@pytest.mark.parametrize("path", MOTIONS, ids=lambda path: path.stem)
def test_a_motion_is_written_though_parts_are_forbidden(path, command_line: Run, tmp_path):
    status, said, err = command_line("solve", path, "-o", tmp_path / "o")
    assert status == 0, err
    written = sorted([*WRITTEN, *PAGES.get(path.stem, [])])
    assert f"{tmp_path / 'o'}: {len(written)} files written: {', '.join(written)}\n" in said
    assert sorted(item.name for item in (tmp_path / "o").iterdir()) == sorted([*written, "manifest.json"])
    assert (
        errors(load(path, host()).family.check(load(path, host()).params)) == []
        or "written up to the motion" in err
    )
    assert path.name in (path.parent / "README.md").read_text()


# Table 3 of the elliptic trains: peak speed, mm/s, and acceleration, 1000 mm/s²; 816 stands for the misprint 82.
TRAINS = {
    0: [(263, 7.31), (945.1, 70.17), (3608, 816), (28800, 26568)],
    45: [(306.3, 5.79), (937.9, 31.87), (1798.6, 104.4), (3268.7, 333.73)],
    90: [(285.8, 3.58), (701.5, 13.71), (1168.3, 52.53), (3211.5, 328.784)],
    135: [(245.8, 3.25), (551.1, 13.07), (992.5, 51.2742), (3202, 328.14)],
    180: [(204.3, 3.25), (444.6, 12.89), (907.1, 51), (3200, 328)],
}
# Lengths of near-constant speed of table 2, rad; of cells that it leaves out as computed.
WINDOWS = {
    0: [0.752, 1.334, 1.592, 1.874],
    45: [0.575, 1.758, 1.126, 1.186],
    90: [1.562, 2.204, 0.983, 0.882],
    135: [0.921, 0.538, 0.989, 0.832],
    180: [0.594, 0.553, 0.812, 1.371],
}


@pytest.mark.parametrize("phase", TRAINS)
@pytest.mark.parametrize("place", range(4))
def test_every_cell_of_the_trains(phase, place):
    eccentricity = (0.2, 0.4, 0.6, 0.8)[place]
    motion = moving(
        "elliptic-gears",
        stages=2,
        phase=phase,
        eccentricity=eccentricity,
        speed="10 rad/s",
        band=10,
    )
    speed, acceleration = TRAINS[phase][place]
    assert motion.scalars["Q.speed.max"].value == pytest.approx(speed, rel=2e-4)
    assert motion.scalars["Q.acceleration.max"].value / 1e3 == pytest.approx(acceleration, rel=2e-3)
    length = motion.scalars["Q.constant_speed_window.length"].value
    assert length == pytest.approx(WINDOWS[phase][place], abs=6e-4)


@pytest.mark.parametrize("eccentricity", [0.2, 0.4, 0.6, 0.8])
def test_every_single_pair(eccentricity):
    motion = moving("elliptic-gears", eccentricity=eccentricity, speed="10 rad/s", band=10)
    wanted = {0.2: 0.594, 0.4: 0.553, 0.6: 0.812, 0.8: 1.371}[eccentricity]
    assert motion.scalars["Q.constant_speed_window.length"].value == pytest.approx(wanted, abs=6e-4)


# Law, half angles and offset, roller; least 1 + κ r of the island's wall, or None.
FIGURES = {
    "figure 6, law as printed": ("3-4-5", 4, 60, 0, 4, 0.357463),
    "figure 6": ("cycloidal", 4, 60, 0, 4, 0.234814),
    "undercut with loop": ("cycloidal", 4, 60, 0, 8, -0.530371),
    "neither": ("cycloidal", 4, 50, 5, 5, 0.221987),
    "undercut": ("cycloidal", 4, 50, 5, 8, -0.244821),
    "undercut, six slots": ("cycloidal", 6, 60, 8, 5, -0.097205),
    "three slots": ("cycloidal", 3, 60, 8, 5, 0.845286),
}


@pytest.mark.parametrize("case", FIGURES)
def test_every_slot_of_the_geneva(case):
    law, slots, half, offset, roller, least = FIGURES[case]
    from mechwright_geneva.defaults.dimensions import mechanism_of
    from mechwright_geneva.kinematics.geometry import RIGHT
    from mechwright_geneva.parameters import GenevaParams

    parameters = {
        "law": law,
        "slots": slots,
        "crank_half_angle": half,
        "offset_angle": offset,
        "roller_radius": roller,
        "entry_radius": 100,
    }
    motion = moving("geneva", **parameters)
    assert motion.scalars["index_angle"].value == pytest.approx(2 * math.pi / slots)
    assert {f"slot-{k}-{side}" for k in range(1, slots + 1) for side in ("left", "right")} <= set(
        motion.curves
    )
    run = mechanism_of(GenevaParams.model_validate(parameters)).stroke(np.linspace(0, 1, 4001))
    assert run.regularity(roller, RIGHT).min() == pytest.approx(least, abs=2e-6)


# Where the walls of one slot cross in figure 6: x = -y, mm.
LOOPS = {
    "cycloidal": 56.667614,
    "3-4-5": 57.774885,
    "modified-sine": 58.563640,
    "modified-trapezoid": 58.140884,
    "simple-harmonic": 61.683503,
}


@pytest.mark.parametrize("law", LOOPS)
def test_the_loop_of_figure_6_is_where_the_page_draws_it(law):
    motion = moving("geneva", law=law, crank_half_angle=60, offset_angle=0, roller_radius=4)
    wall = motion.curves["slot-1-right"].points[:, :2] @ (1, 1)  # 0 on the slot's axis
    points = motion.curves["slot-1-right"].points[:, 0]
    half = len(wall) // 2
    crossings = np.flatnonzero(wall[: half - 1] * wall[1:half] < 0)
    assert len(crossings) == 1
    k = int(crossings[0])
    share = wall[k] / (wall[k] - wall[k + 1])
    assert points[k] + share * (points[k + 1] - points[k]) == pytest.approx(LOOPS[law], abs=2e-3)


# Crank, rod, offset, stroke and time ratio: exact answers, then the document's own triples.
STROKES = [
    (51.237104829, 113.283055271, 50, 120, 1.5),
    (35, 161.543563453, 121.824973347, 120, 1.5),
    (46.860235171, 130, 72.023865998, 120, 1.5),
    (50, 115, 50, 115.7087, 1.44308),
    (45, 130, 70.3, 112.4791, 1.43428),
]


@pytest.mark.parametrize("case", STROKES)
def test_every_answer_of_the_offset_slider_crank(case):
    crank, rod, offset, stroke, ratio = case
    found = moving("slider-crank", crank=crank, rod=rod, offset=offset).scalars
    assert found["stroke"].value == pytest.approx(stroke, abs=1e-4)
    assert found["time_ratio"].value == pytest.approx(ratio, abs=1e-5)


def test_the_answer_whose_crank_cannot_turn_is_a_lever():
    found = moving("slider-crank", crank=35, rod=160, offset=127).scalars
    assert found["input_range"].value < 360


def test_the_ends_of_the_family_of_slider_cranks():
    for degrees in (5, 10, 20, 30, 40, 50, 54):
        angle, theta = math.radians(degrees), math.radians(36)
        a = 120 * math.cos(angle + theta / 2) / (2 * math.cos(theta / 2))
        b = 120 * math.sin(angle + theta / 2) / (2 * math.sin(theta / 2))
        e = 120 * math.sin(angle) * math.sin(angle + theta) / math.sin(theta)
        found = moving("slider-crank", crank=a, rod=b, offset=e).scalars
        mark = "assembly_" if degrees == 54 else ""
        assert found[f"{mark}stroke"].value == pytest.approx(120, abs=1e-6)
        assert found[f"{mark}time_ratio"].value == pytest.approx(1.5, abs=1e-8)


@pytest.mark.parametrize(
    ("crank", "rod", "offset"),
    [
        (1, 3, "1/2"),
        (2, 1, "1/3"),
        (1, "5/2", 0),
        (1, "3/2", "1/2"),
        (3, 1, 2),
        (3, 5, 2),
        (2, 2, 1),
        (8, 3, 5),
    ],
)
def test_the_poles_of_the_slider_crank_lie_on_their_locus(crank, rod, offset):
    from fractions import Fraction

    from mechwright_slider_crank.kinematics.locus import locus

    exact = [Fraction(value) for value in (crank, rod, offset)]
    curve = locus(*exact, "fixed")[0]
    a, c, e = map(float, exact)
    motion = moving("slider-crank", 73, crank=a, rod=c, offset=e)
    x, y = motion.channels["xG"].values, motion.channels["yG"].values
    if motion.rocks:  # the source's locus is that of a constant speed, which a lever has nowhere
        from mechwright.mechanics.planar import acceleration_pole
        from mechwright_slider_crank.parameters import SliderCrankParams

        linkage = SliderCrankParams(crank=a, rod=c, offset=e).linkage
        pole = acceleration_pole(linkage.bodies(motion.channels["phi"].values, 1.0).rod).fixed
        x, y = pole.real, pole.imag
    for one, two in zip(x, y, strict=True):
        place = Fraction(one), Fraction(two)
        terms = [
            value * (place[0] ** 2 + place[1] ** 2) ** i * place[1] ** j
            for (i, j), value in curve.terms.items()
        ]
        assert abs(float(sum(terms) / sum(map(abs, terms)))) < 1e-12


STRUCTURAL = {
    0.5: (0.10723, 0.03920),
    0.75: (0.11685, 0.03977),
    1: (0.11408, 0.03772),
    1.5: (0.09496, 0.03117),
    2: (0.07419, 0.02457),
    3: (0.04490, 0.01513),
    5: (0.01971, 0.00676),
    8: (0.00831, 0.00289),
    12: (0.00380, 0.00134),
    22: (0.00114, 0.00043),
}
PATH = [(0.2757, 1.8649), (0.3574, 1.7945), (0.4208, 1.6891)]
PATH_N = [(0.3565, 1.9073), (0.5237, 1.8872)]


@pytest.mark.parametrize("length", STRUCTURAL)
@pytest.mark.parametrize("phase", [1, 2])
def test_every_projection_length_of_the_five_bar(length, phase):
    table = {
        "projection_length": length,
        "path": PATH,
        "path_angles": [-10, -20, -30],
        "path_n": PATH_N,
        "path_angles_n": [-10, -20],
        "phase": phase,
    }
    found = moving("spherical", 61, radius=100, five_bar=table).scalars
    errors_ = (found["path_error_max"].value, found["path_error_max_n"].value)
    assert [error * length / 100 for error in errors_] == pytest.approx(STRUCTURAL[length], abs=2e-5)


def test_every_link_of_the_locus_table_of_four_bars_moves():
    for lengths in ((2, 5, 6, 7), (3, 5, 6, 8), (5, 6, 7, 2), (2, 2, 3, 3), (2, 3, 2, 3), (3, 4, 4, 6)):
        names = ("crank", "coupler", "follower", "ground")
        moving("four-bar", 91, **dict(zip(names, lengths, strict=True)))
