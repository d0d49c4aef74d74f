"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_five_bar.family import FiveBars


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family."""
    return [FiveBars]
