"""What we claim of LinuxCNC's planner, against the planner: moving time, and how far it leaves the path."""

import os
from functools import cache
from pathlib import Path

import numpy as np
import planner_witness
import pytest
from by_night import in_ci
from planner_path import compared, times
from planner_witness import MARK, NOBODY, Mill, Sampled, WitnessError, needs_linuxcnc, sample, scaled
from planning_parts import bore, job, plate

from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.controls.lookahead import DEFAULT_LOOKAHEAD
from mechwright_cam.machining import machine
from mechwright_cam.shop.machine import Machine

pytestmark = [in_ci, needs_linuxcnc]
CLOSE = 0.02
HEAD = "G17 G21 G40 G49 G80 G90 G94\nG54\n"
BEND = 0.0136
"""How far the centre of the arc that follows on a line is off the normal of that line, mm: 1.9 mrad of its radius."""

CORNERS = f"""{HEAD}G64 P0.002 Q0
G0 X0 Y0 Z5
Z1
G1 Z-1 F300
X10 F1500
Y10
X4 Y14
X-3 Y12.5
X-10 Y12
Y0
X0
G61
X10
Y5
G64 P0.02 Q0
X0
Y0
G0 Z5
G53 G0 Z0
M2
"""
ARCS = f"""{HEAD}G64 P0.002 Q0
G0 X0 Y0 Z5
Z1
G1 Z0.5 F300
G3 X0 Y0 Z-1 I4 J0 F700
X0 Y0 Z-2.5 I4 J0
X0 Y0 I4 J0
G1 X0 Y-6 F1600
G3 X4 Y-10 I4 J0
G1 X14
G3 X20 Y-4 I-1 J7
G2 X26 Y2 I6 J0
X32.2 Y-1.1 I0.1 J-7.5
G1 X32 Y-20
G0 Z5
G53 G0 Z0
M2
"""
TURNS_IN = f"""{HEAD}G64 P0.002 Q0
G0 X0 Y0 Z5
G1 Z-1 F1000
Y60 F1960
G2 X7.2 Y67.2 I{7.2 + BEND:.4f} J{-BEND:.4f}
G1 X40
G0 Z5
M2
"""
SMALL_ARCS = f"""{HEAD}G64 P0.02 Q0
G0 X68.7736 Y40.6764 Z5
G1 Z-1 F1000
X39.6453 Y23.8592 F1440
G3 X39.7326 Y22.2994 Z-1.0046 I0.3609 J-0.7621
X40.4635 Y22.3917 Z-1.0063 I0.2669 J0.8269
G1 X69.6136 Y39.2215
G2 X74.0713 Y37.8903 I1.5963 J-2.7837
G1 X85
G0 Z5
M2
"""
"""Arcs that are asked for faster than their radius allows."""


@cache
def planned() -> str:
    """Spotting, drilling, boring, roughing and finishing with tabs."""
    return machine(job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6"), LinuxCnc()).text


@cache
def table() -> str:
    return LinuxCnc().tool_table(job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6").tools)[1]


@cache
def real(text: str, acceleration: float) -> Sampled:
    made = Machine(acceleration=acceleration)
    mill = Mill(1000 * acceleration, made.rapid / 60, upper_end=made.travel_z / 2)
    return sample(text, mill, table(), limit=120)


@pytest.mark.parametrize(
    ("name", "acceleration"),
    [("corners", 2.0), ("corners", 0.5), ("arcs", 2.0), ("arcs", 0.5), ("small", 0.5), ("planned", 0.5)],
)
def test_time_and_path_are_as_claimed(name: str, acceleration: float) -> None:
    text = {"corners": CORNERS, "arcs": ARCS, "small": SMALL_ARCS, "planned": planned()}[name]
    control, sampled = LinuxCnc(), real(text, acceleration)
    run = control.read(text)
    motion = control.lookahead.motion(run, Machine(acceleration=acceleration))
    took, estimate = times(run, motion, sampled)
    assert estimate == pytest.approx(took, rel=CLOSE)
    found = compared(run, motion, sampled)
    assert found.off.size > 1000
    assert found.beyond.max() <= 0
    assert np.median(found.off) < 1e-4  # most of the path is the programmed one


def test_p_is_no_bound_where_an_arc_follows_on_a_line() -> None:
    """A turn of 1.9 mrad into an arc at 33 mm/s: the two moves overlap over a millimetre, whatever P says."""
    control, slow = LinuxCnc(), Machine(acceleration=0.5)
    run = control.read(TURNS_IN)
    motion = control.lookahead.motion(run, slow)
    found = compared(run, motion, real(TURNS_IN, 0.5))
    assert found.off.max() > 0.05
    assert found.beyond.max() <= 0
    assert motion.off[run.cutting].max() < 1.2 * found.off.max()


def test_exact_is_exact() -> None:
    text = TURNS_IN.replace("G64 P0.002 Q0", "G61")
    run = LinuxCnc().read(text)
    motion = LinuxCnc().lookahead.motion(run, Machine(acceleration=0.5))
    found = compared(run, motion, real(text, 0.5))
    assert found.off.max() < 1e-4
    assert found.beyond.max() <= 0


def test_the_witness_tells_a_wrong_estimate_and_a_wrong_corridor() -> None:
    """With the rules of no control in particular the same comparison fails, so that it can."""
    run = LinuxCnc().read(ARCS)
    motion = DEFAULT_LOOKAHEAD.motion(run, Machine(acceleration=0.5))
    took, estimate = times(run, motion, real(ARCS, 0.5))
    assert estimate != pytest.approx(took, rel=CLOSE)
    narrow = type(motion)(motion.seconds, 0.1 * motion.off)
    assert compared(run, narrow, real(ARCS, 0.5)).beyond.max() > 0


def test_a_run_that_fails_says_why() -> None:
    with pytest.raises(WitnessError, match=r"Unknown g code|Bad character|G-code"):
        sample(HEAD + "G0 X1 Y1 Z1\nG77 X2\nM2\n", Mill(2000.0))
    with pytest.raises(WitnessError, match="not at its end in time, at line 5"):
        sample(HEAD + "G0 X0 Y0 Z0\nG64 P0.01\nG1 X1000 F10\nM2\n", Mill(2000.0), limit=1.0)


def test_nothing_is_left_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of this run; what others, even killed ones, left on the machine is not its affair."""
    folders: list[Path] = []
    control = planner_witness._control

    def seen(folder: Path, limit: float) -> None:
        folders.append(folder)
        control(folder, limit)

    def ours() -> set[str]:
        uid = NOBODY if os.geteuid() == 0 else os.geteuid()
        with planner_witness._alone(600.0):  # no other run is under way while it is counted
            rows = Path("/proc/sysvipc/shm").read_text().splitlines()[1:]
        return {row.split()[1] for row in rows if int(row.split()[7]) == uid}

    monkeypatch.setattr(planner_witness, "_control", seen)
    before = ours()
    with pytest.raises(WitnessError):
        sample(HEAD + "G1 X1000 F10\nM2\n", Mill(2000.0), limit=0.5)
    assert ours() <= before
    assert folders
    for folder in folders:
        assert not folder.exists()
        for entry in Path("/proc").iterdir():
            if entry.name.isdigit() and entry.name != str(os.getpid()):
                try:
                    environment = (entry / "environ").read_bytes()
                except OSError:
                    continue
                assert f"{MARK}={folder}".encode() not in environment


def test_feeds_and_dwells_are_scaled_and_nothing_else() -> None:
    text = "G82 X1 Z-1 R1 P0.2 F222 (F5 P5)\nG64 P0.002 Q0\nG1 X5 F.5 ;F9\nG04 P1\n"
    assert scaled(text, 20) == (
        "G82 X1 Z-1 R1 P0.01 F4440 (F5 P5)\nG64 P0.002 Q0\nG1 X5 F10 ;F9\nG04 P0.05\n"
    )
