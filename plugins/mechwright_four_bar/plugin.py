"""What this plugin registers."""

from typing import Any

from mechwright.contracts.family import Family
from mechwright.plugins.hookspecs import hookimpl
from mechwright_four_bar.family import FourBars


@hookimpl
def mechwright_register_families() -> list[type[Family[Any]]]:
    """The mechanism families."""
    return [FourBars]
