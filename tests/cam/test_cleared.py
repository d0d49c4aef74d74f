"""Many moves are told to be clear at once: quickly, never wrongly, and as the exact answer has it."""

import random
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest
from by_control import BY_NAME
from hypothesis import given, settings
from hypothesis import strategies as st
from shop import plate_job

from mechwright.arrays import Array
from mechwright_cam.proof import Scene
from mechwright_cam.proof import swept_area as module
from mechwright_cam.proof.entry_rules import rapids_in_stock
from mechwright_cam.proof.removal_time import Tracks
from mechwright_cam.proof.stock import Stock

HEAD = "G17 G21 G40 G49 G80 G90\nG53 G0 Z0\nT3 M6\nG54 S8000 M3\nG0 X0 Y0\nG43 H3 Z5\n"
"""A mill of 6 mm, in a plate of 78 by 58 by 6 mm."""


def scene(lines: list[str]) -> Scene:
    return Scene(HEAD + "\n".join(lines) + "\nM30\n", plate_job(), BY_NAME["linuxcnc"])


def fresh(of: Scene) -> Stock:
    """The stock, knowing nothing of what has been asked before."""
    return Stock(of.paths, of.job)


def pocket(z: float, x0: float = -12, x1: float = 12) -> list[str]:
    """Passes that clear all between two X, and from Y-10 to Y10, with a pass along each wall at last."""
    rows = [f"G1 X{(x0, x1)[k % 2]:g} Y{k - 10}" for k in range(21)]
    round_ = [f"G1 X{x0} Y10", f"X{x0} Y-10", f"X{x1}", "Y10", f"X{x0}"]
    return ["G0 Z5", f"G0 X{x0} Y-10", f"G1 Z{z} F500", *rows, *round_]


PLACES = st.sampled_from([-9.0, -6.0, -5.95, -3.0, 0.0, 0.004, 0.05, 2.5, 6.0, 9.0])
DEPTHS = st.sampled_from(["-1", "-1.5", "-2"])
MOVES = st.one_of(
    st.builds("G1 X{} Y{} Z{}".format, PLACES, PLACES, DEPTHS),
    st.builds("G1 X{} Z{}".format, PLACES, DEPTHS),
    st.builds("G1 Y{}".format, PLACES),
    st.builds("G2 I{} J{}".format, st.sampled_from([1.0, 3.0]), st.sampled_from([0.0, 2.0])),
    st.builds("G0 X{} Y{}".format, PLACES, PLACES),
    st.builds("G0 X{}".format, PLACES),
    st.builds("G0 Y{}".format, PLACES),
    st.builds("G0 Z{}".format, st.sampled_from(["-1", "-1.2", "-2", "1"])),
)


@settings(max_examples=12, deadline=None)
@given(
    moves=st.lists(MOVES, min_size=4, max_size=12),
    lift=st.sampled_from([0.0, 0.5]),
    radius=st.sampled_from([None, 1.0, 2.9, 5.0]),
)
def test_what_is_told_to_be_clear_is_clear_and_places_are_where_it_is_not(
    moves: list[str], lift: float, radius: float | None
) -> None:
    of = scene(["G1 Z-1 F500", *moves])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "FEW", 1)
        told = fresh(of)
        steps = of.paths.steps
        suspects = set(told.suspects(steps, lift=lift, radius=radius).tolist())
    for step in steps.tolist():
        exact = fresh(of).meets(step, lift=lift, radius=radius)
        assert step in suspects or not exact, step
        assert told.meets(step, lift=lift, radius=radius) == exact, step


def low_rapids(of: Scene) -> tuple[int, int]:
    """How many rapids are below the top, and of how many the quick answer knows nothing."""
    paths = of.paths
    steps = paths.rapids[paths.low[paths.rapids] < 0]
    return steps.size, fresh(of).suspects(steps).size


def test_rapids_in_pockets_and_slots_are_told_without_a_single_question() -> None:
    rng = random.Random(5)  # noqa: S311 - a fixed sample
    inside = [f"G0 X{rng.uniform(-11, 11):.3f} Y{rng.uniform(-9, 9):.3f}" for _ in range(200)]
    along = [f"G0 X{rng.uniform(-12, 12):.3f}" for _ in range(100)]
    wall = [
        f"G0 {axis}{rng.choice(ends)}"
        for _ in range(100)
        for axis, ends in (("X", (-12, 12)), ("Y", (-10, 10)))
    ]
    slot = [
        "G0 Z5",
        "G0 X-20 Y20",
        "G1 Z-1 F500",
        "G1 X20",
        "G1 X0 Y20",
        *(f"G0 X{rng.uniform(-20, 20):.3f}" for _ in range(100)),
    ]
    for lines in ([*pocket(-1), *inside], [*pocket(-2), *along], [*pocket(-1), *wall], slot):
        count, unknown = low_rapids(scene(lines))
        assert count >= 100
        assert unknown == 0


@dataclass(frozen=True)
class Fault:
    """A rapid into material behind many that are clear."""

    cut: list[str]
    fault: str


FAULTS = {
    "a rib of 0.05 mm between two pockets": Fault(
        [*pocket(-1, -12, -3.025), *pocket(-1, 3.025, 12), "G0 Z5", "G0 X6 Y0", "G0 Z-1"], "G0 X-6"
    ),
    "the same rib, past it in a rectangle": Fault(
        [*pocket(-1, -12, -3.025), *pocket(-1, 3.025, 12), "G0 Z5", "G0 X6 Y0", "G0 Z-1"], "G0 X-6 Y5"
    ),
    "deeper than was cut": Fault([*pocket(-1), "G0 Z5", "G0 X6 Y0"], "G0 Z-1.01"),
    "0.02 mm beyond a wall": Fault(pocket(-1), "G0 X12.02"),
    "before it is cut, what is cut later": Fault(pocket(-1), "G0 Y12\nG1 X-12 Y12\nG0 X12"),
    "around the corner of a slot": Fault(["G1 Z-1 F500", "G1 X20", "G1 Y20", "G0 Y0", "G0 X5"], "G0 X20 Y20"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_one_rapid_into_material_is_found_among_many(name: str) -> None:
    fault = FAULTS[name]
    x = 5 if "X6 Y0" in "".join(fault.cut) else 10
    many = [f"G0 X{x + k % 9 / 10}" for k in range(100)]
    clear_of_it = scene([*fault.cut, *many])
    assert rapids_in_stock(clear_of_it).passed, rapids_in_stock(clear_of_it).message
    found = rapids_in_stock(scene([*fault.cut, *many, fault.fault]))
    assert not found.passed
    assert found.line == len(HEAD.splitlines()) + len(fault.cut) + len(many) + 1


@given(
    lines=st.lists(st.tuples(*[st.integers(0, 6)] * 3), min_size=0, max_size=12),
    asked=st.lists(st.tuples(*[st.integers(-1, 13)] * 2, st.integers(-1, 7)), min_size=1, max_size=12),
)
def test_the_latest_step_of_a_track_is_that_of_its_last_piece(
    lines: list[tuple[int, int, int]], asked: list[tuple[int, int, int]]
) -> None:
    first = np.array([(a, c) for a, _, c in lines], dtype=float).reshape(-1, 2)
    last = np.array([(b, c) for _, b, c in lines], dtype=float).reshape(-1, 2)
    tracks = Tracks(first, last, np.arange(len(lines)), 0)
    low, high = (np.array([(f(a, b) / 2, c) for a, b, c in asked], dtype=float) for f in (min, max))
    for found, (x0, y), (x1, _) in zip(tracks.latest(low, high).tolist(), low, high, strict=True):
        places = np.arange(x0, x1 + 0.125, 0.25)
        over = [
            [k for k, (a, b, c) in enumerate(lines) if c == y and min(a, b) <= x <= max(a, b)] for x in places
        ]
        expected = max(steps[0] for steps in over) if all(over) else None
        assert found == expected if expected is not None else found > len(lines)


def test_of_many_heights_a_few_are_looked_at_and_common_ones_stay() -> None:
    rng = np.random.default_rng(5)
    steps, cuts = np.repeat([-3.0, -2.0, -1.0], 2000), 100_000
    every = np.concatenate((steps, rng.uniform(-4.0, -0.1, 3000)))
    levels = module._levels(every, cuts)
    assert levels.size <= module.MOST_TAKEN // cuts
    assert levels[0] < every.min()
    for step in (-3.0, -2.0, -1.0):
        assert np.abs(levels - (step - module.NEAR / 2)).min() < module.NEAR / 4
    assert module._levels(every, 1000).size > 2 * levels.size
    assert module._levels(steps, cuts).size == 3


@pytest.mark.parametrize("axis", [0, 1])
def test_a_strip_is_as_wide_as_the_disc_at_its_share_and_goes_up_to_another(axis: int) -> None:
    """Of a disc of 5 mm between 0.6 and 0.8 of its radius: 4 mm to either side, and 4 mm up or down."""
    asked: list[list[float]] = []

    class Area:
        def latest(self, low: Array, high: Array) -> Array:
            asked.append([*low[0].tolist(), *high[0].tolist()])
            return np.zeros(len(low), dtype=np.int64)

    low, high = np.array([[1.0, 2.0]]), np.array([[11.0, 22.0]])
    for up in (0.8, -0.8):
        one = (np.array([value]) for value in (5.0, 0.6, up))
        module._Level._strips(SimpleNamespace(area=Area()), axis, low, high, *one)
    below, above = ([4.0, 4.0] for _ in range(2))
    for found, way in zip(asked, (1, -1), strict=True):
        below[axis], above[axis] = (0.0, 4.0) if way > 0 else (4.0, 0.0)
        assert found == pytest.approx([1 - below[0], 2 - below[1], 11 + above[0], 22 + above[1]])
