"""The proof: a program text is read back, simulated against the part, and judged before it is written.

Nothing here uses what planned or posted the program: an error there must not hide itself here. That is why
small helpers such as the closing of a polygon exist in both places. Each name is imported when it is first
asked for, since the contract of a rule is light and a proof is not.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mechwright_cam.proof.carried import cut_away
    from mechwright_cam.proof.judge import prove
    from mechwright_cam.proof.report import Check, OperationTime, Proof, Spot
    from mechwright_cam.proof.rules import Rule
    from mechwright_cam.proof.scene import Scene

__all__ = ["Check", "OperationTime", "Proof", "Rule", "Scene", "Spot", "cut_away", "prove"]

_HOME = {"cut_away": "carried", "prove": "judge", "Rule": "rules", "Scene": "scene"}
"""Name to module of this folder; the others are those of the report."""


def __getattr__(name: str) -> Any:
    """Import a public name; raises AttributeError for any other."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOME.get(name, 'report')}"), name)
