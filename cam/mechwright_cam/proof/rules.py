"""The contract of a rule, one question of the proof, ours or anybody's; and the rules that are built in.

Nothing heavy is imported before one is asked.
"""

from abc import abstractmethod
from dataclasses import replace
from importlib import import_module
from typing import TYPE_CHECKING

from mechwright.contracts.plugin import Plugin, who_of
from mechwright.errors import MechwrightError, PluginFaultError, ProgramError
from mechwright_cam.proof.report import Check

if TYPE_CHECKING:
    from mechwright_cam.proof.scene import OneLineCheck, Scene


class Rule(Plugin):
    """Judges a program that has been read back; a program is written if no rule objects.

    Its name is that of its check in ``proof.json`` and in the messages of a refusal. Rules are asked side by
    side: none may depend on another, and what several need is on the :class:`Scene`, which keeps it.
    """

    kind = "rule"
    plural = "rules"
    limited = True

    @abstractmethod
    def check(self, scene: "Scene") -> "OneLineCheck":
        """The answer: one line that says what was found, or what is wrong, where, the limit, what to do."""


def ask(rule: Rule, scene: "Scene") -> Check:
    """The check of a rule, under the rule's name; raises PluginFaultError if it cannot tell: no pass.

    ProgramError is raised if the program is more than it has time for.
    """
    try:
        return replace(rule.check(scene), name=rule.name)
    except ProgramError:  # more than a proof has time for
        raise
    except MechwrightError as error:
        if isinstance(error, PluginFaultError) and who_of(rule) not in str(error):
            raise  # of a plugin that the rule has asked
        raise PluginFaultError(
            f"rule {rule.name} cannot judge the program of {scene.job.part.name}: {error}"
        ) from error


_HOMES = (
    ("machine_rules", "program_end modes tools work_offset"),
    ("offset_rules", "offset_tables length_offset diameter_offset"),
    ("machine_moves", "positions machine_moves"),
    ("cutting_state", "path_tolerance"),
    ("machine_rules", "tool_change stops"),
    ("cutting_state", "spindle coolant arcs feeds speeds"),
    ("cutting_rules", "cutting_speed chips pecks"),
    ("edge_rules", "edges plunges climb"),
    ("tap_rules", "tapping"),
    ("depth_of_cut", "depth_of_cut"),
    ("power_rules", "power"),
    ("cutting_state", "dwells"),
    ("motion_rules", "travel flutes underside beside"),
    ("neighbours", "neighbours"),
    ("entry_rules", "rapid_height rapids_in_stock entries"),
    ("tool_collisions", "holder clamp"),
    ("part_rules", "gouge"),
    ("tab_rules", "tabs"),
    ("part_rules", "depth leftover"),
    ("holding", "holding"),
    ("part_rules", "details"),
    ("compensation", "compensation"),
)
"""Module of this folder to the functions in it that judge a scene; a rule is called as its function is."""


def _rule(module: str, function: str) -> type[Rule]:
    """A rule made of a function from scene to check."""

    class Built(Rule):
        name = function.replace("_", "-")
        home = module

        def check(self, scene: "Scene") -> Check:
            judge = getattr(import_module(f"mechwright_cam.proof.{module}"), function)
            found: Check = judge(scene)
            return found

        def __reduce__(self) -> tuple[object, ...]:
            """Another process has the same rule under the same name."""
            return _built_in, (self.name,)

    return Built


def _built_in(name: str) -> Rule:
    return next(rule for rule in BUILT_IN if rule.name == name)()


BUILT_IN = tuple(_rule(module, function) for module, names in _HOMES for function in names.split())
"""The classes; the host registers them, and a third party's rules come after them."""
