"""What the crib decides: holes drilled, tapped and reamed, mills that are spared, processes that do better."""

import pytest
from planning_parts import LIBRARY, bore, job, lobes, part, plate, rounded_box

from mechwright.contracts.fits import hole_fit
from mechwright.contracts.part import Bore, Part
from mechwright_cam.operations.bending import pass_depth, powered_depth
from mechwright_cam.operations.drilling import CLEARANCES, is_clearance
from mechwright_cam.operations.ream import opened, reaming
from mechwright_cam.planning import choose_tools, plan
from mechwright_cam.planning.remarks import lay_out
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.power import available
from mechwright_cam.shop.settings import CamSettings

LARGE = rounded_box(90, 70, 5)


def names(of: Part, **settings: object) -> list[str]:
    return [tool.name for tool in choose_tools(of, CamSettings.model_validate(settings), LIBRARY)]


def fitted(size: float, at: tuple[float, float] = (0.0, 0.0), thickness: float = 6.0) -> Part:
    fit = hole_fit(size, "H7")
    return part(LARGE, machined=(Bore("pin", at, fit.middle, 0.0, thickness, fit),), thickness=thickness)


@pytest.mark.parametrize("size", [3.4, 4.5, 5.5, 6.6, 9.0])
def test_a_clearance_hole_is_drilled_to_size(size: float) -> None:
    of = part(LARGE, bore(size))
    assert is_clearance(size)
    assert f"drill-{size:g}" in names(of)
    done = [o.name for s in plan(job(of, *names(of))).sections for o in s.operations]
    assert f"drill {size:g}" in done
    assert not any(name.startswith("bore-1") for name in done)


@pytest.mark.parametrize("size", [5.0, 8.0, 10.0])
def test_a_hole_of_another_size_is_milled_to_its_place(size: float) -> None:
    """Nothing says what is in it, and a drill wanders."""
    assert size not in CLEARANCES
    of = part(LARGE, bore(size))
    done = [o.name for s in plan(job(of, *names(of))).sections for o in s.operations]
    assert "bore-1: finish" in done


@pytest.mark.parametrize("size", [3, 4, 5, 6, 8, 10, 12])
def test_a_hole_h7_is_milled_to_its_place_and_reamed(size: int) -> None:
    of = fitted(size)
    chosen = names(of)
    assert f"reamer-{size}" in chosen
    way = reaming(job(of, *chosen), of.features[0])  # type: ignore[arg-type]
    assert way is not None
    assert way.mill is not None
    assert 0.1 <= size - opened(of.features[0], way.reamer).diameter <= 0.4  # type: ignore[arg-type]
    done = [o.name for s in plan(job(of, *chosen)).sections for o in s.operations]
    assert done.index("pin: bore for the reamer") < done.index("pin: ream")
    assert "pin: finish" not in done


def test_a_hole_without_a_fit_is_reamed_only_by_a_reamer_that_the_design_names() -> None:
    of = part(LARGE, bore(8))
    assert "reamer-8" not in names(of)
    listed = job(of, "reamer-8", "mill-5", tools=["reamer-8", "mill-5"])
    assert reaming(listed, of.features[0]) is not None  # type: ignore[arg-type]


def test_a_mill_for_one_hole_is_spared_where_others_do_it() -> None:
    """A change of tool takes 18 s: two sizes of mill for two walls of like size are one too many."""
    window = rounded_box(40, 30, 6, clockwise=True)
    once = names(part(LARGE, window))
    assert len([name for name in once if "mill" in name or "alu" in name]) == 1
    free = names(part(LARGE, window), machine={"tool_change": 0})
    assert len(free) >= len(once)


def test_soft_material_gets_mills_of_three_flutes_at_most() -> None:
    of = plate()
    for material in ("aluminium", "pom", "7075"):
        for tool in choose_tools(part(LARGE, material=material), CamSettings(), LIBRARY):
            assert tool.flutes <= 3, (material, tool.name)
    steel = choose_tools(part(LARGE, material="steel"), CamSettings(), LIBRARY)
    assert any(tool.flutes == 4 for tool in steel)
    # With nothing else in the crib it is taken all the same.
    four = Library(tuple(tool for tool in LIBRARY if tool.name == "mill-8"))
    assert [tool.name for tool in choose_tools(of, CamSettings(), four)] == ["mill-8"]


def test_a_slow_feed_asks_for_fewer_flutes() -> None:
    machine = {"max_feed": 600, "spindle_min": 11000}
    (tool,) = choose_tools(plate(), CamSettings.model_validate({"machine": machine}), LIBRARY)
    assert tool.flutes == 1
    assert lay_out(plate(), CamSettings.model_validate({"machine": machine}), LIBRARY)[1] == []


def test_passes_are_as_deep_as_the_spindle_has_power_for() -> None:
    weak, strong = (
        job(plate(), "mill-12", machine={"spindle_power": power, "spindle_torque": 50})
        for power in (2.2, 4.4)
    )
    (mill,) = weak.mills
    assert powered_depth(strong, mill) == pytest.approx(2 * powered_depth(weak, mill))
    planned = mill.cutting["aluminium"].step_down * mill.diameter
    assert pass_depth(weak, mill, 6.3) == pytest.approx(powered_depth(weak, mill))
    assert powered_depth(weak, mill) < planned
    said = job(plate(), "mill-12", cutting={"mill-12": {"step_down": 0.5}})
    assert pass_depth(said, mill, 6.3) == planned
    assert float(available(Machine(), 8000)) == pytest.approx(0.8 * 2.2)


def notes(of: Part, **settings: object) -> list[str]:
    found = lay_out(of, CamSettings.model_validate(settings), LIBRARY)[1]
    return [one.message for one in found if one.code == "cam.better-process"]


def test_wire_erosion_is_named_for_deep_narrow_walls_of_steel() -> None:
    """Gaps of 1.7 mm in 10 mm of steel: a mill of 1.5 mm, 6.9 diameters deep."""
    slots = [rounded_box(1.7, 24, 0.84, clockwise=True).moved(6.0 * i - 24, 0.0, 0.0) for i in range(9)]
    (said,) = notes(part(LARGE, *slots, thickness=10.0, material="steel"), corner_mill=1.0)
    assert "wire erosion" in said
    assert "diameters deep" in said
    assert not any("wire" in one for one in notes(part(LARGE, *slots, thickness=10.0, material="pom")))


def test_a_waterjet_is_named_for_fine_teeth_of_steel() -> None:
    """Walls that take ten times its minutes."""
    of = part(lobes(48, 40.0, 4.0, 1500, 1.5), thickness=10.0, material="steel")
    (said,) = notes(of, corner_mill=0.5)
    assert "a waterjet in" in said
    assert "±0.13 to 0.25 mm" in said


def test_a_wall_that_a_wide_mill_cuts_in_minutes_is_left_to_it() -> None:
    assert notes(part(LARGE, thickness=10.0, material="steel")) == []
