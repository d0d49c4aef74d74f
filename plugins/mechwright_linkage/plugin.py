"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_linkage.family import Linkages
from mechwright_linkage.poles_page import LinkagePoles


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The family of planar linkages, and the pages of its poles."""
    return [Linkages, LinkagePoles]
