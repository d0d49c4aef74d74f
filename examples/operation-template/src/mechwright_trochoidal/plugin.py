"""What this plugin registers."""

from mechwright.plugins.hookspecs import hookimpl
from mechwright_cam.operations.contract import Operation
from mechwright_trochoidal.operation import Trochoidal


@hookimpl
def mechwright_register() -> list[type[Operation]]:
    """The operation."""
    return [Trochoidal]
