"""A Geneva wheel as MuJoCo turns it, by contact alone: roller in slot, locking disc in arc."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
import shapely
from by_night import by_night
from mujoco_witness import mujoco

from mechwright import Bore, Loop, Outline, Part, Pocket, Profile, circle
from mechwright_cad.exporters.simulation import mjcf
from mechwright_cad.solids.convex import CHORD, convex_pieces, prisms
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.family import Geneva

FACTS = json.loads((Path(__file__).parents[2] / "tests/data/simulation.json").read_text())["facts"]
TABLES = {
    "G1": {
        "groove_clearance": 0.05,
        "law": "cycloidal",
        "crank_half_angle": 50,
        "offset_angle": 5,
        "lock_radius": 70,
        "thickness": 13.5,
    },
    "G2": {
        "groove_clearance": 0.05,
        "slots": 6,
        "law": "straight",
        "entry_radius": 80,
        "roller_radius": 4,
        "lock_radius": 30,
        "bore": 12,
        "driver_bore": 6,
        "pin_diameter": 6,
        "fixing": 2.2,
    },
}
HALF = 0.025
"""Half of a slot's clearance, mm."""


class Indexer:
    """A Geneva mechanism in MuJoCo: driver and wheel, with nothing between them but contact."""

    def __init__(self, table):
        self.params = Geneva.Params.model_validate(table)
        family = Geneva()
        self.motion = family.solve(self.params, 3601)
        text = mjcf.assembly("geneva", family.parts(self.params), self.motion)
        self.model = mujoco.MjModel.from_xml_string(text.decode())
        self.data = mujoco.MjData(self.model)

    def law(self, angle):
        """Wheel angle of the motion at a driver angle, rad."""
        channels = self.motion.channels
        return float(np.interp(angle, channels["theta_d"].values, channels["theta_w"].values))

    def meets(self, driver, wheel):
        self.data.qpos[:] = driver, wheel
        mujoco.mj_fwdPosition(self.model, self.data)
        return bool((self.data.contact.dist[: self.data.ncon] < 0).any())

    def free(self, driver):
        """How far the wheel can turn each way, rad, by bisection on MuJoCo's own contacts."""
        rest = self.law(driver)
        assert not self.meets(driver, rest)
        found = []
        for sense in (1, -1):
            low, high = 0.0, 0.03
            for _ in range(20):
                middle = (low + high) / 2
                low, high = (low, middle) if self.meets(driver, rest + sense * middle) else (middle, high)
            found.append(low)
        return found


@pytest.fixture(scope="module", params=["G1", "G2"])
def indexer(request):
    return request.param, Indexer(TABLES[request.param])


def test_the_wheel_has_the_play_of_its_slots(indexer):
    """Play is 2 h over the lever; chords of the walls take CHORD of h away at most.

    Near the ends of a stroke the disc holds as well, and in a curved slot the lever vanishes at mid stroke.
    """
    name, of = indexer
    seen = 0
    for fact in FACTS:
        inputs, play = fact["inputs"], fact["expected"]
        at = inputs.get("theta_d_deg")
        half = math.degrees(math.pi / 2 - math.pi / 6) if name == "G2" else 50
        if fact["name"] != "geneva.play_total" or inputs["design"] != name or not 5 < at < 2 * half - 5:
            continue
        if name == "G1" and abs(at - half) < 8:
            continue
        total = sum(of.free(math.radians(at)))
        assert (1 - 1.5 * CHORD / HALF) * play < total < 1.01 * play, inputs
        seen += 1
    assert seen >= 5


def test_the_disc_locks_the_wheel(indexer):
    name, of = indexer
    (play,) = (
        f["expected"] for f in FACTS if f["name"] == "geneva.lock_play_half" and f["inputs"]["design"] == name
    )
    for driver in (math.pi, 1.25 * math.pi):
        for way in of.free(driver):
            assert 0.95 * play < way < 1.05 * play


@pytest.mark.parametrize(
    "table",
    [
        pytest.param(TABLES["G2"], id="straight"),
        pytest.param({"construction": "backed", "fixing": 3.0, **TABLES["G1"]}, id="islands", marks=by_night),
        pytest.param({**TABLES["G2"], "rollers": 2}, id="two-rollers"),
    ],
)
def test_the_wheel_indexes_under_contact(table):
    """A motor turns the driver at 1 rev/s; the wheel stops a slot further, where the disc holds it."""
    of = Indexer(table)
    model, data, speed = of.model, of.data, math.tau
    data.qvel[0] = speed
    mujoco.mj_forward(model, data)
    inertia, stiff = np.zeros(model.nv), 1000.0
    mujoco.mj_mulM(model, data, inertia, np.array([1.0, 0.0]))
    steps = round(1.0 / model.opt.timestep)
    errors = []
    for step in range(steps + 1):
        ahead = speed * step * model.opt.timestep - data.qpos[0]
        data.ctrl[0] = inertia[0] * (stiff**2 * ahead + 2 * stiff * (speed - data.qvel[0]))
        mujoco.mj_step(model, data)
        if step % 10 == 0:
            errors.append((float(data.qpos[0]), abs(data.qpos[1] - of.law(data.qpos[0]))))
    index = math.tau / of.params.slots * of.params.rollers
    assert data.qpos[0] == pytest.approx(speed, abs=0.02)
    assert data.qpos[1] == pytest.approx(index, abs=2e-3)
    angle, off = np.array(errors).T
    assert off.max() < (0.003 if of.params.law == "straight" else 0.020)
    if of.params.law == "straight":
        # Well inside a stroke: half the clearance over the distance of the roller from the wheel's axis, and what
        # the soft contact gives, 1.3e-5 rad, for a moment twice that where the roller meets the other wall.
        frame = mechanism_of(of.params)
        phi = frame.crank_half - angle % frame.pitch
        inside = np.abs(phi) < 0.9 * frame.crank_half
        lever = np.abs(frame.axes - frame.crank * np.exp(1j * phi[inside]))
        assert inside.sum() > 100
        assert (off[inside] < HALF / lever + 3e-5).all()


def test_pieces_are_convex_and_make_up_the_section():
    ring = (
        shapely.Point(0, 0).buffer(10, quad_segs=32).difference(shapely.Point(2, 0).buffer(4, quad_segs=32))
    )
    apart = shapely.union_all([ring, shapely.box(20, 0, 21, 5)])
    pieces = [shapely.Polygon(piece) for piece in convex_pieces(apart)]
    for piece in pieces:
        assert piece.convex_hull.area == pytest.approx(piece.area, rel=1e-12)
    assert sum(piece.area for piece in pieces) == pytest.approx(apart.area, rel=1e-12)
    assert shapely.union_all(pieces).symmetric_difference(apart).area == pytest.approx(0, abs=1e-9)
    assert len(pieces) < 200


def test_a_recess_is_left_out_of_the_prisms():
    plate = Loop.polygon([(0, 0), (30, 0), (30, 20), (0, 20)])
    groove = Loop.polygon([(-5, 8), (35, 8), (35, 12), (-5, 12)])
    hole = Loop((circle((5.0, 4.0), 2.0, clockwise=True),))
    features = (
        Bore("hole", (5.0, 4.0), 4.0, 0, 5),
        Pocket("groove", groove, (), 0, 2),
        Profile("outside", plate, "outside", 0, 5),
    )
    part = Part("plate", Outline(plate, (hole,)), 5.0, "steel", machined=features)
    volume = sum(
        shapely.MultiPoint(points[:, :2]).convex_hull.area * np.ptp(points[:, 2]) for points in prisms(part)
    )
    assert volume == pytest.approx(5 * (600 - math.pi * 4) - 2 * 4 * 30, rel=1e-3)
