"""The settings of a machine whose pivots are set from phase to phase."""

from typing import Any, TypeVar

from mechwright.contracts.parameters import Parameters

P = TypeVar("P", bound=Parameters)


def other_phases(params: P) -> dict[str, P]:
    """The designs of the phases that a table with ``phase`` and ``phases`` does not show, by their names."""
    shown: Any = params
    return {
        f"phase = {phase}": params.model_copy(update={"phase": phase})
        for phase in range(1, 2 + len(shown.phases))
        if phase != shown.phase
    }
