"""The design table with pins, bosses and links that have room, where it leaves them out."""

from collections.abc import Mapping
from contextlib import suppress
from typing import Any

from mechwright import MechwrightError, Severity
from mechwright_spherical.defaults.preferred_sizes import CURED, NAMES, Sizes, candidates, left_out
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.hardware import HardwareTable


class SizedParams(SphericalParams):
    """A spherical four-bar, or an adjustable spherical five-bar, and its links.

    Examples
    --------
    >>> SizedParams(radius=40).hardware.pin_diameter
    4.0
    """

    def fitted(self) -> Mapping[str, Any]:
        """Sizes that have room on a small sphere."""
        hardware = _fitted(self)
        return {} if hardware is None else {"hardware": hardware}


def _fitted(params: SphericalParams) -> HardwareTable | None:
    """The table ``hardware`` with sizes that cure what is found; None for the table as it is."""
    own = params.hardware
    out = left_out(own)
    if not out:
        return None
    given = {name: getattr(own, name) for name in NAMES if name not in out}
    tried: set[Sizes] = set()
    for one in candidates(given, own.fit):
        sizes = Sizes(*(float(getattr(one, name)) for name in NAMES))
        if sizes in tried:
            continue
        table = _with(own, {name: getattr(sizes, name) for name in out})
        asked = params.model_copy(update={"hardware": table})
        if not tried:
            wrong = _wrong(asked)
            if not (wrong and wrong <= CURED):
                return None
        elif _fits(asked):
            return table
        tried.add(sizes)
    return None


def _with(own: HardwareTable, sizes: Mapping[str, float]) -> HardwareTable:
    """A table with other sizes, which still count as left out."""
    return HardwareTable.model_construct(_fields_set=set(own.model_fields_set), **{**dict(own), **sizes})


def _wrong(params: SphericalParams) -> frozenset[str]:
    """The errors of the links; of a linkage that cannot be joined there is nothing to say."""
    from mechwright_spherical.rules.checks import joined
    from mechwright_spherical.rules.hardware_checks import hardware_found

    with suppress(MechwrightError):
        if joined(params):
            return frozenset(one.code for one in hardware_found(params) if one.severity is Severity.ERROR)
    return frozenset({"spherical.assembly"})


def _fits(params: SphericalParams) -> bool:
    """Whether nothing stands in the way of the links of a linkage that can be joined."""
    from mechwright_spherical.rules.hardware_checks import hardware_seeking

    return all(one.severity is not Severity.ERROR for one in hardware_seeking(params))
