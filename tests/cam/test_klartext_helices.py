"""Helices in Klartext, which end where their angle says: what is written is read within the last decimal."""

import math
from itertools import pairwise

import numpy as np
import pytest
from by_control import BY_NAME, interpret
from by_night import examples
from golden_programs import every_operation
from hypothesis import given, settings
from hypothesis import strategies as st
from klartext_blocks import numbered

from mechwright_cam.program.moves import FeedArc, Operation, Program, Rapid, ToolSection

TNC = BY_NAME["heidenhain-tnc"]


@given(
    st.floats(0.5, 400),
    st.lists(st.tuples(st.floats(-175, 175), st.booleans(), st.floats(-1, 1)), min_size=1, max_size=30),
)
@settings(max_examples=examples(20, 200), deadline=None)
def test_helices_by_their_angle_end_where_they_should(radius: float, turns) -> None:
    """However many follow each other: what is read is within half of a last decimal, and a little, of the plan."""
    whole = every_operation()
    tool = whole.sections[2].tool
    x, y, z, moves = radius, 0.0, 0.0, [Rapid(radius, 0.0), Rapid(z=0.0)]
    places = []
    for turn, ccw, down in turns:
        angle = math.atan2(y, x) + math.radians(abs(turn) * (1 if ccw else -1))
        end = (radius * math.cos(angle), radius * math.sin(angle))
        if math.hypot(end[0] - x, end[1] - y) < 0.01:
            continue
        z += down
        moves.append(FeedArc(*end, z, -x, -y, ccw, 300.0))
        x, y = end
        places.append((x, y, z))
    moves.append(Rapid(z=50.0))
    section = ToolSection(tool, 8000, "off", (Operation("turns", tuple(moves)),))
    text = TNC.write(Program("turns", "G54", 50.0, (section,)))
    run = interpret(text, TNC)
    ends = run.end[run.cutting]
    for place in places:
        assert np.abs(ends - place).max(axis=1).min() < 1.6e-3


@pytest.mark.parametrize("units", ["mm", "inch"])
def test_what_roundings_leave_of_helices_does_not_add_up(units) -> None:
    """Of two hundred arcs about a centre that no decimal hits."""
    x, y, radius = 1 / 3, 1 / 7, 7.77
    ends = [(x + radius * math.cos(k * 1.2), y + radius * math.sin(k * 1.2), -k / 100) for k in range(200)]
    turns = [FeedArc(*end, x - at[0], y - at[1], True, 300.0) for at, end in pairwise(ends)]
    moves = (Rapid(*ends[0][:2]), Rapid(z=0.0), *turns, Rapid(z=50.0))
    tool = every_operation().sections[2].tool
    section = ToolSection(tool, 8000, "off", (Operation("turns", moves),))
    run = interpret(TNC.speaking(units).write(Program("turns", "G54", 50.0, (section,))), TNC)
    cuts = run.end[run.cutting]
    off = [np.abs(cuts - end).max(axis=1).min() for end in ends[1:]]
    assert max(off) < (1.6e-3 if units == "mm" else 4e-3)


HEAD = (
    *("BEGIN PGM TURNS MM", "CYCL DEF 247 Q339=+1", "L Z+0 R0 FMAX M91", "TOOL CALL 3 Z S900", "M3"),
    *("L X+10 Y+0 R0 FMAX", "L Z+1 R0 FMAX", "CC X+0 Y+0"),
)


@pytest.mark.parametrize(
    ("angle", "turns"),
    [(2880, 8), (720.5, 2), (360, 1), (359.99999, 1), (359.9999, 0), (359.9, 0), (1035, 2)],
)
@pytest.mark.parametrize("sign", ["+", "-"])
def test_several_turns_in_a_block_are_as_many_blocks(angle: float, turns: int, sign: str) -> None:
    whole = numbered(
        *HEAD, f"CP IPA{sign}{angle} IZ-4.3 DR{sign} F200", "L Z+50 R0 FMAX", "M30", "END PGM TURNS MM"
    )
    shares = [360.0] * turns + ([angle - 360 * turns] if angle - 360 * turns > 1e-4 / 2 else [])
    blocks = [f"CP IPA{sign}{one:.6f} IZ{-4.3 * one / sum(shares):.9f} DR{sign} F200" for one in shares]
    each = numbered(*HEAD, *blocks, "L Z+50 R0 FMAX", "M30", "END PGM TURNS MM")
    one, several = interpret(whole, TNC), interpret(each, TNC)
    assert one.cutting.sum() == 1
    assert several.cutting.sum() == len(shares)
    assert one.sweep.sum() == pytest.approx(math.radians(angle) * (1 if sign == "+" else -1), abs=1e-6)
    np.testing.assert_allclose(one.sweep.sum(), several.sweep.sum(), atol=1e-6)
    np.testing.assert_allclose(one.end[one.cutting][-1], several.end[several.cutting][-1], atol=2e-6)
