"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_noncircular_gears.family import NoncircularGears


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family."""
    return [NoncircularGears]
