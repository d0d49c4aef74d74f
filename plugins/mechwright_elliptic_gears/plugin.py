"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.figure_eight.page import FigureEightPage


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family, and the page of its trains."""
    return [EllipticGears, FigureEightPage]
