"""Layers and diameters that name screws: counterbores, countersinks, and what is refused with its place."""

import pytest
from test_drawings_read import box, part_in, saved

from mechwright.contracts.details import Chamfer, Thread
from mechwright.contracts.part import Bore
from mechwright.contracts.threads import named
from mechwright.drawings.asked import Asked
from mechwright_cad.exporters import dxf


def holes(layer: str, *radii: float, at: tuple[float, float] = (20, 20)):
    def draw(space):
        box(space, 0, 0, 60, 40, "OUTLINE")
        for radius in radii:
            space.add_circle(at, radius, dxfattribs={"layer": layer})

    return draw


@pytest.mark.parametrize(
    ("layer", "radii", "sizes"),
    [
        ("SCREW_M6", (3.3,), [(11.0, 0.0), (6.6, 6.4)]),
        ("CBORE_ISO4762_M6", (5.5,), [(11.0, 0.0), (6.6, 6.4)]),
        ("screw-m6", (3.3, 5.5), [(11.0, 0.0), (6.6, 6.4)]),  # shank and head are one hole
        ("SCREW_1_4", (3.5,), [(10.5664, 0.0), (7.1374, 6.985)]),
        ("SCREW_#10", (2.5,), [(8.8392, 0.0), (5.6134, 5.461)]),
    ],
)
def test_a_layer_of_screws_has_counterbores(layer, radii, sizes):
    part, told = part_in(saved(holes(layer, *radii)))
    assert told.faults == []
    found = [(f.diameter, f.top) for f in part.features if isinstance(f, Bore)]
    assert sorted(found, reverse=True) == [pytest.approx(one, abs=1e-4) for one in sizes]


def test_countersunk_screws_and_diameters_that_name_one():
    part, _ = part_in(saved(holes("SUNK_M4", 2.25)))
    (sink,) = [detail for detail in part.details if isinstance(detail, Chamfer)]
    assert sink.width == pytest.approx((8.96 + 0.2 - 4.5) / 2)
    part, told = part_in(saved(holes("THROUGH", 3.3)), Asked(holes=((6.6, "screw M6"),)))
    assert told.faults == []
    assert {f.diameter for f in part.features if isinstance(f, Bore)} == {11, 6.6}


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (holes("SCREW_M7", 4), "no screws M7"),
        (holes("SUNK_1-4", 4), "heads of 82 degrees"),
        (holes("SCREW", 4), "no screw with a seat that is known"),
        (holes("SCREW_M6", 6), "X20.000 Y20.000: bore-1 of part plate is drawn with 12 mm"),
        (holes("SCREW_M6", 3.3, at=(6, 20)), "leaves a wall of 0.50 mm"),
    ],
)
def test_what_is_no_screw_or_does_not_fit_is_refused_by_name(draw, said):
    part, told = part_in(saved(draw))
    assert part is None
    assert said in told.faults[0].message


@pytest.mark.parametrize(("thread", "refused"), [(10.0, True), (9.8, True), (5.0, False)])
def test_an_external_thread_is_refused_by_name(thread, refused):
    """Round an island it is external; a narrower one in the island is a threaded hole in a boss."""

    def draw(space):
        box(space, 0, 0, 60, 40, "OUTLINE")
        box(space, 5, 5, 50, 35, "POCKET_3")
        space.add_circle((25, 20), 10 / 2, dxfattribs={"layer": "POCKET_3"})
        layer = {10.0: "M10", 9.8: "M10", 5.0: "M5"}[thread]
        space.add_circle((25, 20), thread / 2, dxfattribs={"layer": layer})

    part, told = part_in(saved(draw))
    assert (part is None) is refused
    if refused:
        assert "M10 at X25.000 Y20.000 is drawn round an island, an external thread" in told.faults[0].message


@pytest.mark.parametrize(
    ("layer", "thread", "depth"),
    [
        ("M5_LH", "M5x0.8 LH", 10.0),
        ("M5_LH_6", "M5x0.8 LH", 6.0),
        ("1_4-20_UNC", "1/4-20 UNC", 10.0),
        ("THREAD 1_4-20 UNC LH", "1/4-20 UNC LH", 10.0),
        ("#10-32_UNF_6", "#10-32 UNF", 6.0),
        ("TAP_5_16-18-UNC", "5/16-18 UNC", 10.0),
    ],
)
def test_left_hand_and_inch_threads_have_layers(layer, thread, depth):
    size = named(thread).diameter
    part, told = part_in(saved(holes(layer, size / 2)))
    assert told.faults == []
    (found,) = [detail for detail in part.details if isinstance(detail, Thread)]
    assert (found.designation, found.depth) == (thread, depth)
    drawn_again, _ = part_in(dxf.part(part))
    assert drawn_again.details == part.details


@pytest.mark.parametrize(
    ("layer", "said"), [("1_4-21_UNC", "is no thread of ASME B1.1"), ("BORE_LH", "'LH' is not understood")]
)
def test_threads_that_do_not_exist_are_refused(layer, said):
    part, told = part_in(saved(holes(layer, 3)))
    assert part is None
    assert said in told.faults[0].message
