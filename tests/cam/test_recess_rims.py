"""Recesses that run out over the rim of a disc, down to nearly along it, and ways that pass a corner closely."""

import math

import numpy as np
import pytest
import shapely
from by_control import posted, prove
from by_night import examples
from hypothesis import example, given, settings
from hypothesis import strategies as st

from mechwright.contracts.part import Part, Pocket, Profile
from mechwright.errors import MechwrightError
from mechwright.geometry import Loop, Outline, circle
from mechwright_cam.operations.clearing import stays_inside
from mechwright_cam.planning import choose_tools, plan
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.settings import CamSettings
from mechwright_plane.leads import best_start

LIBRARY = load_library()
RIM = 24.0


def disc(recess: Loop) -> Part:
    rim = Loop((circle((0.0, 0.0), RIM),))
    features = (Pocket("recess", recess, (), 0.0, 2.0), Profile("outside", rim, "outside", 0.0, 4.0))
    return Part("disc", Outline(rim), 4.0, "aluminium", machined=features)


def chord(angle: float) -> Loop:
    """All beyond a straight line that crosses the rim at an angle, rad."""
    x = RIM * math.cos(angle)
    return Loop.polygon([(x, -40), (40, -40), (40, 40), (x, 40)])


def bulge(angle: float) -> Loop:
    """A circle of two thirds of the rim that crosses it at about that angle."""
    radius = RIM * 2 / 3
    return Loop((circle((math.sqrt(RIM**2 + radius**2 - 2 * RIM * radius * math.cos(angle)), 0.0), radius),))


@settings(max_examples=examples(1, 12))
@given(
    angle=st.floats(-2.5, 0.0).map(lambda x: 10**x),
    shape=st.sampled_from([chord, bulge]),
    tools=st.sampled_from([(), ("mill-6",), ("mill-10", "mill-3")]),
    climb=st.booleans(),
)
@example(angle=0.001, shape=chord, tools=(), climb=True)  # thinner than what may stay: refused
@example(angle=0.03, shape=chord, tools=("mill-6",), climb=True)  # 0.011 mm deep into the rim
@example(angle=0.05, shape=bulge, tools=(), climb=False)
def test_recess_crosses_the_rim_at_any_angle(angle, shape, tools, climb) -> None:
    part = disc(shape(angle))
    wanted = CamSettings.model_validate({"tools": tools, "climb": climb})
    try:
        job = make_job(part, wanted, choose_tools(part, wanted, LIBRARY))
        program = plan(job)
    except MechwrightError as error:
        refusal = str(error)
    else:
        refusal = ""
    if refusal:
        assert "takes nothing of the plate" in refusal or "no listed end mill enters" in refusal
        return
    proof = prove(posted(job, program), job)
    assert [check.message for check in proof.checks.values() if not check.passed] == []


def test_a_recess_thinner_than_what_may_stay_is_refused() -> None:
    wanted = CamSettings()
    part = disc(chord(0.02))  # 0.005 mm
    job = make_job(part, wanted, choose_tools(part, wanted, LIBRARY))
    with pytest.raises(MechwrightError, match="recess takes nothing of the plate"):
        plan(job)


def test_a_link_may_not_cut_a_corner_that_stands_between_its_points() -> None:
    free = shapely.box(0, 0, 20, 10).difference(shapely.Polygon([(10, -1), (10.01, 5.001), (10.02, -1)]))
    assert not stays_inside(free, (1.0, 5.0), (19.0, 5.0))
    assert stays_inside(free, (1.0, 5.1), (19.0, 5.1))
    assert stays_inside(free, (1.0, 5.0), (1.0, 5.0))


def test_a_lead_is_taken_only_if_all_of_it_is_free() -> None:
    ring = np.array([(0.0, 0.0), (30, 0), (30, 30), (0, 30), (0, 0)])
    ring = shapely.get_coordinates(shapely.segmentize(shapely.LineString(ring), 1.0))
    asked = []

    def exact(way) -> bool:
        asked.append(way)
        return len(asked) > 2

    def everywhere(points):
        return np.ones(len(points), dtype=bool)

    found = best_start(ring, [(3.0, math.pi / 2)], True, everywhere, everywhere, exact)
    assert found is not None
    assert len(asked) == 3
    # The lead comes in on an arc of its radius and leaves on another, tangent to the ring where they meet.
    way = asked[-1]
    np.testing.assert_allclose(way[len(way) // 2], ring[found[0]], atol=1e-9)
    assert np.hypot(*(way[0] - way[-1])) == pytest.approx(6.0)
    assert best_start(ring, [(3.0, math.pi / 2)], True, everywhere, everywhere, lambda way: False) is None
