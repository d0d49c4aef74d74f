"""The one hook. It registers classes; behaviour lives in them."""

from collections.abc import Sequence

import pluggy

from mechwright.contracts.plugin import Plugin

PROJECT = "mechwright"
hookspec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)
"""Mark a hook implementation with this."""


@hookspec
def mechwright_register() -> Sequence[type[Plugin]]:  # type: ignore[empty-body]
    """Give the classes of this plugin: families, exporters, controls ..., in any order."""
