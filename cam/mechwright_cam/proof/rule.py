"""The contract of a rule: one question of the proof, ours or anybody's."""

from abc import abstractmethod
from dataclasses import replace
from typing import TYPE_CHECKING

from mechwright.contracts.plugin import Plugin
from mechwright.errors import PluginError
from mechwright_cam.proof.report import Check

if TYPE_CHECKING:
    from mechwright_cam.proof.scene import Scene


class Rule(Plugin):
    """Judges a program that has been read back; a program is written if no rule objects.

    Its name is that of its check in ``proof.json`` and in the messages of a refusal. Rules are asked side by
    side: none may depend on another, and what several need is on the :class:`Scene`, which keeps it.
    """

    kind = "rule"
    plural = "rules"

    @abstractmethod
    def check(self, scene: "Scene") -> Check:
        """The answer: one line that says what was found, or what is wrong, where, the limit, what to do."""


def ask(rule: Rule, scene: "Scene") -> Check:
    """The check of a rule, under the rule's name; raises PluginError if the rule fails or gives no check."""
    try:
        found = rule.check(scene)
    except (Exception, SystemExit) as error:  # a rule that cannot tell must not end as a pass
        reason = " ".join(f"{type(error).__name__}: {error}".split())
        raise PluginError(
            f"rule {rule.name} cannot judge the program of {scene.job.part.name}: {reason}"
        ) from error
    if not isinstance(found, Check) or not isinstance(found.passed, bool):
        raise PluginError(
            f"rule {rule.name} gives {found!r}; a rule gives a Check, which has passed or has not"
        )
    return replace(found, name=rule.name)
