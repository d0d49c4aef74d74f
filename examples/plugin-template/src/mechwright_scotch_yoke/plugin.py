"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_scotch_yoke.family import ScotchYoke


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family."""
    return [ScotchYoke]
