"""Programs that probe the stock's zero: played against a stock that lies elsewhere, and against LinuxCNC."""

import math
import re
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pytest
from by_control import BY_NAME
from planning_parts import job as job_of
from planning_parts import plate
from rs274 import needs_rs274, run_rs274

from mechwright.errors import ProgramError
from mechwright_cam.controls.contract import Control
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.probing import touches_of, unprobed
from mechwright_cam.shop.machine import Machine

PROBE = {"tool": 99, "diameter": 4.0, "doubt": 3.0}
PROBING = [name for name, control in BY_NAME.items() if not control.cannot_probe(())]
STEP, CLOSE = 0.2, 1e-3
"""Of the moves as they are played, and how near ball and stock touch, mm."""


def probed_job(**changes) -> Job:
    return job_of(plate(), "mill-6", probe={**PROBE, **changes})


def text_of(control: Control, job: Job) -> str:
    return control.probe(touches_of(job), Machine(retract_z=-2.0))


@dataclass
class Played:
    """A machine with a stock that lies off from where the work offset by eye says, by ``off``, mm.

    Places are those of the ball's middle in X and Y and of its lowest point in Z, in the coordinates by eye.
    """

    job: Job
    off: tuple[float, float, float]
    scale: float = 1.0
    place: dict[str, float] = field(default_factory=lambda: {"X": 400.0, "Y": 300.0, "Z": 100.0})
    shift: dict[str, float] = field(default_factory=lambda: dict.fromkeys("XYZ", 0.0))
    """Work coordinates are the place less this."""
    met: dict[str, float] = field(default_factory=lambda: dict.fromkeys("XYZ", 0.0))
    absolute: bool = True

    @property
    def apart(self) -> float:
        """Between ball and stock, mm; below 0 the ball is pressed in."""
        x0, y0, x1, y1 = self.job.stock
        low, high = (x0, y0, -self.job.thickness), (x1, y1, 0.0)
        radius = self.job.settings.probe.diameter / 2
        middle = [self.place["X"], self.place["Y"], self.place["Z"] + radius]
        away = [
            max(a + o - at, at - b - o, 0.0) for a, b, o, at in zip(low, high, self.off, middle, strict=True)
        ]
        return math.hypot(*away) - radius

    def run(self, text: str) -> None:
        for line in text.splitlines():
            words = re.sub(r"\(.*?\)", "", line)
            if not words.strip():
                continue
            if "G53" in words:
                self.place["Z"] = 100.0
            elif "G10" in words:
                assert "G10 L20 P1 " in words
                axis, value = self.word(words.partition("P1 ")[2])
                self.shift[axis] = self.place[axis] - value
            elif words in {"G90", "G91"}:
                self.absolute = words == "G90"
            elif "G38" in words:
                self.move(words.partition(" ")[2].split(" F")[0], feed=True, wanted="G38.2" in words)
            else:
                for found in re.findall(r"[XYZ](?:\[[^]]*\]|-?[\d.]+)", words):
                    self.move(found)

    def word(self, word: str) -> tuple[str, float]:
        value = word[1:].strip("[]")
        for axis, met, stands in zip(
            "XYZ", ("#5061", "#5062", "#5063"), ("#5420", "#5421", "#5422"), strict=True
        ):
            value = value.replace(met, f"({(self.met[axis] - self.shift[axis]) / self.scale})")
            value = value.replace(stands, f"({(self.place[axis] - self.shift[axis]) / self.scale})")
        return word[0], eval(value) * self.scale

    def move(self, word: str, *, feed: bool = False, wanted: bool = False) -> None:
        axis, value = self.word(word)
        if feed:
            assert self.apart > CLOSE / 2, "the probe is pressed in before a touch"
        end = value + (self.shift[axis] if self.absolute else self.place[axis])
        start, pressed = self.place[axis], self.apart < CLOSE
        for place in np.append(np.arange(0, abs(end - start), STEP), abs(end - start)):
            at = math.copysign(place, end - start) + start
            before, self.place[axis] = self.place[axis], at
            if self.apart > CLOSE:
                pressed = False
            elif feed:
                self.met[axis] = self.meets(axis, before, at)
                return
            else:
                assert pressed, f"a rapid runs into the stock: {word}"
        assert not wanted, f"nothing is met: {word}"

    def meets(self, axis: str, free: float, pressed: float) -> float:
        """Between two places the one where ball and stock meet, where the machine then stands."""
        while abs(free - pressed) > CLOSE / 10:
            self.place[axis] = (free + pressed) / 2
            free, pressed = (free, self.place[axis]) if self.apart <= 0 else (self.place[axis], pressed)
        self.place[axis] = pressed  # it goes on a little
        return free


@pytest.mark.parametrize("units", ["mm", "inch"])
@pytest.mark.parametrize(
    "off", [(0, 0, 0), (2.9, -2.9, 2.9), (-2.9, 2.9, -2.9), (2.9, 2.9, 2.9), (-2.9, -2.9, -2.9)]
)
@pytest.mark.parametrize("control", PROBING)
def test_the_zero_is_found_wherever_the_stock_lies(control: str, off, units) -> None:
    job, by_name = probed_job(), BY_NAME[control].speaking(units)
    played = Played(job, off, by_name.scale)
    played.run(text_of(by_name, job))
    assert [played.shift[axis] for axis in "XYZ"] == pytest.approx(off, abs=2 * CLOSE)


@pytest.mark.parametrize("control", PROBING)
@pytest.mark.parametrize(
    ("off", "what"),
    [
        ((6, 0, 0), "nothing is met"),
        ((0, 0, 12), "pressed in|a rapid runs"),
        ((-12, 0, 0), "pressed in|rapid"),
    ],
)
def test_a_zero_that_is_further_off_ends_the_program(control: str, off, what: str) -> None:
    job = probed_job()
    with pytest.raises(AssertionError, match=what):
        Played(job, off).run(text_of(BY_NAME[control], job))


@pytest.mark.parametrize("control", PROBING)
@pytest.mark.parametrize(
    ("old", "new"),
    [
        (r"(G10 L20 P1 X\[?)-", r"\1"),
        (r"G10 L20 P1 Y", "G10 L20 P1 X"),
        (r"G38\.2 Z-4", "G38.2 Z9"),
        (r"G38\.3 Z-4", "G38.3 Z4"),
    ],
)
def test_a_planted_fault_is_seen(control: str, old: str, new: str) -> None:
    job = probed_job()
    text, count = re.subn(old, new, text_of(BY_NAME[control], job), count=1)
    assert count == 1, text
    played = Played(job, (1.0, 1.0, 1.0))
    try:
        played.run(text)
    except AssertionError:
        return
    assert [played.shift[axis] for axis in "XYZ"] != pytest.approx((1.0, 1.0, 1.0), abs=2 * CLOSE)


@needs_rs274
@pytest.mark.parametrize("units", ["mm", "inch"])
@pytest.mark.parametrize("offset", ["G54", "G59", "G59.3"])
def test_linuxcnc_sets_the_offset_that_is_meant(units, offset: str, tmp_path: Path) -> None:
    """Its interpreter, without a machine, takes the end of each touch for the place where the ball meets."""
    job = probed_job()
    job = replace(job, settings=job.settings.model_copy(update={"work_offset": offset}))
    control = BY_NAME["linuxcnc"].speaking(units)
    canon = run_rs274(text_of(control, job), tmp_path, "T99 P99 Z0 D4\n")
    assert canon.ok, canon.error
    number = {"G54": 1, "G59": 6, "G59.3": 9}[offset]
    sets = re.findall(rf"SET_G5X_OFFSET\({number}, ([-\d.]+), ([-\d.]+), ([-\d.]+)", canon.text)
    last = [float(value) for value in sets[-1]]
    assert last == pytest.approx([4 / control.scale, 4 / control.scale, -4 / control.scale], abs=1e-4)


def test_what_cannot_be_probed_is_refused_by_name() -> None:
    assert "a ball of 20 mm needs a stock of 10.8 mm" in unprobed(probed_job(diameter=20))
    job = probed_job()
    assert "T99 is a cutter" in unprobed(
        replace(job, tools=(job.tools[0].model_copy(update={"number": 99}),))
    )
    assert "second side" in unprobed(replace(job, side="underside"))
    for name, control in BY_NAME.items():
        if name in PROBING:
            continue
        assert "has no program that probes here" in control.cannot_probe(job.tools)
        with pytest.raises(ProgramError, match="has no program that probes here"):
            control.probe(touches_of(job), Machine())
    measured = [job.tools[0].model_copy(update={"length": 70.0})]
    assert "has tool lengths in its programs" in BY_NAME["grbl"].cannot_probe(measured)


def test_the_lines_of_linuxcnc() -> None:
    lines = text_of(BY_NAME["linuxcnc"], probed_job()).splitlines()
    code = [line for line in lines if not line.startswith("(")]
    assert code[:6] == ["G17 G21 G40 G49 G80 G90 G91.1 G94", "G61", "G53 G0 Z-2", "M5", "M9", "T99 M6"]
    assert code[-2:] == ["G53 G0 Z-2", "M30"]
    assert code[7].startswith("G43 H99 G0 Z")
    touch = code.index(next(line for line in code if line.startswith("G38.2 Z")))
    assert code[touch : touch + 4] == [
        "G38.2 Z-4 F150",
        "G0 Z[#5063 + 2]",
        "G38.2 Z-4 F25",
        "G10 L20 P1 Z[0 + #5422 - #5063]",
    ]
