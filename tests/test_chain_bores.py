"""A hub and the shaft in it: whichever of a chain's stages leaves its size out follows the one that gives it."""

from pathlib import Path

import pytest

from mechwright import GroundPlate, Part, host
from mechwright.designs.design import Design, load
from mechwright.mechanics.chain import Chain
from mechwright.mechanics.chain.assembly import assembly_of
from mechwright.mechanics.chain.params import ChainParams
from mechwright.mechanics.chain.shafts import seat_of
from mechwright.remedies import tried


def _chain(folder: Path, before: str, after: str, first: str = "", second: str = "") -> Design:
    path = folder / "chain.toml"
    path.write_text(
        f'[[stage]]\nfamily = "{before}"\n[stage.parameters]\n{first}\n'
        f'[[stage]]\nfamily = "{after}"\n[stage.parameters]\n{second}\n',
        encoding="utf-8",
    )
    return load(path, host())


BORE, PIN, SHAFT = "stage.1.parameters.bore", "stage.2.parameters.pin_diameter", "stage.2.parameters.shaft"


@pytest.mark.parametrize(
    ("stages", "first", "second", "chosen"),
    [
        (("noncircular-gears", "slider-crank"), "", "", {BORE: 6}),
        (("noncircular-gears", "five-bar"), "", "", {BORE: 8}),
        (("noncircular-gears", "slider-crank"), "bore = 8", "", {SHAFT: 8}),
        (("elliptic-gears", "four-bar"), "bore = 8", "", {PIN: 8}),
        (("elliptic-gears", "slider-crank"), "", "shaft = 8", {BORE: 8}),
    ],
)
def test_what_is_left_out_follows_what_is_given(
    tmp_path: Path, stages: tuple[str, str], first: str, second: str, chosen: dict[str, float]
) -> None:
    design = _chain(tmp_path, *stages, first, second)
    assert {key: size for key, size in design.chosen.items() if key in {BORE, PIN, SHAFT}} == chosen
    assert "chain.bore" not in [one.code for one in design.check()]


def test_two_sizes_that_are_given_are_told_with_both_ways_out(tmp_path: Path) -> None:
    """Neither is changed unasked; what is told has been tried."""
    design = _chain(tmp_path, "elliptic-gears", "four-bar", "bore = 8", "pin_diameter = 6")
    (told,) = (one for one in tried(design, design.check()) if one.code == "chain.bore")
    assert f"make both alike: {BORE} = 6 or {PIN} = 8" in str(
        next(one for one in design.check() if one.code == "chain.bore").remedy
    )
    assert told.fix in ({BORE: 6}, {PIN: 8})
    assert "chain.bore" not in [one.code for one in design.changed(told.fix).check()]


@pytest.mark.parametrize("after", ["slider-crank", "four-bar"])
def test_a_shaft_below_a_ground_plate_goes_through_the_hub_that_turns_it(tmp_path: Path, after: str) -> None:
    """A Geneva wheel has its driver and locking disc over its hub: a usual end of a shaft is too short."""
    design = _chain(tmp_path, "geneva", after, 'law = "straight"')
    assert isinstance(design.family, Chain)
    assert isinstance(design.params, ChainParams)
    whole = assembly_of(design.params, design.family.families)
    plate, level = whole.planes[1].mounting, whole.places[1].level
    hub = seat_of(whole.places[0], whole.planes[0], "wheel")
    assert isinstance(plate, GroundPlate)
    assert hub is not None
    assert plate.end + level == pytest.approx(hub.low, abs=1e-6)
    height = float(design.family.solve(design.params, 2).poses[f"2-{plate.shaft}"].position[0, 2])
    lowest = min(
        (part for part in design.family.parts(design.params) if part.turned and _on(part, plate.shaft)),
        key=lambda part: part.instances[0].z,
    )
    assert lowest.instances[0].z + height == pytest.approx(hub.low, abs=1e-6)
    assert lowest.turned is not None
    assert lowest.solid.BoundingBox().zlen == pytest.approx(lowest.turned.length, abs=1e-6)


def _on(part: Part, shaft: str) -> bool:
    return [one.body for one in part.instances] == [f"2-{shaft}"]
