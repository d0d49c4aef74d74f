"""The time estimate of a usual control against an integration of the same model along the path in tiny steps."""

import math

import numpy as np
import pytest
from by_control import interpret, setup_html
from hypothesis import given, settings
from hypothesis import strategies as st
from planning_parts import bore, job, plate

from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.controls.lookahead.default import CORNER_JUMP
from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.machining import machine as build
from mechwright_cam.proof.timing import step_times
from mechwright_cam.shop.machine import Machine

STEP = 0.004  # mm


def integrated(run: Run, machine: Machine) -> float:
    """Time of all moves, s: every move cut to tiny pieces, each with its own limit; then what acceleration
    permits from piece to piece, forwards and backwards, and the sum of length over mean speed."""
    acceleration = machine.acceleration * 1000
    points, caps = [], []
    for k in range(len(run)):
        if (
            run.kind[k] not in (Kind.RAPID, Kind.FEED, Kind.ARC)
            or not np.isfinite([run.start[k], run.end[k]]).all()
        ):
            continue
        start, end = run.start[k], run.end[k]
        speed = machine.rapid if run.kind[k] == Kind.RAPID else min(run.feed[k], machine.max_feed)
        speed /= 60
        count = max(2, math.ceil(run.length[k] / STEP) + 1)
        t = np.linspace(0, 1, count)
        piece = start + (end - start) * t[:, None]
        if run.kind[k] == Kind.ARC:
            centre = run.centre[k]
            first = math.atan2(start[1] - centre[1], start[0] - centre[0])
            angle = first + run.sweep[k] * t
            piece[:, 0] = centre[0] + run.radius[k] * np.cos(angle)
            piece[:, 1] = centre[1] + run.radius[k] * np.sin(angle)
            speed = min(speed, math.sqrt(acceleration * run.radius[k]))
        elif run.kind[k] == Kind.RAPID and machine.rapid_z is not None:
            along = (end - start) / max(np.linalg.norm(end - start), 1e-12)
            # Each axis by itself keeps its limit.
            for part, limit in ((np.hypot(*along[:2]), machine.rapid), (abs(along[2]), machine.rapid_z)):
                speed = min(speed, limit / 60 / part if part > 1e-9 else math.inf)
        if np.linalg.norm(np.diff(piece, axis=0), axis=1).sum() < 1e-6:
            continue
        points.append(piece)
        caps.append(np.full(count, speed))
    # Junctions: the corner between the last piece of one move and the first of the next.
    cap = []
    for k, (piece, own) in enumerate(zip(points, caps, strict=True)):
        own = own.copy()
        for other, mine, theirs, at in ((k - 1, (0, 1), (-2, -1), 0), (k + 1, (-2, -1), (0, 1), -1)):
            if not 0 <= other < len(points):
                own[at] = 0.0
                continue
            here, there = piece[mine[1]] - piece[mine[0]], points[other][theirs[1]] - points[other][theirs[0]]
            turn = np.linalg.norm(here / np.linalg.norm(here) - there / np.linalg.norm(there))
            own[at] = min(own[at], caps[other][0], CORNER_JUMP / 60 / max(turn, 1e-6))
        cap.append(own)
    if not points:
        return 0.0
    path, cap = np.concatenate(points), np.concatenate(cap)
    ds = np.linalg.norm(np.diff(path, axis=0), axis=1)
    v2 = (cap**2).tolist()
    gain = (2 * acceleration * ds).tolist()
    for k in range(1, len(v2)):
        v2[k] = min(v2[k], v2[k - 1] + gain[k - 1])
    for k in range(len(v2) - 2, -1, -1):
        v2[k] = min(v2[k], v2[k + 1] + gain[k])
    v = np.sqrt(v2)
    moving = ds > 0
    return float((2 * ds[moving] / (v[1:] + v[:-1])[moving]).sum())


def estimated(run: Run, machine: Machine) -> float:
    known = np.isfinite(run.start).all(axis=1) & np.isfinite(run.end).all(axis=1)
    moves = np.isin(run.kind, (Kind.RAPID, Kind.FEED, Kind.ARC)) & known
    return float(step_times(run, machine)[moves].sum())


@pytest.mark.parametrize("rapid_z", [None, 1500.0])
@pytest.mark.parametrize("acceleration", [0.2, 1.0, 6.0])
def test_a_planned_program(acceleration: float, rapid_z: float | None) -> None:
    text = build(job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6"), LinuxCnc()).text
    # One stretch of known positions: retracts end one and begin another.
    stretch = text.split(" M3\n")[-1].partition("M9")[0]
    run = interpret("G17 G21 G90\n" + stretch)
    mill = Machine(acceleration=acceleration, rapid_z=rapid_z)
    exact = integrated(run, mill)
    assert exact > 20
    assert estimated(run, mill) == pytest.approx(exact, rel=0.02)


corner = st.tuples(
    st.floats(-30, 30), st.floats(-30, 30), st.floats(-5, 5), st.floats(50, 4000), st.booleans()
)


@given(st.lists(corner, min_size=2, max_size=12), st.floats(0.1, 8))
@settings(max_examples=25)
def test_random_paths(corners, acceleration: float) -> None:
    lines = ["G17 G21 G90", "G0 X0 Y0 Z0", "F900"]
    x = y = 0.0
    for a, b, z, feed, bent in corners:
        a, b = round(a, 4), round(b, 4)
        if bent and math.hypot(a - x, b - y) > 0.01:
            i, j = (a - x) / 2, (b - y) / 2
            lines.append(f"G2 X{a:.4f} Y{b:.4f} I{i:.5f} J{j:.5f} F{feed:.1f}")
        else:
            lines.append(f"G1 X{a:.4f} Y{b:.4f} Z{z:.4f} F{feed:.1f}")
        x, y = a, b
    run = interpret("\n".join(lines))
    mill = Machine(acceleration=acceleration)
    exact = integrated(run, mill)
    if exact > 0.05:
        assert estimated(run, mill) == pytest.approx(exact, rel=0.1)


def test_a_slower_z_takes_longer() -> None:
    run = interpret("G17 G21 G90\nG0 X0 Y0 Z0\nG0 Z100\nG0 X100\nG0 X0 Z0")
    slow, fast = (step_times(run, Machine(rapid=6000, rapid_z=z, acceleration=50)) for z in (600, None))
    assert slow[1] == pytest.approx(10, rel=0.01)
    assert slow[2] == pytest.approx(fast[2])
    assert slow[3] == pytest.approx(10, rel=0.01)
    assert fast[1] == pytest.approx(1, rel=0.01)


def test_minutes_in_cut_and_the_life_of_a_tool() -> None:
    made = build(job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6"), LinuxCnc())
    cutting = made.proof.tool_cutting_s
    times = made.proof.tool_times_s
    assert all(0 < cutting[number] < times[number] for number in cutting if number)
    page = setup_html(made.job, made.program, made.proof.as_dict())
    assert "in cut" in page
    assert "of a life of" not in page
    worn = made.program.sections[-1].tool
    sections = tuple(
        type(s)(s.tool.model_copy(update={"life": 30.0}), s.spindle, s.coolant, s.operations)
        for s in made.program.sections
    )
    page = setup_html(made.job, type(made.program)("plate", "G54", 5.0, sections), made.proof.as_dict())
    share = 100 * cutting[worn.number] / 60 / 30
    assert f"of a life of 30 min ({share:.0f} %)" in page
