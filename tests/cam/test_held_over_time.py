"""The pieces of a plate while it is cut: each is held, taken out, out of the way, or the program is refused."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
import shapely
from by_control import BY_NAME
from hypothesis import given, settings
from hypothesis import strategies as st
from shop import MILL, plate_job

from mechwright.contracts.part import Part
from mechwright.geometry import Loop, Outline
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.proof import Check, Scene
from mechwright_cam.proof.footprint import NEVER, Footprint, earliest
from mechwright_cam.proof.holding import holding, remarks
from mechwright_cam.proof.machine_rules import stops
from mechwright_cam.proof.pieces import Pieces, joined
from mechwright_cam.setup.holding import Clamp
from mechwright_cam.setup.job import Job

HEAD = "G17 G21 G40 G49 G80 G90\nG53 G0 Z0\nT3 M6\nG54 S8000 M3\n"


def scene(moves: str, of: Job) -> Scene:
    return Scene(f"{HEAD}{moves}\nM30\n", of, BY_NAME["linuxcnc"])


def judged(moves: str, of: Job | None = None) -> Check:
    return holding(scene(moves, of or ringed()))


def ringed() -> Job:
    """A plate of 78 by 58 mm with a hole of 12 mm and four tabs; the mill has a radius of 3 mm."""
    return plate_job()


def around(half_x: float, half_y: float, z: float = -6.3, go_on: str = "") -> str:
    """Once around a rectangle about X0 Y0, down and up again."""
    x, y = half_x, half_y
    return f"G0 X{-x} Y{-y}\nG43 H3 Z5\nZ1\nG1 Z{z} F100\nX{x} F400\nY{y}\nX{-x}\nY{-y}\n{go_on}G0 Z5"


def test_the_frame_may_not_be_cut_off_and_passed() -> None:
    """A slit from rim to rim parts the corner of the frame from the rest; what follows passes it."""
    slit = "G0 X-65 Y-30\nG43 H3 Z5\nZ1\nG1 Z-6.3 F100\nX-40 Y-55 F400\nG0 Z5\n"
    of = replace(plate_job(), tabs=(), stock=(-60.0, -50.0, 60.0, 50.0))
    assert judged(slit, of).passed  # the offcut lies still
    assert "comes loose beside the part" in remarks(scene(slit, of))[0]
    along = "G0 X-50 Y-38\nZ1\nG1 Z-6.3 F100\nX-48 Y-40\nG0 Z5"
    again = judged(slit + along, of)
    assert not again.passed
    assert again.line == 13
    assert "T3 passes a piece of" in again.message
    assert "comes loose at line 9; leave tabs, or stop with M0 and a comment to take it out" in again.message
    assert judged(slit + along.replace("X-", "X"), of).passed  # far away
    stop = "M5\n(remove the offcut)\nM0\nS8000 M3\n"
    assert judged(slit + stop + along, of).passed
    assert not judged(slit + stop.replace("remove the offcut", "look at it") + along, of).passed
    assert not judged(slit + along + "\n" + stop, of).passed


def test_a_part_cut_free_is_told_with_the_line_that_frees_it() -> None:
    of = replace(plate_job(), tabs=())
    found = judged(around(33.001, 23.001), of)
    assert not found.passed
    assert "the part comes loose: nothing holds it when this is cut; leave tabs" in found.message
    assert found.line == 12  # the last of the four sides
    assert judged(around(33.001, 23.001, -5.7), of).passed  # a skin of 0.3 mm stays


@pytest.mark.parametrize("go_on", ["", "X-33 Y-22 F400\n"])
def test_the_clamp_has_to_be_set_before(go_on: str) -> None:
    of = replace(plate_job(), tabs=(), clamp=Clamp((0.0, 0.0), 20.0, 4.0))
    hole = "G0 X0 Y0\nG43 H3 Z5\nZ1\nG1 Z-6.3 F100\nX3 F400\nG3 I-3 J0\nG0 Z5\n"
    stop = "M5\n(clamp the part)\nM0\nS8000 M3\n"
    cut = around(33.001, 23.001, go_on=go_on)
    assert judged(hole + stop + cut, of).passed
    late = judged(hole + cut + "\n" + stop, of)
    assert not late.passed
    assert (
        "the part comes loose: nothing holds it when this is cut, and the clamp is set by the M0"
        in late.message
    )
    none = judged(hole + cut, of)
    assert not none.passed
    assert "and no M0 sets the clamp; clamp it before" in none.message
    assert judged(hole + "M0\n" + cut, of).passed
    # A stop for something else sets no clamp, if another says that it does.
    early = judged("M5\n(measure the plate)\nM0\nS8000 M3\n" + hole + cut + "\n" + stop, of)
    assert not early.passed


def test_a_stop_before_there_is_a_way_through_sets_no_clamp() -> None:
    of = replace(plate_job(), tabs=(), clamp=Clamp((0.0, 0.0), 20.0, 4.0))
    hole = "G0 X0 Y0\nG43 H3 Z5\nZ1\nG1 Z-6.3 F100\nX3 F400\nG3 I-3 J0\nG0 Z5\n"
    cut = around(33.001, 23.001)
    assert judged(hole + "M5\nM0\nS8000 M3\n" + cut, of).passed
    assert not judged("M5\nM0\nS8000 M3\n" + hole + cut, of).passed
    assert not judged("M5\n(set the clamp)\nM0\nS8000 M3\n" + hole + cut, of).passed


def test_coolant_is_off_at_stops() -> None:
    for on, off in (("M8\n", "M9\n"), ("M7\n", "M9\n")):
        wet = stops(scene(f"{on}M5\nM0", plate_job()))
        assert not wet.passed
        assert "M0 stops the program while coolant runs; write M9 before it" in wet.message
        assert stops(scene(f"{on}M5\n{off}M0", plate_job())).passed


def test_a_slug_that_lies_still_is_remarked_on() -> None:
    part = Part(
        "window",
        Outline(
            Loop.polygon([(0, 0), (80, 0), (80, 60), (0, 60)]),
            (Loop.polygon([(20, 15), (60, 15), (60, 45), (20, 45)]).reversed(),),
        ),
        6.0,
        "aluminium",
    )
    base = plate_job()
    of = Job(part, base.settings, (MILL,), (40.0, 30.0), (-60.0, -50.0, 60.0, 50.0))
    once = around(16.999, 11.999)
    assert judged(once, of).passed
    (note,) = remarks(scene(once, of))
    found = re.match(r"a piece of (\d+) mm² comes loose in opening-1, at X-0.2 Y-0.2; no cutter comes", note)
    assert found is not None
    assert int(found[1]) == pytest.approx(28 * 18, rel=0.03)
    twice = judged(once + "\n" + around(16.999, 11.999), of)
    assert not twice.passed
    assert "mm² in opening-1, X-0.2 Y-0.2, that comes loose at line 12" in twice.message


# -- the grid, and what hangs together -----------------------------------------------------------------------


@given(st.integers(0, 40), st.floats(1.0, 6.0), st.integers(0, 2**32 - 1))
@settings(deadline=None, max_examples=40)
def test_a_disc_takes_the_earliest(seeds: int, reach: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    h = int(reach)
    centres = np.full((18 + 2 * h, 23 + 2 * h), NEVER, dtype=np.int32)
    places = rng.integers(0, centres.shape, (seeds, 2))
    centres[tuple(places.T)] = rng.integers(0, 50, seeds)
    found = earliest(centres, reach)
    for row in range(18):
        for column in range(23):
            dy, dx = np.mgrid[-h : h + 1, -h : h + 1]
            near = dx**2 + dy**2 <= reach**2
            assert (
                found[row, column] == centres[row : row + 2 * h + 1, column : column + 2 * h + 1][near].min()
            )


@given(st.integers(1, 30), st.lists(st.tuples(st.integers(0, 29), st.integers(0, 29)), max_size=40))
@settings(deadline=None)
def test_groups_are_those_of_a_search(count: int, pairs: list[tuple[int, int]]) -> None:
    edges = np.array([p for p in pairs if max(p) < count], dtype=np.int64).reshape(-1, 2)
    label = joined(count, edges)
    expected = list(range(count))
    for _ in range(count):
        for a, b in edges.tolist():
            expected[a] = expected[b] = min(expected[a], expected[b])
    assert label.tolist() == expected


@given(st.integers(0, 2**32 - 1), st.integers(1, 6))
@settings(deadline=None, max_examples=60)
def test_pieces_are_those_that_a_flood_finds_at_every_step(seed: int, most: int) -> None:
    """Coarse cells so large that no piece is a chip; the plate is looked at after each step."""
    rng = np.random.default_rng(seed)
    cut = rng.integers(0, most + 1, (7, 9)).astype(np.int32)
    cut[cut == most] = NEVER
    pieces = Pieces(Footprint(0.0, 0.0, 10.0, cut, shapely.Polygon()))
    alive = [(piece, -1) for piece in pieces.whole]
    found: dict[int, set[frozenset[int]]] = {step: set() for step in range(-1, most)}
    while alive:
        piece, since = alive.pop()
        end = piece.parts if piece.into else most
        for step in range(since, end):
            mask = pieces.mask(piece, step)
            if mask.any():
                found[step].add(frozenset(np.flatnonzero(mask).tolist()))
        alive += [(one, piece.parts) for one in piece.into]
    for step in range(-1, most):
        assert found[step] == flooded(cut > step), step


def flooded(stands: np.ndarray) -> set[frozenset[int]]:  # type: ignore[type-arg]
    left = {(int(r), int(c)) for r, c in zip(*np.nonzero(stands), strict=True)}
    groups = set()
    while left:
        group, edge = set(), [left.pop()]
        while edge:
            r, c = edge.pop()
            group.add(r * stands.shape[1] + c)
            for near in ((r + 1, c), (r - 1, c), (r, c + 1), (r, c - 1)):
                if near in left:
                    left.remove(near)
                    edge.append(near)
        groups.add(frozenset(group))
    return groups


def test_a_part_in_its_tabs_is_one_piece_with_the_frame() -> None:
    from shop import plate_program

    text = LinuxCnc().write(plate_program())
    (whole,) = Scene(text, plate_job(), BY_NAME["linuxcnc"]).pieces.whole
    assert not whole.into
    assert math.isclose(plate_job().stock[2], 39.0)
