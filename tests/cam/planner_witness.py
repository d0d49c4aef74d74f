"""LinuxCNC's real trajectory planner as a witness: where its machine goes with a program, cycle by cycle.

The whole control runs (``linuxcnc``, Debian package linuxcnc-uspace), on a machine without display, motors and
real time, and every servo cycle is sampled. It runs faster than a clock by similarity: with a servo period K
times shorter, all speeds K times and all accelerations K² times greater, dwells K times shorter and the corner
frequency of short segments K times higher, the k-th sample is where the machine of scale 1 is after k servo
periods. The positions are the same but for when the queue was filled, so two runs agree to 0.2 % in time, and not
to the bit.

What it needs: a user that is not root (as root it runs as ``nobody``), and that no other LinuxCNC runs on this
machine, since its keys of shared memory are fixed: runs of this module wait for each other.
"""

import fcntl
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

LINUXCNC = shutil.which("linuxcnc")
needs_linuxcnc = pytest.mark.skipif(
    LINUXCNC is None, reason="linuxcnc is not installed (Debian package linuxcnc-uspace)"
)
PARTS = Path(__file__).with_name("planner_machine")
SERVO_S = 1e-3
"""Servo period of the machine, s: LinuxCNC's default."""
FASTER = 20
"""So many times faster than a clock; more has not been compared with runs at the clock's pace."""
SLOWER = 4
"""A run whose samples a busy computer could not keep up with is made once more, so many times slower."""
PATIENCE = 600.0
"""So long a run waits for others to end, s."""
NOBODY = 65534
MARK = "MECHWRIGHT_WITNESS"
"""Environment variable by which the processes of a run are known, with the run's folder."""
JOINT = 1.2
"""Joints may do so much more than axes, so that axes are what limits."""


class WitnessError(Exception):
    """A run that says nothing about the program: it failed, was overrun, or took too long."""


class OverrunError(WitnessError):
    """Samples are missing: the computer is too busy for this pace."""


@dataclass(frozen=True)
class Mill:
    """What the planner knows of a machine.

    ``acceleration`` of each axis, mm/s²; ``rapid`` and ``rapid_z``, mm/s; ``upper_end``: how far above Z0 of the
    program the machine's upper end is, mm.
    """

    acceleration: float
    rapid: float = 10000 / 60
    rapid_z: float | None = None
    upper_end: float = 200.0


@dataclass(frozen=True)
class Sampled:
    """Where the machine was: ``t`` (n,) s, ``at`` (n, 3) mm in work coordinates, ``line`` (n,) of the program."""

    t: np.ndarray
    at: np.ndarray
    line: np.ndarray

    @property
    def moving(self) -> np.ndarray:
        """(n,) whether the machine moved in the cycle that ends with the sample."""
        return np.concatenate(([False], (np.diff(self.at, axis=0) != 0).any(axis=1)))

    @property
    def moving_time(self) -> float:
        """Time in which the machine moved, s."""
        return float(self.moving.sum() * SERVO_S)

    def time_of_lines(self) -> dict[int, float]:
        """Line of the program to the time in which the machine moved there, s."""
        lines, counts = np.unique(self.line[self.moving], return_counts=True)
        return dict(zip(lines.tolist(), (counts * SERVO_S).tolist(), strict=True))


def sample(text: str, mill: Mill, tools: str = "", limit: float = 60.0, faster: int = FASTER) -> Sampled:
    """Run a program through the real planner.

    Parameters
    ----------
    text
        The program. The work offset in force is G54, without lengths of tools unless ``tools`` has them.
    mill
        The machine.
    tools
        Text of the tool table.
    limit
        The run is given up after so long, s of a clock; starting and stopping is not counted. A second, slower
        one has as much more.

    Raises
    ------
    WitnessError
        With the reason.
    """
    try:
        return _once(text, mill, tools, limit, faster)
    except OverrunError:
        slower = max(faster // SLOWER, 1)
        return _once(text, mill, tools, limit * faster / slower, slower)


def _once(text: str, mill: Mill, tools: str, limit: float, faster: int) -> Sampled:
    with _alone(limit + PATIENCE), tempfile.TemporaryDirectory(prefix="mechwright-planner-") as name:
        folder = Path(name)
        _furnish(folder, text, mill, tools, limit, faster)
        _control(folder, limit)
        return _samples(folder, mill)


def scaled(text: str, faster: float) -> str:
    r"""The same program ``faster`` times as fast: feeds multiplied, dwells divided.

    >>> scaled("G1 X1 F100 (F100)\nG4 P0.5\nG64 P0.002\n", 20)
    'G1 X1 F2000 (F100)\nG4 P0.025\nG64 P0.002\n'
    """

    def line(words: str) -> str:
        pieces = re.split(r"(\([^)]*\)|;.*)", words)
        for k in range(0, len(pieces), 2):
            dwells = re.search(r"G0*(?:4|82|89)(?![\d.])", pieces[k])
            pieces[k] = _times(pieces[k], "F", faster)
            if dwells:
                pieces[k] = _times(pieces[k], "P", 1 / faster)
        return "".join(pieces)

    return "\n".join(line(one) for one in text.split("\n"))


def _times(words: str, letter: str, factor: float) -> str:
    return re.sub(rf"{letter}\s*([\d.]+)", lambda found: f"{letter}{float(found[1]) * factor:.9g}", words)


def _furnish(folder: Path, text: str, mill: Mill, tools: str, limit: float, faster: int) -> None:
    """Put into the folder what the control reads."""
    z = mill.rapid if mill.rapid_z is None else mill.rapid_z
    axes = "\n".join(
        _axis(letter, joint, speed * faster, mill.acceleration * faster**2)
        for joint, (letter, speed) in enumerate(zip("XYZ", (mill.rapid, mill.rapid, z), strict=True))
    )
    ini = (PARTS / "sim.ini.in").read_text()
    for key, value in (
        ("servo_period", round(1e9 * SERVO_S / faster)),
        ("velocity", max(mill.rapid, z) * faster),
        ("acceleration", mill.acceleration * faster**2),
        ("ramp_frequency", 100 * faster),
        ("axes", axes),
    ):
        ini = ini.replace(f"{{{key}}}", str(value))
    # G54 (5221 to 5230): the machine's upper end is its Z0.
    offsets = [f"{5220 + k}\t{-mill.upper_end if k == 3 else 0.0:.6f}" for k in range(1, 11)]
    for name, content in (
        ("sim.ini", ini),
        ("sim.hal", (PARTS / "sim.hal").read_text()),
        ("display.py", (PARTS / "display.py").read_text()),
        ("program.ngc", scaled(text, faster)),
        ("tool.tbl", tools),
        ("sim.var", "\n".join(["5220\t1.000000", *offsets, ""])),
        ("limit", str(limit)),
    ):
        (folder / name).write_text(content)
    (folder / "display.py").chmod(0o755)
    if os.geteuid() == 0:
        for path in (folder, *folder.iterdir()):
            os.chown(path, NOBODY, NOBODY)


def _axis(letter: str, joint: int, speed: float, acceleration: float) -> str:
    return (
        f"[AXIS_{letter}]\nMAX_VELOCITY = {speed}\nMAX_ACCELERATION = {acceleration}\n"
        "MIN_LIMIT = -9999\nMAX_LIMIT = 9999\n\n"
        f"[JOINT_{joint}]\nTYPE = LINEAR\nMAX_VELOCITY = {JOINT * speed}\n"
        f"MAX_ACCELERATION = {JOINT * acceleration}\nMIN_LIMIT = -9999\nMAX_LIMIT = 9999\n"
        "HOME_SEARCH_VEL = 0\nHOME_LATCH_VEL = 0\nHOME_SEQUENCE = 0\n"
    )


@contextmanager
def _alone(patience: float) -> Iterator[None]:
    """Hold the one lock of this machine; waits for it up to ``patience`` seconds."""
    path = Path(tempfile.gettempdir()) / "mechwright-planner.lock"
    until = time.monotonic() + patience
    with path.open("a") as lock:
        while True:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                if time.monotonic() > until:
                    raise WitnessError(f"another run has held {path} for {patience:g} s") from None
                time.sleep(0.2)
        yield


def _control(folder: Path, limit: float) -> None:
    """Run the control in its folder until it has shut down, and see to it that nothing of it stays."""
    assert LINUXCNC is not None
    before = _shared_memory()
    as_root = os.geteuid() == 0
    user = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if as_root else {}
    with (folder / "run.log").open("w") as log:
        run = subprocess.Popen(
            [LINUXCNC, "-r", "sim.ini"],
            cwd=folder,
            env={
                "HOME": str(folder),
                "PATH": "/usr/bin:/bin:/usr/sbin:/sbin",
                "USER": "nobody" if as_root else os.environ.get("USER", "witness"),
                "LC_ALL": "C",
                "RTAPI_FIFO_PATH": str(folder / "fifo"),
                MARK: str(folder),
            },
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            **user,
        )
        try:
            run.wait(limit + 60)
        except subprocess.TimeoutExpired:
            raise WitnessError(f"the control did not shut down within {limit + 60:g} s") from None
        finally:
            _end(folder, run)
            _release(before, NOBODY if as_root else os.geteuid())
    said = (folder / "display.log").read_text() if (folder / "display.log").exists() else ""
    last = said.strip().rpartition("\n")[2]
    if last != "END done":
        tail = " | ".join((folder / "run.log").read_text(errors="replace").strip().splitlines()[-4:])
        raise WitnessError(last.removeprefix("END ") or f"the control did not start: {tail}")
    if "overruns 0\n" not in said:
        raise OverrunError("the sampler was overrun: the computer is too busy for this pace")


def _end(folder: Path, run: "subprocess.Popen[bytes]") -> None:
    """End the processes of a run, each by its id: those that carry its mark, and those of its session."""
    for sign in (signal.SIGTERM, signal.SIGKILL):
        left = _processes(folder, run.pid)
        for pid in left:
            try:
                os.kill(pid, sign)
            except ProcessLookupError:
                continue
        until = time.monotonic() + 5
        while left and time.monotonic() < until:
            time.sleep(0.05)
            run.poll()
            left = _processes(folder, run.pid)
        if not left:
            break
    run.wait(10)


def _processes(folder: Path, session: int) -> list[int]:
    found = []
    mark = f"{MARK}={folder}".encode()
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            state, *rest = (entry / "stat").read_text().rpartition(")")[2].split()
            if state == "Z":
                continue
            mine = int(rest[2]) == session
            if not mine:
                mine = mark in (entry / "environ").read_bytes().split(b"\0")
        except (OSError, ValueError, IndexError):
            continue  # gone meanwhile, or somebody else's
        if mine:
            found.append(int(entry.name))
    return found


def _shared_memory() -> set[tuple[str, int, int, int, int]]:
    """What there is of System V shared memory and semaphores: kind, id, owner, process, attachments."""
    rows = Path("/proc/sysvipc/shm").read_text().splitlines()[1:]
    found = {("shm", int(c[1]), int(c[7]), int(c[4]), int(c[6])) for c in map(str.split, rows)}
    rows = Path("/proc/sysvipc/sem").read_text().splitlines()[1:]
    return found | {("sem", int(c[1]), int(c[4]), 0, 0) for c in map(str.split, rows)}


def _release(before: set[tuple[str, int, int, int, int]], owner: int) -> None:
    """Take away the shared memory of a run that did not end by itself."""
    known = {(kind, number) for kind, number, *_ in before}
    for kind, number, uid, process, attached in _shared_memory():
        gone = not process or not Path(f"/proc/{process}").exists()
        if (kind, number) not in known and uid in (owner, 0) and not attached and gone:
            option = "-m" if kind == "shm" else "-s"
            subprocess.run(["ipcrm", option, str(number)], capture_output=True, check=False)


def _samples(folder: Path, mill: Mill) -> Sampled:
    rows = np.loadtxt(folder / "path.txt", dtype=np.float64, ndmin=2, usecols=range(5))
    if len(rows) < 2:
        raise WitnessError("nothing was sampled")
    if (np.diff(rows[:, 0]) != 1).any():
        raise OverrunError("samples are missing: the computer is too busy for this pace")
    at = rows[:, 1:4] + np.array((0.0, 0.0, mill.upper_end))
    return Sampled((rows[:, 0] - rows[0, 0]) * SERVO_S, at, rows[:, 4].astype(np.int64))
