"""Rules of the parts: bushings and layers, with codes that begin with the word of a family's table."""

from collections.abc import Iterator
from typing import Any

from mechwright.contracts.design_rule import DesignRule
from mechwright.contracts.finding import Finding, Stage
from mechwright.contracts.procedure import Note, Procedure
from mechwright.contracts.rule_list import Rules, all_of, in_turn
from mechwright.errors import GeometryError
from mechwright.mechanics.linkage.bushings import LEAST_WALL
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable


def _layers(table: AnyPlanarTable) -> Iterator[Finding]:
    try:
        table.layout  # noqa: B018 - it raises
    except GeometryError as error:
        other = table.given.model_copy(update={"frame": "two"})
        two = table.given.frame == "one" and table.of(other).layout_or_none is not None
        yield Finding.error(
            f"{table.code}.layers",
            "frame" if two else table.key,
            str(error),
            remedy='set frame = "two"'
            if two
            else "make pin_diameter, bushing_wall, rim or clearance smaller",
            stage=Stage.PARTS,
            proposed=({"parameters.frame": "two"},) if two else (),
        )


def least_wall(m: AnyPlanarTable) -> float:
    """The least wall that the running fit leaves enough of, mm."""
    return round(float(LEAST_WALL + m.given.running_fit / 2), 6)


def _stack_message(m: AnyPlanarTable) -> str:
    layout = m.layout
    layers = layout.stack
    order = sorted(layers.layer.items(), key=lambda item: (item[1], item[0]))
    posts = f"; {len(layout.posts)} posts between two ground plates" if layout.posts else ""
    return (
        f"{len(layers.layers)} layers, {_height(m):.4g} mm high: "
        + ", ".join(f"{name} in {number}" for name, number in order)
        + posts
    )


def _height(m: AnyPlanarTable) -> float:
    return max(high for _, high in m.layout.stack.spans.values())


def bushing_rule(code: str) -> DesignRule[Any]:
    """Walls of bushings that can be turned."""
    return DesignRule[AnyPlanarTable](
        f"{code}.bushing-wall",
        "bushing_wall",
        "the running fit of {m.given.running_fit:g} mm leaves {value:.3g} mm of the bushing's wall",
        value=lambda m: m.given.bushing_wall - m.given.running_fit / 2,
        limit=LEAST_WALL,
        unit="mm",
        remedy=lambda f: f"make bushing_wall at least {least_wall(f.m):g}, or 0 for no bushings",
        when=lambda m: m.given.bushing_wall > 0,
        proposed=lambda f: (
            {"parameters.bushing_wall": least_wall(f.m)},
            {"parameters.bushing_wall": 0.0},
        ),
    )


def part_rules(code: str) -> Rules[Any]:
    """What plates and pins need, in order."""
    layers = Procedure[AnyPlanarTable]((f"{code}.layers",), _layers, stage=Stage.PARTS)
    return in_turn(bushing_rule(code), layers)


def part_notes(code: str) -> Rules[Any]:
    """The layers."""
    return all_of(Note[AnyPlanarTable](f"{code}.stack", _stack_message, _height, "mm"))
