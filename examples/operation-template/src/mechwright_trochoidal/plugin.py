"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_trochoidal.operation import Trochoidal


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The operation."""
    return [Trochoidal]
