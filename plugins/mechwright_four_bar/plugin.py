"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.poles_page import FourBarPoles


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family, and the page of its poles."""
    return [FourBars, FourBarPoles]
