"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_spherical.family import Spherical


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family."""
    return [Spherical]
