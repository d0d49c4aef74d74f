"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_plate.family import Plate


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The family of what stands still."""
    return [Plate]
