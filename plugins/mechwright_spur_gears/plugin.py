"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_spur_gears.family import SpurGears


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family."""
    return [SpurGears]
