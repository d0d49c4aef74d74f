"""How fast walls are finished: chips off the allowance are as thick as planned, in corners too."""

import math
from dataclasses import replace

import pytest
from planning_parts import job, plate

from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import posted
from mechwright_cam.operations.finishing import finish_engagement
from mechwright_cam.planning import plan
from mechwright_cam.program.moves import Feed, FeedArc
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.slowed import slowed


def feeds(program, name):
    return [m.feed for m in moves(program, name) if isinstance(m, Feed | FeedArc)]


def along(program, name):
    """Feeds of moves in plan alone: down it goes at its own."""
    return [m.feed for m in moves(program, name) if isinstance(m, Feed | FeedArc) and m.x is not None]


def moves(program, name):
    return next(o.moves for s in program.sections for o in s.operations if o.name == name)


def test_walls_are_finished_with_chips_as_thick_as_planned() -> None:
    """0.2 mm of a mill of 6: the engagement is 21 degrees, and chips are thinner than half."""
    wall = plate()
    plain, raised = (plan(job(wall, "mill-6", chip_thinning=thin)) for thin in (False, True))
    slow, fast = (along(program, "outside: finish") for program in (plain, raised))
    assert max(fast) == pytest.approx(2 * max(slow), rel=1e-3)
    settings = CamSettings()
    assert finish_engagement(settings, 3.0) == math.pi / 6
    assert finish_engagement(settings, 1.0) == pytest.approx(math.acos(0.8))
    assert finish_engagement(settings, 0.2) == math.pi / 2
    assert finish_engagement(settings, 1.0, inside=3.0) > finish_engagement(settings, 1.0)


def test_moves_whose_chips_are_too_thick_are_slowed_down() -> None:
    """Roughing at twice its feed, in a channel as wide as the mill; the way down in air, and finishing, stay."""
    of, control = job(plate(thickness=4.0), "mill-8", stock={"margin": 11}), host().get(Control, "linuxcnc")
    plain = plan(of)
    fast = replace(
        plain, sections=tuple(replace(s, operations=tuple(map(twice, s.operations))) for s in plain.sections)
    )
    program, _, scene = posted(fast, of, control)
    gentler = slowed(program, scene)
    assert gentler is not None
    assert max(feeds(gentler, "outside: rough")[1:]) <= 1.4 * max(feeds(plain, "outside: rough"))
    assert feeds(gentler, "outside: finish") == feeds(plain, "outside: finish")


def twice(operation):
    """An operation with its roughing at twice the feed."""
    if "rough" not in operation.name:
        return operation
    some = (replace(m, feed=2 * m.feed) if isinstance(m, Feed | FeedArc) else m for m in operation.moves)
    return replace(operation, moves=tuple(some))
