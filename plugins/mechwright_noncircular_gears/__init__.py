"""The family of gears whose pitch curves follow from any law."""

from collections.abc import Mapping
from typing import Any

from mechwright_noncircular_gears.params import FOLLOWING, NoncircularParams


def _following(params: NoncircularParams) -> Mapping[str, Any]:
    from mechwright_noncircular_gears.usual import following

    return following(params)


FOLLOWING.append(_following)
