"""What this plugin registers."""

from typing import Any

from mechwright.family import Family
from mechwright.hookspecs import hookimpl
from mechwright_four_bar.family import FourBars


@hookimpl
def mechwright_register_families() -> list[type[Family[Any]]]:
    """The mechanism families."""
    return [FourBars]
