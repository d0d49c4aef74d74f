"""What a body may do between three poses: the bounds of the sweep against the motion itself."""

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from mechwright_cad.interference.boxes import Boxes, stay_apart
from mechwright_cad.interference.instants import SAG, Poses, second
from mechwright_cad.interference.path import Path, space_path
from mechwright_cad.interference.separation import gap_along

N = 181
TURN = np.linspace(0, math.tau, N)
DENSE = np.linspace(0, 1, 33)
coordinate = st.floats(-1, 1)
vector = st.tuples(coordinate, coordinate, coordinate)


@st.composite
def paths(draw):
    """A body that swings and turns, smoothly but not evenly."""
    axis = np.array(draw(st.tuples(coordinate, coordinate, st.floats(0.2, 1))))
    angle = draw(st.sampled_from([0, 1, 3])) * TURN + draw(st.floats(0, 1)) * np.sin(TURN + draw(coordinate))
    swing, beat = 20 * np.array(draw(vector)), 9 * np.array(draw(vector))
    place = np.sin(TURN)[:, None] * swing + np.cos(2 * TURN)[:, None] * beat
    return space_path(Rotation.from_rotvec(angle[:, None] * axis / np.linalg.norm(axis)).as_matrix(), place)


def along_the_interval(path, start, step, points):
    """Points (k, 3) at all ``DENSE`` times of some intervals (n,): (times, k, 3, n)."""
    moved = []
    for part in DENSE:
        turn, place = path.at(start + part * step)
        moved.append(np.einsum("nij,kj->kin", turn, points) + place.T)
    return np.array(moved)


@settings(max_examples=30)
@given(paths(), st.lists(vector, min_size=1, max_size=4), st.lists(vector, min_size=1, max_size=3))
def test_a_point_leaves_its_chords_by_no_more_than_the_bound(path, places, axes):
    points = 40 * np.array(places)
    for step in (1.0, 0.25):
        start = np.arange(0, N - 1, 7) + 0.5 * (step < 1)
        poses = Poses.of(path, start, step)
        true = along_the_interval(path, start, step, points)
        for k, point in enumerate(points):
            chords = poses.move(np.repeat(point[:, None], start.size, axis=1))
            wander = poses.wander(np.full(start.size, np.linalg.norm(point)))
            for axis in (np.array(axis) for axis in axes):
                ends = np.einsum("pin,i->pn", chords, axis)
                straight = np.array([np.interp(DENSE, (0, 0.5, 1), column) for column in ends.T]).T
                off = np.abs(np.einsum("tin,i->tn", true[:, k], axis) - straight).max(axis=0)
                bound = SAG * np.abs(axis @ second(chords)) + np.linalg.norm(axis) * wander
                assert (off <= bound + 1e-12).all()


def test_a_straight_slide_and_a_turn_about_an_axis_bend_in_one_direction_only():
    slide = Path(np.column_stack((30 * np.cos(TURN), 0 * TURN, 0 * TURN)), np.tile((1.0, 0, 0, 0), (N, 1)))
    poses = Poses.of(slide, np.arange(N - 1.0), 1.0)
    bend = second(poses.move(np.ones((3, N - 1))))
    assert np.abs(bend[0]).max() > 0.009
    assert np.abs(bend[1:]).max() == 0
    assert poses.wander(np.full(N - 1, 100.0)).max() < 0.1 * np.abs(bend[0]).max()
    spun = space_path(Rotation.from_rotvec(TURN[:, None] * (0, 0, 1.0)).as_matrix(), np.zeros((N, 3)))
    arms = Poses.of(spun, np.arange(N - 1.0), 1.0)
    bend = second(arms.move(np.repeat([[50.0], [0], [7]], N - 1, axis=1)))
    assert np.abs(bend[2]).max() < 1e-12
    assert np.abs(arms.wander(np.full(N - 1, 50.0))).max() < 0.02 * np.abs(bend[:2]).max()


@settings(max_examples=30)
@given(
    paths(),
    st.lists(st.tuples(vector, vector, vector), min_size=2, max_size=2, unique=True),
    st.floats(5, 60),
)
def test_boxes_that_stay_apart_are_apart_at_every_instant(path, triangles, away):
    fixed, moving = (12 * np.array([triangle]) for triangle in triangles)
    fixed = fixed + np.array((away, 0.0, 0.0))
    boxes = [Boxes.of(corners, 1).take(np.ones(N - 1, dtype=np.int64)) for corners in (fixed, moving)]
    start = np.arange(N - 1.0)
    poses = Poses.of(path, start, 1.0)
    apart = stay_apart(*boxes, poses)
    here = np.repeat(fixed[0][:, :, None], N - 1, axis=2)
    true = along_the_interval(path, start, 1.0, moving[0])
    across = poses.turn(boxes[1].normal)
    shown = np.zeros((2, N - 1), dtype=bool)
    for place, axis in enumerate((boxes[0].normal, across)):
        gaps = np.array([gap_along(here, points, axis) for points in true])
        shown[place] = (gaps > 0).all(axis=0)
    assert (shown.any(axis=0) | ~apart).all()
