"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_saw_list.page import SawList


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The page."""
    return [SawList]
