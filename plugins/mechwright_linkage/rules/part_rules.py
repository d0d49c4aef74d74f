"""Rules of the parts: gears, bores, layers."""

from collections.abc import Iterator

from mechwright import Finding, GeometryError, Stage
from mechwright.contracts.design_rule import DesignRule, Note, Procedure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.linkage.bushings import LEAST_WALL
from mechwright_linkage.kinematics.linkage_table import LinkageTable
from mechwright_linkage.parts.design import layout_of, layout_or_none


def _layers(table: LinkageTable) -> Iterator[Finding]:
    try:
        layout_of(table.given)
    except GeometryError as error:
        other = table.given.model_copy(update={"frame": "two"})
        two = table.given.frame == "one" and layout_or_none(other) is not None
        yield Finding.error(
            "linkage.layers",
            "frame" if two else table.given.table_name,
            str(error),
            remedy='set frame = "two"'
            if two
            else "make pin_diameter, bushing_wall, rim or clearance smaller",
            stage=Stage.PARTS,
            proposed=({"parameters.frame": "two"},) if two else (),
        )


BUSHINGS = DesignRule[LinkageTable](
    "linkage.bushing-wall",
    "bushing_wall",
    "the running fit of {m.given.running_fit:g} mm leaves {value:.3g} mm of the bushing's wall",
    value=lambda m: m.given.bushing_wall - m.given.running_fit / 2,
    limit=LEAST_WALL,
    unit="mm",
    remedy=lambda f: f"make bushing_wall at least {_least_wall(f.m):g}, or 0 for no bushings",
    when=lambda m: m.given.bushing_wall > 0,
    proposed=lambda f: ({"parameters.bushing_wall": _least_wall(f.m)}, {"parameters.bushing_wall": 0.0}),
)


def _least_wall(m: LinkageTable) -> float:
    return round(LEAST_WALL + m.given.running_fit / 2, 6)


def _stack_message(m: LinkageTable) -> str:
    layout = layout_of(m.given)
    layers = layout.stack
    order = sorted(layers.layer.items(), key=lambda item: (item[1], item[0]))
    posts = f"; {len(layout.posts)} posts between two ground plates" if layout.posts else ""
    return (
        f"{len(layers.layers)} layers, {_height(m):.4g} mm high: "
        + ", ".join(f"{name} in {number}" for name, number in order)
        + posts
    )


def _height(m: LinkageTable) -> float:
    return max(high for _, high in layout_of(m.given).stack.spans.values())


PARTS = in_turn(BUSHINGS, Procedure[LinkageTable](("linkage.layers",), _layers, stage=Stage.PARTS))
"""What plates and pins need, in order."""

PART_NOTES = all_of(Note[LinkageTable]("linkage.stack", _stack_message, _height, "mm"))
