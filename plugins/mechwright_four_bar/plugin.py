"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_four_bar.family import FourBars


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family."""
    return [FourBars]
