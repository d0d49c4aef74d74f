"""What the setup sheet says of holding, of edges, and of sizes that are typed in."""

import shapely
from planning_parts import LIBRARY, bore, part, rounded_box

from mechwright_cam.pages.picture import plan_view
from mechwright_cam.pages.setup_sheet.holding import edge_line, holding_lines
from mechwright_cam.pages.setup_sheet.inspection import Measured
from mechwright_cam.planning.holding_force import holding
from mechwright_cam.planning.remarks import lay_out
from mechwright_cam.setup.clamping import strap_box, widest_channel
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import MILLIMETRES
from mechwright_cam.shop.settings import CamSettings


def laid(of: object, **settings: object) -> Job:
    job, _ = lay_out(of, CamSettings.model_validate(settings), LIBRARY)  # type: ignore[arg-type]
    assert job is not None
    return job


def said(job: Job) -> str:
    return " ".join(holding_lines(job, MILLIMETRES))


def test_straps_are_named_with_their_force_and_their_places() -> None:
    job = laid(part(rounded_box(120, 60, 5)))
    found, words = holding(job), said(job)
    assert found.push is not None
    assert found.way is not None
    for figure in (found.push.force, 2 * found.push.force, found.way.holds):
        assert f"{figure:.0f} N" in words
    assert "on the front edge at X" in words
    assert "on the rear edge at X" in words
    assert f"{found.tab_safety:.1f} times" in words
    view = plan_view(job)
    assert view.count(">M8<") == len(found.way.straps) == 4


def test_straps_lie_on_the_rim_and_not_on_the_cut() -> None:
    for size in ((120, 60), (60, 120), (50, 50)):
        job = laid(part(rounded_box(*size, 5)))
        plate, cut = shapely.box(*job.stock), job.target.buffer(widest_channel(job))
        for strap in holding(job).way.straps:  # type: ignore[union-attr]
            box = shapely.box(*strap_box(job, strap))
            assert shapely.covers(plate, box)
            assert shapely.distance(box, cut) > 0


def test_a_holder_that_passes_over_the_straps_asks_for_longer_mills() -> None:
    job = laid(part(rounded_box(120, 60, 5)))
    assert "Holders of ⌀40 pass over the straps" in said(job)
    slim = [tool.model_copy(update={"holder_diameter": 16.0}) for tool in job.tools]
    assert "pass over" not in said(Job(job.part, job.settings, tuple(slim), job.origin, job.stock, job.tabs))


def test_screws_glue_and_larger_stock_are_named_where_the_rim_is_too_narrow() -> None:
    round_one = laid(part(rounded_box(100, 100, 49.9)), stock={"margin": 18})
    assert "4 screws M5 through the waste, 8.8, bear" in said(round_one)
    assert plan_view(round_one).count(">M5<") == 4
    square = said(laid(part(rounded_box(100, 60, 0.1)), stock={"margin": 14}))
    assert "no room for that" in square
    assert "superglue between two layers of masking tape" in square


def test_a_clamp_through_the_bore_that_is_too_weak_is_told() -> None:
    large = laid(part(rounded_box(160, 160, 5), bore(12)), hold={"method": "bore"})
    assert "That is too little" in said(large)


def test_edges_that_no_program_breaks_are_for_the_file() -> None:
    of = laid(part(rounded_box(100, 60, 5)))
    assert edge_line(of, MILLIMETRES).startswith("The program breaks no edges")


def test_a_size_with_limits_is_judged_where_it_is_typed_in() -> None:
    assert Measured("width", "10.00", "9.80", "10.20", "ISO 2768-m").has_limits
    assert not Measured("width", "10.00", "–", "10.20", "").has_limits
