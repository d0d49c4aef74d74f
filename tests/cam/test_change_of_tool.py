"""What a change of tool leaves unknown: where X and Y stand then, and on Fanuc what a length does to Z."""

import re
from dataclasses import replace

import numpy as np
import pytest
from by_control import BY_NAME, EVERY, interpret
from klartext_blocks import anew
from machine_programs import job_of, text_of
from shop import plate_program

from mechwright.errors import ProgramError
from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.lookahead.geometry import begins
from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof import prove
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.posting import Posting

CHANGES = tuple(name for name in EVERY if name != "grbl")
"""Grbl has none: hands put the tool in."""


def second_tool(control: str, *, without: str) -> str:
    """The program whose drill goes down where the spot drill has been, with words of its part taken out."""
    text = text_of(control)
    at = re.search(r"TOOL CALL 2|T2( M6)?$", text, re.MULTILINE).start()
    end = re.search(r"TOOL CALL 3|T3( M6)?$", text, re.MULTILINE).start()
    return anew(text[:at] + re.sub(without, "", text[at:end], flags=re.MULTILINE) + text[end:])


def said(text: str, control: str) -> str:
    try:
        found = prove(text, job_of(control), BY_NAME[control])
    except ProgramError as error:
        return str(error)
    return "" if found.ok else found.failures[0].message


@pytest.mark.parametrize("control", CHANGES)
def test_behind_a_change_x_and_y_are_said_anew(control: str) -> None:
    """LinuxCNC's TOOL_CHANGE_POSITION, M6 macros and cycles of makers take them elsewhere."""
    assert said(text_of(control), control) == ""
    lost = second_tool(control, without=r"^(\d+ )?(G0|L) X.*\n| X[^ ]+ Y[^ ]+")
    assert lost != text_of(control)
    found = said(lost, control)
    assert "unknown" in found or "that the text does not say" in found


def test_what_goes_to_both_in_the_air_is_fine() -> None:
    """Down to the clearance plane, then sideways: so some post; the first tool of a program does it anyway."""
    text = text_of("fanuc").replace("G0 X0. Y0.\nG43 H2 Z5.", "G0 G43 H2 Z5.\nX0. Y0.")
    assert said(text, "fanuc") == ""


def test_half_a_place_is_none() -> None:
    text = text_of("linuxcnc").replace("G0 X0 Y0\nG43 H2", "G0 X0\nG43 H2").replace("G83 X0 Y0", "G83 X0")
    found = said(text, "linuxcnc")
    assert found.startswith("line 28: G83 from an unknown position, unknown since M6 in line 23; move to")


CHANGED = (
    "G21 G90 G17 G40\nT1 M6\nG54\nG0 X0 Y0\nG43 H1 Z5\nX30\nG53 G0 Z0\n"
    "T2 M6\n{}G0 X30 Y40\nG43 H2 Z5\n{}T3 M6\nG0 X0 Y40\nM2\n"
)


@pytest.mark.parametrize(
    ("between", "lower", "ways"),
    [
        ("", "G53 G0 Z0\n", [40.0, 30.0]),
        ("", "T5\nT5 M6\nT4 M6\n", [40.0, 30.0]),  # no move between three changes
        ("G55\n", "G53 G0 Z0\n", [np.nan, 30.0]),  # another offset: how far it is, nobody has said
        ("G53 G0 X0\n", "G53 G0 Z0\n", [np.nan, 30.0]),
    ],
)
def test_times_count_the_way_from_where_the_tool_was_changed(
    between: str, lower: str, ways: list[float]
) -> None:
    run = interpret(CHANGED.format(between, lower))
    rapid = np.flatnonzero((run.kind == Kind.RAPID) & np.isnan(run.start[:, 0]))[1:]
    way = np.hypot(*(run.end[rapid, :2] - begins(run)[rapid, :2]).T)
    assert way == pytest.approx(ways, nan_ok=True)


def test_times_are_as_if_nothing_but_the_change_were_between() -> None:
    control, machine = BY_NAME["linuxcnc"], Machine()
    run = interpret(text_of("linuxcnc"))
    kept = interpret(text_of("linuxcnc").replace("T2 M6", "T2").replace("T3 M6", "T3"))
    assert control.lookahead.motion(run, machine).seconds.sum() == pytest.approx(
        control.lookahead.motion(kept, machine).seconds.sum(), rel=1e-9
    )


BEFORE = "G91 G28 Z0.\nG90\n(OPERATION: DRILL)"


@pytest.mark.parametrize(
    ("old", "new", "word"),
    [
        ("M5\n" + BEFORE, "M5\nG49\n" + BEFORE, "G49"),
        ("M5\n" + BEFORE, "M5\nG49 G91 G28 Z0.\nG90\n(OPERATION: DRILL)", "G49"),
        ("M5\n" + BEFORE, "M5\nG0 G53 Z0.\nG49\n" + BEFORE, "G49"),
        ("M5\n" + BEFORE, "M5\nG43 H0\n" + BEFORE, "G43"),
        ("G43 H2 Z5.", "G43 H2\nZ5.", "G43"),
        ("G43 H2 Z5.", "G91 G43 H2 Z0.\nG90 Z5.", "G43"),
    ],
)
def test_a_length_without_a_height_may_move_z_on_fanuc(old: str, new: str, word: str) -> None:
    text = text_of("fanuc")
    assert old in text
    found = said(text.replace(old, new), "fanuc")
    assert f": {word} without a height to go to may move Z by the tool's length" in found
    haas = text_of("haas").replace("M5\nG53 G0 Z-2.", "M5\nG49\nG53 G0 Z-2.")
    assert said(haas, "haas") == ""


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("M5\n" + BEFORE, "M5\n" + BEFORE.replace("G90", "G90\nG49")),  # G28 has taken the length back
        ("M5\n" + BEFORE, "M5\nG0 G49 G53 Z0.\n" + BEFORE),
        ("G43 H2 Z5.", "G43 H2 Z5.\nG43 H2"),  # the same again
        ("T2 M6\n", "T2 M6\nG49\n"),
    ],
)
def test_a_length_that_moves_nothing_is_read(old: str, new: str) -> None:
    text = text_of("fanuc")
    assert old in text
    assert said(text.replace(old, new), "fanuc") == ""


def test_a_restart_point_of_fanuc_leaves_the_length_in_force() -> None:
    """Run through, G49 there would move Z down by the tool's length; started from, there is none."""
    text = host().get(Control, "fanuc").write(replace(plate_program(), posting=Posting(restart=True)))
    points = text.split("(RESTART POINT")[1:]
    assert points
    assert all("G17 G21 G40 G80 G90 G94\nG64\nG91 G28 Z0.\n" in point for point in points)
    assert text.count("G49") == 1
    assert said(text, "fanuc") == ""
    assert "G49 without a height" in said(text.replace("G40 G80", "G40 G49 G80"), "fanuc")
