"""What this plugin registers."""

from mechwright import Plugin, hookimpl
from mechwright_slider_crank.family import SliderCrankFamily


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The mechanism family."""
    return [SliderCrankFamily]
