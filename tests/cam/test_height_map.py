"""Posted programs, cut on a height map that knows nothing of the planner, the interpreter or the proof."""

import itertools

import numpy as np
import pytest
import shapely
from by_night import by_night
from height_map import Simulation, cutters, read
from planning_parts import LIBRARY, bore, keyed_bore, lobes, part, plate, rounded_box
from planning_simulation import keep_at

from mechwright.contracts.part import Bore, Pocket, Profile
from mechwright.geometry import Loop
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.planning import choose_tools, plan
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import ToolKind

PITCH = 0.15
BOX = rounded_box(44, 28, 6)
CLAMP = {"method": "bore", "clamp_diameter": 12}
BENT = Loop.polygon([(0, 0), (40, 0), (40, 14), (14, 14), (14, 34), (0, 34)])
RECESSED = part(
    BOX,
    bore(8, (-14, 0)),
    machined=(
        Pocket("pocket", rounded_box(20, 18, 4).moved(7, 0), (rounded_box(6, 6, 2.5).moved(7, 0),), 0, 2.5),
        Bore("bore", (-14.0, 0.0), 8, 0, 6),
        Profile("outside", BOX, "outside", 0, 6),
    ),
)
CASES = {
    "toothed-steel": (part(lobes(9, 15.0, 4.0, 900, 1.5), bore(8), material="steel"), {}),
    "toothed-clamped": (part(lobes(9, 15.0, 4.0, 900, 1.5), bore(8)), {"hold": CLAMP}),
    "bent-brass": (part(BENT, bore(6, (7, 7)), thickness=4, material="brass"), {"climb": False}),
    "slotted": (plate(rounded_box(24, 8.05, 4.02, clockwise=True), bore(5, (20, 12))), {"origin": "corner"}),
    "keyed-pom": (plate(keyed_bore(14, 5, 16.3), material="pom"), {}),
    "recessed": (RECESSED, {}),
}


LIKE = {"toothed-steel", "slotted"}
"""Other cases have teeth, and an opening as long."""


@pytest.fixture(
    scope="module", params=[pytest.param(name, marks=by_night if name in LIKE else ()) for name in CASES]
)
def cut(request):
    of, changes = CASES[request.param]
    settings = CamSettings.model_validate(changes)
    job = make_job(of, settings, choose_tools(of, settings, LIBRARY))
    moves = read(LinuxCnc().write(plan(job)))
    simulation = Simulation(job.stock, job.thickness, PITCH)
    simulation.run(moves, cutters(job))
    return job, moves, simulation


def layers(job):
    heights = {0.0, -job.thickness, *(tab.top for tab in job.tabs)}
    heights |= {-min(f.top + f.depth, job.thickness) for f in job.features}
    ordered = sorted(heights, reverse=True)
    return [z for a, b in itertools.pairwise(ordered) for z in (a - 0.02, b + 0.02)]


def test_nothing_of_part_and_tabs_is_cut(cut):
    job, _, simulation = cut
    for z in layers(job):
        assert simulation.gouge(keep_at(job, z), z) <= 0.005


def test_nothing_stays_that_the_cutters_reach(cut):
    job, moves, simulation = cut
    used = {move.tool for move in moves}
    mills = [t for t in job.tools if t.kind is ToolKind.END_MILL and t.number in used]
    finest = min(tool.radius for tool in mills)
    widest = max(tool.diameter for tool in mills)
    for z in layers(job):
        keep = keep_at(job, z)
        stays = keep.buffer(finest + 0.003, quad_segs=64).buffer(-finest - 0.003, quad_segs=64)
        band = keep.buffer(finest, quad_segs=32).difference(stays.buffer(0.01))
        near = [tab.shape.buffer(widest) for tab in job.tabs if z < tab.top]
        band = band.difference(shapely.union_all(near)).intersection(shapely.box(*job.stock))
        assert len(simulation.left(band, z)) == 0


def test_no_rapid_meets_stock(cut):
    assert cut[2].complaints == []


def test_load_of_every_mill(cut):
    job, moves, simulation = cut
    table = simulation.table()
    for tool in job.end_mills:
        rows = table[table[:, 1] == tool.number]
        if not len(rows):
            continue
        data = tool.cutting[job.part.material]
        angle, depth, down = rows[:, 7], rows[:, 8], rows[:, 9] == 1
        # Straight down only in the clear, but for crumbs of the grid; else at the slow feed of a plunge.
        met = [moves[int(index)] for index in rows[:, 0]]
        load = np.array([m.feed / m.rpm / tool.flutes for m in met]) / data.chip_load
        share = rows[:, 6] / (np.pi * tool.radius**2)
        assert (load[down & (depth > 0.05) & (share > 0.05)] <= 0.31).all()
        # With its whole width no deeper than a roughing pass; crumbs that stand high have next to no area.
        wide = ~down & (angle > 120) & (rows[:, 6] > 0.3 * tool.radius * depth)
        step_down = data.step_down * tool.diameter
        assert (depth[wide] <= step_down + 0.02).all()
        # The feed: no chip is thicker than the data say, up to three times that per tooth where little of the
        # mill is engaged; beside a tab it is more for a moment. And not idling.
        fast = ~down & (depth > 0.05) & (load > 1.001)
        chip = load[fast] * np.sin(np.radians(np.minimum(angle[fast], 90)))
        assert (angle[fast] <= 90).all()
        assert np.count_nonzero(chip > 1.25) <= 0.01 * chip.size
        every = [m for m in moves if m.tool == tool.number and m.kind == "feed"]
        load = np.array([m.feed / m.rpm / tool.flutes for m in every])
        assert (load <= 3 * data.chip_load * 1.001).all()
        assert np.median(load) > 0.2 * data.chip_load
        assert all(m.rpm * np.pi * tool.diameter / 1000 <= data.cutting_speed * 1.01 for m in every)
