"""What this plugin registers."""

from mechwright import hookimpl
from mechwright_cam.controls.contract import Control
from mechwright_larch.control import Larch


@hookimpl
def mechwright_register_posts() -> list[type[Control]]:
    """The controls."""
    return [Larch]
