"""What a design could be whose given sizes do not go together: some of them are taken back."""

from typing import Any

from mechwright import kept
from mechwright.contracts.finding import errors
from mechwright_geneva.params import GenevaParams
from mechwright_geneva.sizes import sized
from mechwright_geneva.unmended import unmended

GROUPS = (
    ("crank_half_angle", "offset_angle"),
    ("roller_radius", "pin_diameter"),
    ("entry_radius", "centre_distance"),
    ("bore", "driver_bore", "fixing", "hub_diameter", "keyway_width", "driver_keyway_width", "least_wall"),
    ("lock_radius", "lock_clearance", "groove_clearance", "counterbore_diameter", "rollers"),
)
"""Keys that are taken back together; a later group along with all before it. So what says most about the
mechanism, wheel and bores, stands longest."""


_TENTH, _CLOSE = 0.1, 0.01
"""How near to the first value that is not sound the one is that is named: a tenth, or a hundredth of it."""


@kept
def released(params: GenevaParams) -> tuple[str, str]:
    """The change that makes a design sound, in words, and the first key of it; tried. Empty if none does."""
    taken: set[str] = set()
    for group in GROUPS:
        given = {key for key in group if key in params.model_fields_set}
        taken |= given
        if not given:
            continue
        table = {k: v for k, v in params.model_dump(exclude_unset=True).items() if k not in taken}
        if not _sound(table):
            continue
        sizes = sized(GenevaParams.model_validate(table))
        values = {key: getattr(sizes, key) for key in GenevaParams.model_fields if key in taken}
        if len(values) == 1:
            values = {key: _nearest(table, key, getattr(params, key), value) for key, value in values.items()}
        said = ", ".join(f"{key} = {value:.6g}" for key, value in values.items() if value is not None)
        gone = ", ".join(key for key, value in values.items() if value is None)
        return ", and ".join([f"use {said}"] * bool(said) + [f"leave out {gone}"] * bool(gone)), next(
            iter(values)
        )
    return "", ""


def _sound(table: dict[str, Any]) -> bool:
    return not errors(unmended(GenevaParams.model_validate(table)))


def _nearest(table: dict[str, Any], key: str, given: float, value: float | None) -> float | None:
    """The value nearest to the given one, in tenths, from which on up to a sound one the design is sound."""
    if value is None or isinstance(given, int):
        return value
    bad, good = given, value
    while abs(good - bad) > max(_TENTH, _CLOSE * abs(good)):
        middle = round((good + bad) / 2, 1)
        if middle in (good, bad):
            break
        if _sound({**table, key: middle}):
            good = middle
        else:
            bad = middle
    return good
