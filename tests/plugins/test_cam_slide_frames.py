"""A slide on a linear guide in a frame, and the spring that holds it on its cam."""

import math
from contextlib import suppress

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mechwright.contracts.mounting import MountingError
from mechwright.contracts.on_plates import Slideway
from mechwright.contracts.surroundings import Surroundings
from mechwright.machine.framed import framed
from mechwright.machine.settings import MachineSettings
from mechwright.standards.linear_guides import linear_guide, linear_guides
from mechwright.standards.springs import SCATTER
from mechwright_cam_follower.family import CamFollower
from mechwright_cam_follower.kinematics.mechanism import Mechanism, mechanism_of
from mechwright_cam_follower.kinematics.motion import motion_of
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.parts.moved_mass import own_mass
from mechwright_cam_follower.parts.parts import parts_of
from mechwright_cam_follower.parts.spring_parts import spring_place
from mechwright_cam_follower.spring.choice import mounted_spring

FAMILY = CamFollower()
MACHINE = {
    "laws": ["modified-sine", "3-4-5"],
    "angles": [110, 40, 130, 80],
    "lifts": [20, 20, 0, 0],
    "roller_radius": 9,
    "speed": 90,
    "mass": 0.6,
    "load": -10,
    "guide": "linear-15",
    "spring": "auto",
    "bore": 12,
}
BASE = MachineSettings(frame="base", motor="none")


def design(**changes: object) -> CamParams:
    table = {**MACHINE, **changes}
    return CamParams.model_validate({key: value for key, value in table.items() if value is not None})


def frame_of(params: CamParams, **settings: object) -> Surroundings:
    return framed(BASE.model_copy(update=settings), FAMILY, params)


@pytest.mark.parametrize("guide", linear_guides(), ids=lambda one: one.name)
def test_a_guide_is_drawn_as_its_table_says(guide):
    cadquery = pytest.importorskip("cadquery")
    length = guide.rail_length(61.0)
    assert 61 <= length < 61 + guide.pitch
    holes = guide.rail_holes(length)
    assert (holes[0], holes[-1]) == pytest.approx((guide.end, length - guide.end))
    assert np.diff(holes) == pytest.approx(guide.pitch)
    rail, carriage = guide.rail_bought(length).shape.solid(), guide.carriage_bought.shape.solid()
    box = carriage.BoundingBox()
    assert (box.xlen, box.ylen, box.zmin, box.zmax) == pytest.approx(
        (guide.length, guide.width, guide.under, guide.height)
    )
    moved = carriage.moved(cadquery.Location((length / 2, 0, 0)))
    assert rail.intersect(moved).Volume() == pytest.approx(0, abs=1e-9)
    assert linear_guide(guide.name) == guide


def test_the_spring_of_a_slide_lies_along_its_way():
    """Its force is F0 + R (L - L0), and grows by R for each millimetre of lift."""
    params = design()
    m, mounted, place = mechanism_of(params), mounted_spring(params), spring_place(mechanism_of(params))
    assert mounted is not None
    assert place is not None
    assert place.stands.real == place.moves.real == m.offset
    assert abs(place.moves - place.stands) == pytest.approx(mounted.hooks.apart)
    lift = np.linspace(0, 20, 5)
    assert_allclose(mounted.press(lift) - mounted.press(np.zeros(1)), mounted.spring.rate * lift)
    assert_allclose(mounted.press(lift), mounted.pull(lift))
    rates = m.cycle.at(np.linspace(0, math.tau, 3001))
    asked = 10 - 0.6e-3 * rates.a * m.omega**2
    assert ((1 - SCATTER) * mounted.press(rates.s) > np.where(asked > 0, 1.098 * asked, asked)).all()


def test_rail_and_post_are_clear_of_the_cam_and_its_shaft():
    params = design(offset=6)
    m = mechanism_of(params)
    guide = linear_guide("linear-15")
    (way,), (post,) = FAMILY.mounting(params).slideways, FAMILY.mounting(params).posts
    motion = motion_of(params, 181)
    roller = motion.poses["roller"].position[:, 1].max() + m.roller
    assert way.start[1] >= max(roller, motion.scalars["cam_radius_max"].value) + 1.99
    carriage = motion.poses["follower"].position[:, 1] + way.carriage[1]
    assert carriage.min() - guide.length / 2 >= way.start[1]
    assert carriage.max() + guide.length / 2 <= way.start[1] + way.guide.length
    assert way.low == 11 - way.guide.high
    assert post.hangs
    assert math.hypot(*post.point) > 15


def test_a_slide_gets_a_frame_with_guide_and_spring():
    params = design()
    found = frame_of(params)
    assert not [one for one in found.findings if one.severity.value == "error"]
    parts = {part.name: part for part in found.parts}
    assert {"guide-rail", "guide-carriage", "spring-post", "screw-m3x10"} <= set(parts)
    (way,) = FAMILY.mounting(params).slideways
    lower = parts["lower-plate"]
    (plate,) = lower.instances
    assert plate.z + lower.thickness == pytest.approx(way.low), "the rail lies on the plate"
    threads = [one for one in lower.details if one.name.startswith("thread-rail")]
    assert len(threads) == len(way.guide.holes)
    bodies = found.around(motion_of(params, 7)).poses
    slide = bodies["follower"].position
    assert_allclose(bodies["guide-carriage"].position - slide, [[0, way.carriage[1], 0]] * 7, atol=1e-9)
    # The holes of the bar stand over the threads of the carriage.
    bar = next(part for part in parts_of(params) if part.name == "slide")
    holes = {one.name: one.centre for one in bar.features if one.name.startswith("carriage")}
    for number in range(1, 5):
        at = bodies[f"carriage-screw-{number}"].position[0] - slide[0]
        assert holes[f"carriage-{number}"] == pytest.approx(tuple(at[:2]))


def test_a_flat_slide_gets_a_frame():
    params = design(contact="flat", roller_radius=None, lifts=[8, 8, 0, 0], mass=1.5, thickness=12)
    found = frame_of(params)
    assert not [one for one in found.findings if one.severity.value == "error"]


@pytest.mark.parametrize(
    ("changes", "key", "works"),
    [
        ({"guide": None, "spring": None}, "parameters.guide", "linear-15"),
        ({"guide": "linear-12"}, "parameters.guide", "linear-15"),
        ({"spring": None}, "parameters.spring", "auto"),
        ({"thickness": 16}, "parameters.thickness", None),
        ({"contact": "flat", "roller_radius": None}, "parameters.thickness", 8),
    ],
)
def test_what_has_no_frame_is_refused_with_a_change_that_helps(changes, key, works):
    params = design(**changes)
    with pytest.raises(MountingError) as raised:
        FAMILY.mounting(params)
    assert str(raised.value).startswith(key)
    change = {name.partition(".")[2]: value for name, value in raised.value.proposed[0].items()}
    if works is not None:
        assert change == {key.partition(".")[2]: works}
    again = ""
    with suppress(MountingError):
        FAMILY.mounting(design(**{**changes, **change}))
        again = "none"
    if not again:
        with pytest.raises(MountingError) as second:
            FAMILY.mounting(design(**{**changes, **change}))
        again = str(second.value)
    assert not again.startswith(key), "the change helps"


def test_an_input_too_fast_for_the_spring_is_refused():
    found = frame_of(design(), speed=200)
    (finding,) = [one for one in found.findings if one.severity.value == "error"]
    assert finding.code == "frame.speed"
    assert {"machine.speed": 90} in finding.proposed


def test_parts_heavier_than_the_stated_mass_are_refused():
    finding = next(one for one in FAMILY.check(design(mass=0.2)) if one.code == "follower.mass")
    works = finding.proposed[0]["parameters.mass"]
    assert own_mass(mechanism_of(design(mass=works))) < works
    assert not [one for one in FAMILY.check(design(mass=works)) if one.code == "follower.mass"]


def test_masses_follow_the_parts():
    params = design()
    masses = FAMILY.masses(Mechanism(params))
    assert "rail" not in masses
    bar = next(part for part in parts_of(params) if part.name == "slide")
    area = bar.outline.outer.area - sum(abs(loop.area) for loop in bar.outline.inner)
    assert masses["slide"]() == pytest.approx(abs(area) * 8 * 7.85e-6, rel=1e-6)


def test_a_slideway_has_its_places_along_its_way():
    guide = linear_guide("linear-12").cut(61.0)
    way = Slideway(guide, "x", (1.0, 2.0), math.pi / 2, 0.0, (0.0, 0.0), 8.0, "k")
    assert guide.length == 70
    assert way.at(10.0, 3.0) == pytest.approx((-2.0, 12.0))
