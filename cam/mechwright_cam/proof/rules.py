"""The rules that are built in, in the order of the report. Nothing heavy is imported before one is asked."""

from importlib import import_module
from typing import TYPE_CHECKING, ClassVar

from mechwright_cam.proof.report import Check
from mechwright_cam.proof.rule import Rule

if TYPE_CHECKING:
    from mechwright_cam.proof.scene import Scene

_HOMES = (
    ("machine_rules", "program_end modes tools work_offset"),
    ("tables", "offset_tables"),
    ("offset_rules", "length_offset diameter_offset"),
    ("machine_rules", "positions"),
    ("machine_moves", "machine_moves"),
    ("corridor", "path_tolerance"),
    ("machine_rules", "tool_change stops"),
    ("cutting_state", "spindle coolant arcs feeds speeds"),
    ("cutting_rules", "cutting_speed chips pecks"),
    ("depth_of_cut", "depth_of_cut"),
    ("cutting_state", "dwells"),
    ("motion_rules", "travel flutes underside beside"),
    ("rapid_rules", "rapid_height rapids_in_stock"),
    ("entry_rules", "entries"),
    ("holder", "holder"),
    ("held", "clamp"),
    ("part_rules", "gouge tabs"),
    ("depth", "depth"),
    ("part_rules", "leftover"),
    ("holding", "holding"),
    ("part_rules", "details"),
    ("compensation", "compensation"),
)
"""Module of this folder to the functions in it that judge a scene; a rule is called as its function is."""


class BuiltIn(Rule):
    """A rule of ours."""

    home: ClassVar[str]
    """Module of this folder that has its function."""


def _rule(module: str, function: str) -> type[BuiltIn]:
    """A rule made of a function from scene to check."""

    class Built(BuiltIn):
        name = function.replace("_", "-")
        home = module

        def check(self, scene: "Scene") -> Check:
            judge = getattr(import_module(f"mechwright_cam.proof.{module}"), function)
            found: Check = judge(scene)
            return found

    return Built


BUILT_IN = tuple(_rule(module, function) for module, names in _HOMES for function in names.split())
"""The classes; the host registers them, and a third party's rules come after them."""
