"""Ramped tabs: the cutter goes over them on slopes, and they stay as they are drawn."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
import shapely
from by_control import posted, prove
from by_night import examples
from height_map import Simulation, cutters, read
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from planning_parts import LIBRARY, job, lobes, part, plate
from rs274 import needs_rs274, run_rs274

from mechwright.contracts.part import Profile
from mechwright.errors import DesignError, MechwrightError
from mechwright.geometry import Loop
from mechwright_cam.operations.over_tabs import LIFT
from mechwright_cam.pages.picture import plan_view
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings

RAMPED = {"tab_shape": "ramped"}


def text_of(of):
    return posted(of)


def proven(of):
    text = text_of(of)
    proof = prove(text, of)
    assert proof.ok, [check.message for check in proof.failures]
    return text, proof


def layer_of(text):
    """The lines that belong to the layer of the tabs."""
    return text[text.index("over the tabs: rough") :].splitlines()


def test_a_slope_is_no_deep_cut():
    """One move goes down the whole slope, further than mill-2 may cut in steel, lap by lap a little deeper."""
    proven(
        job(replace(plate(), material="steel"), "mill-2", hold={**RAMPED, "tab_height": 2.5, "tab_angle": 40})
    )


@pytest.mark.parametrize(
    ("angle", "height", "tools"),
    [(8, 0.6, ("mill-6",)), (15, 1.5, ("mill-6", "mill-3")), (40, 1.5, ("mill-6",))],
)
def test_the_tab_that_stays_is_the_one_drawn(angle, height, tools):
    of = job(plate(), *tools, hold={**RAMPED, "tab_angle": angle, "tab_height": height, "tabs": 2})
    text, _ = proven(of)
    seen = Simulation(of.stock, of.thickness, pitch=0.2)
    seen.run(read(text), cutters(of))
    slope = math.tan(math.radians(angle))
    for tab in of.tabs:
        assert tab.slope == pytest.approx(slope)
        (x, y), (tx, ty) = tab.at, tab.along
        # Along the middle of the channel, from the tab's middle down to the underside.
        s = np.linspace(-1.0, 1.0, 41) * (1.0 + height / slope)
        px, py = x + s * tx + 3.2 * ty, y + s * ty - 3.2 * tx
        found = seen.height[
            ((py - seen.y[0]) / 0.2).round().astype(int), ((px - seen.x[0]) / 0.2).round().astype(int)
        ]
        drawn = -of.thickness + height - slope * np.maximum(np.abs(s) - 1.0, 0.0)
        assert (found >= drawn - 0.3 * slope).all()  # a cell is 0.2 mm wide
        assert (found <= drawn + LIFT + 0.6 * slope).all()  # and a stamp of this simulation longer
    assert not seen.complaints


def test_the_cutter_never_stops_over_a_tab():
    layer = layer_of(proven(job(plate(), "mill-6", hold=RAMPED))[0])
    lines = [line for line in layer if not line.startswith(("G61", "G64"))]
    finish = next(k for k, line in enumerate(lines) if "over the tabs: finish" in line)
    assert (
        sum(line.startswith("G0") or line == "Z1" for line in lines[1 : finish - 1]) <= 3
    )  # there, and away
    assert not [line for line in lines[4 : finish - 2] if re.fullmatch(r"(G1 )?Z\S+( F\S+)?", line)]


def test_it_takes_about_as_long_as_lifting():
    times = {
        shape: proven(job(plate(), "mill-6", hold={"tab_shape": shape, "tabs": 8, "tab_angle": 30}))[
            1
        ].time_estimate_s
        for shape in ("rectangular", "ramped")
    }
    assert times["ramped"] == pytest.approx(times["rectangular"], rel=0.1)


def test_downhill_the_cutter_sinks_no_faster_than_in_a_plunge():
    of = job(plate(), "mill-6", hold={**RAMPED, "tab_angle": 45})
    moves = read(proven(of)[0])
    plunge = (
        max(move.feed for move in moves if move.kind == "feed" and move.points[-1][2] < 0 and move.feed > 0)
        * 0.31
    )
    steep = [
        m for m in moves if m.kind == "feed" and m.points[-1][2] < m.points[0][2] - 0.2 and m.points[0][2] < 0
    ]
    assert steep
    for move in steep:
        drop = move.points[0][2] - move.points[-1][2]
        way = np.hypot(np.hypot(*np.diff(move.points[:, :2], axis=0).T).sum(), drop)
        assert move.feed * drop / way <= plunge


@needs_rs274
def test_linuxcnc_accepts_it(tmp_path):
    of = job(plate(), "mill-6", "mill-3", hold=RAMPED)
    table = "".join(f"T{tool.number} P{tool.number}\n" for tool in of.tools)
    found = run_rs274(text_of(of), tmp_path, table)
    assert found.ok, found.error


@pytest.mark.parametrize("deep", [0.02, 0.2])
def test_a_path_too_deep_on_a_slope_is_found(deep):
    of = job(plate(), "mill-6", hold=RAMPED)
    text = text_of(of)
    head, layer = text[: text.index("over the tabs")], text[text.index("over the tabs") :]
    slopes = sorted({z for z in re.findall(r"Z(-[\d.]+)", layer) if -5.9 < float(z) < -4.9}, key=float)
    assert slopes
    lowered = re.sub(r"Z(-4\.99\d*|-5\.0\d*)", lambda m: f"Z{float(m[1]) - deep:.4f}", layer)
    names = {check.name for check in prove(head + lowered, of).failures}
    assert "tabs" in names


def test_a_program_without_tabs_cuts_them_and_one_with_upright_tabs_does_not_know_the_slopes():
    ramped = job(plate(), "mill-6", hold=RAMPED)
    free = replace(ramped, tabs=())
    assert "tabs" in {check.name for check in prove(text_of(free), ramped).failures}
    upright = job(plate(), "mill-6", hold={"tab_width": ramped.tabs[0].width})
    upright = replace(
        upright, tabs=tuple(replace(tab, slope=math.inf, shape=tab.level) for tab in ramped.tabs)
    )
    assert "tabs" in {check.name for check in prove(text_of(upright), ramped).failures}


def test_every_parameter_changes_the_program():
    texts = {
        text_of(job(plate(), "mill-6", hold=hold))
        for hold in (
            {},
            RAMPED,
            {**RAMPED, "tab_angle": 20},
            {**RAMPED, "tab_width": 4},
            {**RAMPED, "tab_height": 0.5},
        )
    }
    assert len(texts) == 5


def test_the_picture_shows_the_slopes():
    assert 'fill-opacity="0.35"' in plan_view(job(plate(), "mill-6", hold=RAMPED))
    assert 'fill-opacity="0.35"' not in plan_view(job(plate(), "mill-6"))


def refusal(of, *tools, **hold):
    with pytest.raises(DesignError) as caught:
        make_job(of, CamSettings.model_validate({"hold": {**RAMPED, **hold}}), tools)
    return str(caught.value)


def test_a_mill_that_does_not_cut_at_its_centre_goes_down_no_steep_slope():
    hollow = LIBRARY.get("mill-6").model_copy(update={"centre_cutting": False})
    assert "mill-6 does not cut at its centre" in refusal(plate(), hollow)
    hold = {**RAMPED, "tab_angle": 3, "tab_height": 0.3, "tabs": 2}
    proven(make_job(plate(), CamSettings.model_validate({"hold": hold, "breakthrough": 0.1}), (hollow,)))


def test_tabs_too_long_for_the_part_or_for_each_other_are_refused():
    mill = LIBRARY.get("mill-3")
    small = part(Loop.polygon([(0, 0), (8, 0), (8, 8), (0, 8)]))
    assert "too long for outside" in refusal(small, mill, tabs=2)
    assert "ramped tabs meet" in refusal(plate(), mill, tabs=24, tab_angle=17)
    assert "is not below the thickness" in refusal(plate(), mill, tab_height=6)


def test_tab_sites_without_room_for_slopes_are_refused():
    outer = plate().outline.outer
    sites = tuple((p, 4.0) for p in ((0.0, -20.0), (30.0, 0.0), (0.0, 20.0), (-30.0, 0.0)))
    sited = plate(machined=(Profile("outside", outer, "outside", 0, 6.0, sites),))
    assert "two slopes" in refusal(sited, LIBRARY.get("mill-6"))
    assert "two slopes" in refusal(sited, LIBRARY.get("mill-6"), tab_width=2)
    proven(job(sited, "mill-6", hold={**RAMPED, "tab_angle": 45}))


@settings(
    max_examples=examples(1, 8),
    deadline=None,
    suppress_health_check=list(HealthCheck),
    phases=[Phase.explicit, Phase.reuse, Phase.generate],
)
@given(
    count=st.integers(2, 9),
    depth=st.floats(1, 14),
    height=st.floats(0.3, 3),
    angle=st.floats(3, 45),
    tabs=st.integers(2, 6),
    climb=st.booleans(),
    tools=st.sampled_from([("mill-6",), ("mill-4",), ("mill-8", "mill-3")]),
)
def test_any_outline_with_ramped_tabs_is_cut_or_refused(count, depth, height, angle, tabs, climb, tools):
    of = part(lobes(count, 26.0, depth, points=600))
    hold = {**RAMPED, "tabs": tabs, "tab_height": height, "tab_angle": angle}
    try:
        made = job(of, *tools, hold=hold, climb=climb)
        text = text_of(made)
    except MechwrightError as error:
        assert str(error).startswith("cam.")  # noqa: PT017
        return
    proof = prove(text, made)
    assert proof.ok, [check.message for check in proof.failures]
    shapes = [tab.shape for tab in made.tabs]
    assert shapely.union_all(shapes).area == pytest.approx(sum(shape.area for shape in shapes))


def test_an_outline_that_differs_from_the_wall_by_rounding_does_not_cut_tabs_off():
    rim = Loop.polygon([(-30, -20), (28, -24), (33, 19), (-27, 22)])
    for by in (0.0, 3e-10):
        of = job(
            part(rim.moved(by, -by, 0.0), machined=(Profile("outside", rim, "outside", 0.0, 6.0),)),
            "mill-8",
            hold={**RAMPED, "tabs": 3},
        )
        inside = shapely.Polygon(rim.flatten())
        assert all(shapely.intersection(tab.shape, inside).area > tab.width for tab in of.tabs)
        proven(of)
