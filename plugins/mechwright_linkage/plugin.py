"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_linkage.family import Linkages


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The family of planar linkages."""
    return [Linkages]
