"""Figures of paths and outputs against those of the independent check, and against closed forms."""

from math import acos, hypot, pi, tau

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference_linkages import FIGURES, case
from test_linkage_catalogue import WIPER

from mechwright.contracts.design_table import with_columns
from mechwright.mechanics.linkage.kinematics.curves import Curve
from mechwright.mechanics.linkage.kinematics.figures import figures_of
from mechwright.mechanics.linkage.kinematics.path_figures import (
    Path,
    extremes,
    gait,
    output_curve,
    path_length,
    reversals,
    stance,
    straightness,
    stroke,
)
from mechwright.mechanics.planar.input_range import ranges
from mechwright.mechanics.planar.positions import solve
from mechwright.mechanics.planar.rigid import PointMotion, Turning
from mechwright_linkage.catalogue.entries import ENTRIES
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.table import LinkageTable

TURN = np.linspace(0.0, tau, 721)
EXACT = 1e-9
"""Of max(1, |value|)."""

KLANN = {"lower": hypot(26.8, 17.6), "upper": hypot(50, 13.4)}
SHAPER = {"crank": 10, "centre_distance": 25, "lever": 65, "rod": 30, "ram_height": 50}
YOKE = {"slot_angle": np.degrees(1.39626340159546), "guide_height": 5}


def near(found, expected) -> bool:
    return bool(np.all(abs(np.asarray(found) - expected) <= EXACT * np.maximum(1, np.abs(expected))))


def over_input(machine, at):
    return solve(machine, [Turning.of(at, 1.0)])


def same_angle(found, expected) -> bool:
    return near(np.angle(np.exp(1j * (np.asarray(found) - expected))), 0)


def path(name, trace="", at=TURN, **dimensions) -> Path:
    linkage = ENTRIES[name](**dimensions).linkage()
    link, point = linkage.traces[trace] if trace else next(iter(linkage.traces.values()))
    return Path.of(at, over_input(linkage.machine, at).bodies[link].point(linkage.points[link][point]))


def output(name, link="", **dimensions) -> Curve:
    linkage = ENTRIES[name](**dimensions).linkage()
    return output_curve(linkage.machine, over_input(linkage.machine, TURN), TURN, link or linkage.output)


PATHS = {"hoecken": {"crank": 10}, "klann": KLANN, "jansen": {}}


@pytest.mark.parametrize("name", PATHS)
def test_extremes_of_whole_paths(name):
    one, figures = path(name, **PATHS[name]), FIGURES[name]["path"]
    for axis, curve in (("x", one.along), ("y", one.across)):
        found = extremes(curve)
        for value, at, key in (
            (found.least, found.least_at, "min"),
            (found.greatest, found.greatest_at, "max"),
        ):
            assert near(value, figures[f"{axis}_{key}"])
            assert near(curve.at_input(figures[f"{axis}_{key}_at"]), value)
            if (name, axis, key) != ("hoecken", "y", "min"):  # three lowest points of one height
                assert same_angle(at, figures[f"{axis}_{key}_at"])
        turns = reversals(curve)
        listed = np.array([at for at, _ in figures[f"extremes_of_{axis}"]])
        distinct = listed[np.concatenate([[True], np.diff(listed) > 1e-9])]
        assert len(turns) == len(distinct)
        assert all(min(abs(np.exp(1j * turns) - np.exp(1j * at))) < EXACT for at in distinct)
        assert all(near(curve.at_input(at), value) for at, value in figures[f"extremes_of_{axis}"])
    walk = gait(one)
    assert near(walk.stride, figures["length"])
    assert near(walk.lift, figures["height"])


@pytest.mark.parametrize(("name", "height"), [("klann", 5.5), ("jansen", 1.0), ("jansen", 3.0)])
def test_stance_of_legs(name, height):
    figures = FIGURES[name][f"stance_{height:g}"]
    found = stance(path(name, **PATHS[name]), height)
    assert near(found.share, figures["share_of_turn"])
    assert same_angle(found.begin, figures["from"])
    assert near(found.end, found.begin + figures["share_of_turn"] * tau)
    assert near(found.ends, figures["x_at_ends"])
    assert near(found.travel, figures["x_travel"])
    assert found.whole_share == pytest.approx({"klann": 0.495449}.get(name, found.share), abs=1e-6), (
        "a second dip"
    )


@pytest.mark.parametrize(
    ("name", "key", "dimensions"),
    [
        ("hoecken", "straight_90_270", {"crank": 10}),
        ("hoecken", "straight_110_250", {"crank": 10}),
        ("chebyshev", "straight_from_middle_to_over_A0", {"base": 40}),
        ("roberts", "straight_crank_48_to_80_deg", {}),
    ],
)
def test_straightness(name, key, dimensions):
    figures = FIGURES[name][key]
    begin, end = figures["from"], figures["to"]
    at = TURN if name == "hoecken" else np.linspace(begin, end, 181)
    found = straightness(path(name, at=at, **dimensions), begin, end)
    assert near(found.across.least, figures["y_min"])
    assert near(found.across.greatest, figures["y_max"])
    assert near(found.ends, figures["x_at_ends"])
    assert near(found.band, figures["band"])
    assert near(found.length, figures["length"])
    assert near(found.band / found.length, figures["band_over_length"])


def test_peaucellier_line_and_limits():
    figures = FIGURES["peaucellier"]
    machine = ENTRIES["peaucellier"](crank=40).linkage().machine
    (way,) = ranges(machine).intervals
    limits = way.low, way.high
    assert near(limits, figures["driver_limits"])
    assert near(limits[1], 2 * acos(55 / 80))
    one = path("peaucellier", crank=40, at=np.linspace(*limits, 361) * (1 - 1e-13))
    assert near(one.along.value, figures["line_x"])
    assert near(one.across.value[[0, -1]], [-figures["y_at_limit"], figures["y_at_limit"]])
    inner = path("peaucellier", crank=40, at=np.linspace(*limits, 361) * 0.999)
    assert extremes(inner.along).extent < EXACT


STROKES = {"whitworth": {}, "crank_shaper": SHAPER, "toggle_press": {}, "scotch_yoke": YOKE}


@pytest.mark.parametrize("name", [*STROKES, "slider_crank"])
def test_strokes_and_time_ratios(name):
    if name == "slider_crank":
        machine = case(name).machine
        curve = output_curve(machine, over_input(machine, TURN), TURN, "slider")
    else:
        curve = output(name.replace("_", "-"), **STROKES[name])
    found, figures = stroke(curve), FIGURES[name]
    # The press counts downwards from its pivot, the reference its height.
    if name == "toggle_press":
        low, high, at_low, at_high = "greatest", "least", "driver_at_greatest", "driver_at_least"
        assert near(-found.extremes.least, figures[low])
        assert near(-found.extremes.greatest, figures[high])
        forward = tau - figures["driver_travel_from_least_to_greatest_ccw"]
        assert all(
            min(abs(np.exp(1j * reversals(curve)) - np.exp(1j * at))) < EXACT for at, _ in figures["all_ends"]
        )
    else:
        at_low, at_high = "driver_at_least", "driver_at_greatest"
        assert near(found.extremes.least, figures["least"])
        assert near(found.extremes.greatest, figures["greatest"])
        forward = figures["driver_travel_from_least_to_greatest_ccw"]
    assert same_angle(found.extremes.least_at, figures[at_low])
    assert same_angle(found.extremes.greatest_at, figures[at_high])
    assert near(found.extremes.extent, figures["stroke"])
    assert near(found.forward, forward)
    assert near(found.time_ratio, figures["time_ratio"])


def test_swing_of_the_shapers_lever():
    found, figures = stroke(output("crank-shaper", "lever", **SHAPER)), FIGURES["crank_shaper"]
    assert near(found.extremes.extent, figures["lever_swing"])
    assert near(found.time_ratio, figures["lever_time_ratio"])


@pytest.mark.parametrize("lever", ["lever1", "lever2"])
def test_swings_of_the_wiper(lever):
    curve, figures = output("wiper", lever, **WIPER), FIGURES["wiper_tandem"][lever]
    found = extremes(curve)
    assert same_angle(found.least, figures["least"])
    assert same_angle(found.greatest, figures["greatest"])
    assert near(found.extent, figures["swing"])
    assert near(reversals(curve), figures["driver_at"])


@pytest.mark.parametrize(
    ("name", "key", "dimensions"),
    [
        ("hoecken", "straight_90_270", {"crank": 10.0}),
        ("chebyshev", "straight_from_middle_to_over_A0", {"base": 40.0}),
    ],
)
def test_a_straight_line_tells_its_length_and_band(name, key, dimensions):
    one = LinkageParams(linkage=name, **{name: dimensions})
    figures = solved_figures(one)
    for figure in ("band", "length"):
        assert near(figures[f"straight_{figure}"], FIGURES[name][key][figure])
    assert same_rows(one, f"{name}.{next(iter(dimensions))}", next(iter(dimensions.values())))


def test_a_leg_tells_its_stride_lift_and_stance():
    one = LinkageParams(linkage="jansen")
    figures, path_of = solved_figures(one), FIGURES["jansen"]["path"]
    assert near(figures["stride"], path_of["length"])
    assert near(figures["lift"], path_of["height"])
    low = stance(path("jansen"), path_of["height"] / 10)
    assert near(figures["stance_share"], low.share)
    assert figures["F_length"] == pytest.approx(path_length(path("jansen")), rel=1e-9)
    assert same_rows(one, "jansen.m", 15.0)


def test_a_lever_draws_its_path_once_along():
    figures = solved_figures(LinkageParams(linkage="peaucellier"))
    assert figures["D_length"] == pytest.approx(figures["yD_range"], abs=1e-6)
    assert figures["straight_band"] < EXACT


def solved_figures(params):
    return {name: float(one()) for name, one in figures_of(LinkageTable.of(params)).items()}


def same_rows(params, key, value) -> bool:
    """Whether a row of a table has the figures of the design alone."""
    rows = value * np.array([[1.0], [1.01]])
    found = figures_of(LinkageTable(with_columns(params, {key: rows}), 2))
    return all(
        near(np.ravel(found[name]())[0], alone)
        for name, alone in solved_figures(params).items()
        if not np.isnan(alone)
    )


def test_a_link_that_turns_fully_has_no_reversals():
    found = stroke(output("whitworth", "lever"))
    assert np.isnan(found.time_ratio)
    assert near(found.extremes.extent, tau)
    assert reversals(output("whitworth", "lever")).size == 0


@given(st.floats(1, 100), st.floats(-3, 3), st.integers(1, 5), st.floats(-3, 3))
def test_figures_of_a_wave(size, phase, waves, direction):
    """A pin on a circle that a crank runs through several times, seen from any direction."""
    z = size * np.exp(1j * (waves * TURN + phase))
    n = waves
    one = Path.of(TURN, PointMotion(z, 1j * n * z, -(n**2) * z, -1j * n**3 * z), direction)
    found = extremes(one.along)
    assert near(found.extent, 2 * size)
    assert near(path_length(one), tau * size * waves)
    assert reversals(one.along).size == 2 * waves
    assert near(stance(one, 0.5 * size).whole_share, 1 / 3)
    assert near(stance(one, 0.5 * size).share, 1 / 3 / waves)
    assert np.isnan(stance(one, 3 * size).begin)
    assert stance(one, 3 * size).share == 1


def test_arrays_have_the_figures_of_each_design():
    entry = ENTRIES["jansen"]().model_copy(update={"m": np.array([[15.0], [12.0], [80.0]])})
    linkage = entry.linkage()
    found = over_input(linkage.machine, TURN).bodies["foot"].point(linkage.points["foot"]["F"])
    many = Path.of(TURN, found)
    steps, walk, length = stance(many, 1.0), gait(many), path_length(many)
    turns = reversals(many.across)
    for row, crank in enumerate((15.0, 12.0)):
        one = path("jansen", m=crank)
        single = stance(one, 1.0)
        assert near(
            (steps.share[row], steps.begin[row], steps.end[row]), (single.share, single.begin, single.end)
        )
        assert near((walk.stride[row], walk.lift[row]), (gait(one).stride, gait(one).lift))
        assert near(length[row], path_length(one))
        expected = reversals(one.across)
        assert near(turns[row, : len(expected)], expected)
        assert np.isnan(turns[row, len(expected) :]).all()
    assert np.isnan([steps.share[2], walk.stride[2], walk.lift[2], length[2]]).all()


def test_extremes_near_a_dead_point_are_those_of_the_samples():
    """The output angle of a rocker at the very end of its range: its rates are beyond all numbers there."""
    limit = acos(1 / 8) * (1 - 1e-12)
    at = np.linspace(-limit, limit, 721)
    linkage = ENTRIES["roberts"]().linkage()
    curve = output_curve(linkage.machine, over_input(linkage.machine, at), at, "rocker")
    found = extremes(curve)
    assert curve.value.min() - 1e-3 < found.least <= curve.value.min()
    assert curve.value.max() <= found.greatest < curve.value.max() + 1e-3


def test_strokes_need_a_whole_turn():
    half = np.linspace(0, pi, 181)
    wave = Curve(half, np.sin(half), np.cos(half), -np.sin(half), -np.cos(half))
    with pytest.raises(ValueError, match=r"inputs from 0 to 3\.14159 rad are no whole turn"):
        stroke(wave)
    with pytest.raises(ValueError, match="no whole turn"):
        stance(Path(wave, wave), 1.0)
