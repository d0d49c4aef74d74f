"""The words of a move are kept in mind: only where the control stands as it did before they are the same."""

import pytest
from planning_parts import LIBRARY

from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.program.moves import Feed, FeedArc, Operation, Program, Rapid, ToolSection

ARC = FeedArc(10.0, 10.0, None, 0.0, 10.0, True, 400.0)
TINY = FeedArc(10.00001, 10.0, None, 0.0, 10.0, True, 400.0)
FULL = FeedArc(10.0, 10.0, None, 5.0, 0.0, False, 400.0)
ACROSS = Feed(10.0, None, None, 500.0)
UP = Feed(10.0, 0.0, -1.0, 500.0)


def program(*moves):
    start = (Rapid(x=10.0, y=-10.0), Rapid(z=1.0), Feed(None, None, -2.0, 100.0))
    section = ToolSection(LIBRARY.get("mill-6"), 3000.0, "flood", (Operation("one", (*start, *moves)),))
    return Program("moves", "G54", 5.0, (section,), ())


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc", "grbl"])
def test_repeated_moves_are_written_as_fresh_ones(control):
    """The same objects, and as many equal ones, give the same text, whatever stands in between."""
    post = host().get(Control, control)
    moves = [
        ARC,
        TINY,
        FULL,
        FULL,
        ACROSS,
        UP,
        Feed(0.0, 3.0, None, 500.0),
        ACROSS,
        Feed(10.0, -10.0, None, 300.0),
    ]
    moves += [ARC, FULL, TINY, Feed(10.0, -10.0, -3.0, 300.0), ARC, UP, ACROSS, UP]
    copies = [type(m)(**{name: getattr(m, name) for name in m.__slots__}) for m in moves]
    assert len({id(m) for m in copies}) == len(moves) > len({id(m) for m in moves})
    text = post.write(program(*moves))
    assert text == post.write(program(*copies))
    # A straight move along X, and the same one where X is there already.
    assert post.write(program(ACROSS, ACROSS)) == post.write(program(ACROSS))
    assert post.write(program(UP, ACROSS)) == post.write(program(UP))
