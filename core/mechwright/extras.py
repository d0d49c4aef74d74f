"""Libraries that are not installed with the rest: each is imported when something needs it."""

from importlib import import_module
from typing import Any

from mechwright.errors import PluginError

EXTRAS = {"distributed": "scale", "pandas": "data", "plotly": "data", "pyarrow": "scale"}
"""Library to the extra of this distribution that brings it."""


def optional(module: str) -> Any:
    """A module of a library that is optional.

    Raises
    ------
    PluginError
        It is not installed; the line names the extra that brings it.
    """
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        library = module.partition(".")[0]
        if (error.name or "").partition(".")[0] != library:
            raise  # it is there, and broken
        raise PluginError(
            f"{library} is not installed, which this needs: pip install 'mechwright[{EXTRAS[library]}]'"
        ) from None
