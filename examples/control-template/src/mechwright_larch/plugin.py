"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_larch.control import Larch


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The control."""
    return [Larch]
