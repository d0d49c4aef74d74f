"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_slider_crank.family import SliderCrankFamily
from mechwright_slider_crank.pages.construction import ConstructionPage
from mechwright_slider_crank.pages.poles import SliderCrankPoles


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family, and the pages of its poles and of its construction."""
    return [SliderCrankFamily, SliderCrankPoles, ConstructionPage]
