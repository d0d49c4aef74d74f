"""The design table with pins, bosses and links that have room, where it leaves them out."""

from collections.abc import Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from mechwright import MechwrightError, Stage
from mechwright.contracts.design_table import column
from mechwright_spherical.defaults.preferred_sizes import NAMES, USUAL, candidates, left_out
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.hardware import HardwareTable

if TYPE_CHECKING:
    from mechwright_spherical.table import SphericalTable


class CompleteParams(SphericalParams):
    """A spherical four-bar, or an adjustable spherical five-bar, and its links.

    Examples
    --------
    >>> CompleteParams(radius=40).hardware.pin_diameter
    4.0
    """

    def fitted(self) -> Mapping[str, Any]:
        """Sizes that have room on a small sphere; designs with columns have the default ones."""
        out = left_out(self.hardware)
        if not out:
            return {}
        hardware = _with(self.hardware, {name: getattr(USUAL, name) for name in out})
        if _has_columns(self):
            return {"hardware": hardware}
        from mechwright_spherical.rules.rule_table import JOINED
        from mechwright_spherical.table import SphericalTable

        m = SphericalTable.of(self.model_copy(update={"hardware": hardware}))
        with suppress(MechwrightError), np.errstate(all="ignore"):
            if JOINED.allowed(m, Stage.PARTS, lambda *_: None)[1].size:
                hardware = complete(m)
        return {"hardware": hardware}


def complete(m: "SphericalTable") -> HardwareTable:
    """The table ``hardware`` of assembled linkages with sizes that cure errors, where others do not stand.

    Sizes that a design gives stay; a linkage that no sizes cure has the default ones.
    """
    from mechwright_spherical.rules.rule_table import ALL_ROOM, CURABLE, LASTING

    own = m.given.hardware
    out = left_out(own)
    if not out:
        return own
    first, *others = candidates({name: getattr(own, name) for name in NAMES if name not in out}, own.fit)
    trial, todo = LASTING.allowed(m.sized(own), Stage.PARTS, lambda *_: None)
    if todo.size:
        todo = np.delete(todo, CURABLE.allowed(trial, Stage.PARTS, lambda *_: None)[1])
    chosen = {name: column(getattr(first, name), m.size).copy() for name in out}
    for one in others:
        if not todo.size:
            break
        trial = m.sized(_with(own, {name: getattr(one, name) for name in out})).rows(todo)
        cured = todo[ALL_ROOM.allowed(trial, Stage.PARTS, lambda *_: None)[1]]
        for name, values in chosen.items():
            values[cured] = column(getattr(one, name), m.size)[cured]
        todo = np.setdiff1d(todo, cured)
    return _with(own, {name: one.item() if m.single else one for name, one in chosen.items()})


def _with(own: HardwareTable, sizes: Mapping[str, Any]) -> HardwareTable:
    """A table with other sizes, which still count as left out."""
    return HardwareTable.model_construct(_fields_set=set(own.model_fields_set), **{**dict(own), **sizes})


def _has_columns(table: Any) -> bool:
    """Whether a number of a table, or of one in it, is a column."""
    return any(
        isinstance(one, np.ndarray) or (hasattr(one, "model_fields_set") and _has_columns(one))
        for one in table.__dict__.values()
    )
