"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_dwell_press.family import DwellPresses, DwellPressPoles


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The family, and the page of its acceleration poles."""
    return [DwellPresses, DwellPressPoles]
