"""The spindle starts and stops where the tool stands clear of the stock."""

import re

import pytest
from by_control import BY_NAME, CONTROLS, EVERY, asked
from golden_operations import made
from klartext_blocks import anew

from mechwright_cam.proof import Check


def judged(lines: list[str], operation: str, control: str) -> Check:
    """The check of the spindle for a text of an operation's part."""
    one = made(operation, control)[0]
    return asked("spindle", "\n".join([*lines, ""]), one.job, BY_NAME[control])


def lines_of(operation: str, control: str) -> list[str]:
    return made(operation, control)[0].text.splitlines()


def in_cut(lines: list[str]) -> int:
    """How many lines there are before the last retract: after them the mill is on the floor."""
    return max(k for k, line in enumerate(lines) if re.match(r"(N\d+ )?G0 Z5", line))


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("stop", [["M5", "M3"], ["S0", "S8000"], ["M5", "G4 P0.5", "M3"], ["M3", "M5", "M3"]])
def test_a_spindle_that_stops_in_the_material_is_refused(stop: list[str], control: str) -> None:
    if control in {"fanuc", "haas"}:
        stop = [word.replace("P0.5", "P500") for word in stop]
    lines = lines_of("pocket-contour", control)
    at = in_cut(lines)
    found = judged([*lines[:at], *stop, *lines[at:]], "pocket-contour", control)
    line = at + 1 + stop.index("M5") if "M5" in stop else at + 1
    wanted = rf"line {line}: the spindle starts or stops while T23 stands less than 0.2 mm off the stock"
    assert re.match(wanted, found.message)
    assert found.line == line
    # Behind the retract, and said again while it turns, it does no harm.
    assert judged([*lines[: at + 1], *stop, *lines[at + 1 :]], "pocket-contour", control).passed
    assert judged([*lines[:at], "M3", *lines[at:]], "pocket-contour", control).passed


@pytest.mark.parametrize(
    ("way", "passed"),
    [
        ("G0 Z5\nX0 Y0\nG1 Z-1.5 F500", True),  # above the floor of the recess, in its middle
        ("G0 Z5\nX0 Y0\nG1 Z-1.9 F500", False),  # too near to its floor
        ("G0 Z5\nX9.9 Y0\nG1 Z-1.5 F500", False),  # too near to its wall
        ("G0 Z5\nX17 Y0\nG1 Z0.25 F500", True),  # over the stock
        ("G0 Z5\nX17 Y0\nG1 Z0.15 F500", False),
        ("G0 Z5\nX25 Y0\nG1 Z-1 F500", True),  # beside the plate
        ("G0 Z5\nX24.1 Y0\nG1 Z-1 F500", False),
    ],
)
def test_a_tool_that_stands_clear_may_be_stopped(way: str, passed: bool) -> None:
    lines = lines_of("pocket-contour", "linuxcnc")
    at = in_cut(lines)
    found = judged([*lines[:at], *way.split("\n"), "M5", "M3", *lines[at:]], "pocket-contour", "linuxcnc")
    assert found.passed is passed, found.message


def test_a_spindle_that_starts_in_the_material_is_refused() -> None:
    """Told at the stop; without a stop before it, where the tool has gone down with the spindle at rest."""
    lines = lines_of("pocket-contour", "linuxcnc")
    start = next(k for k, line in enumerate(lines) if line.endswith("M3"))
    down = next(k for k, line in enumerate(lines) if line.startswith("G1 Z0"))
    late = [*lines[:start], lines[start].removesuffix(" M3"), *lines[start + 1 : down + 1], "M3"]
    found = judged([*late, *lines[down + 1 :]], "pocket-contour", "linuxcnc")
    assert found.line == down + 2


def test_a_text_that_breaks_off_there_is_no_error() -> None:
    lines = lines_of("pocket-contour", "linuxcnc")
    assert not judged([*lines[: in_cut(lines)], "M5"], "pocket-contour", "linuxcnc").passed


def after_m5(control: str, operation: str, *blocks: str) -> tuple[Check, int]:
    """The check where blocks stand behind the last M5, and the line of the last of those blocks."""
    lines = lines_of(operation, control)
    last = max(k for k, line in enumerate(lines) if line.split()[-1] == "M5") + 1
    text = anew("\n".join([*lines[:last], *blocks, *lines[last:], ""]))
    one = made(operation, control)[0]
    return asked("spindle", text, one.job, BY_NAME[control]), last + len(blocks)


def rapid(control: str, x: float | None = None, z: float | None = None) -> str:
    """A rapid of X, of Z, or of both in one, in the words of a control."""
    klartext = control == "heidenhain-tnc"
    words = (f"{name}{value:+.3f}" for name, value in (("X", x), ("Z", z)) if value is not None)
    return f"L {' '.join(words)} R0 FMAX" if klartext else f"G0 {' '.join(words).replace('+', '')}"


@pytest.mark.parametrize("control", EVERY)
@pytest.mark.parametrize("ways", [[{"z": -1.5}], [{"z": 5}, {"x": 1, "z": -1.5}]])
def test_a_standing_cutter_does_not_go_into_what_it_has_cut(
    ways: list[dict[str, float]], control: str
) -> None:
    """The recess is open there, as wide as the mill or wider: only the spindle forbids it."""
    found, line = after_m5(control, "pocket-contour", *(rapid(control, **way) for way in ways))
    assert re.match(
        f"line {line}: goes below the top of the stock at rapid while the spindle turns not at all",
        found.message,
    )
    assert found.line == line
    high = [rapid(control, **{**way, "z": 5}) for way in ways]
    assert after_m5(control, "pocket-contour", *high)[0].passed


@pytest.mark.parametrize("control", EVERY)
def test_only_the_way_up_is_free_from_where_the_spindle_stopped(control: str) -> None:
    """In the middle of the recess, clear of floor and walls."""
    klartext = control == "heidenhain-tnc"
    feed, turn = ("L Z-1.5 R0 F500", "L M3") if klartext else ("G1 Z-1.5 F500.", "M3")
    stop = [rapid(control, x=0), turn, feed, "M5"]
    assert after_m5(control, "pocket-contour", *stop, rapid(control, z=5))[0].passed
    for way in ({"x": 0.5}, {"z": -1.6}, {"x": 0.5, "z": 5}):
        found, line = after_m5(control, "pocket-contour", *stop, rapid(control, **way))
        assert found.line == line, way
        assert "at rapid" in found.message
