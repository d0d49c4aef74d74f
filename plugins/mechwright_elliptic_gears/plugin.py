"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_elliptic_gears.family import EllipticGears


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family."""
    return [EllipticGears]
