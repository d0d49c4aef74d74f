"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_geneva.family import Geneva


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family."""
    return [Geneva]
