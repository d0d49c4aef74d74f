"""The hooks. All of them register classes; behaviour lives in what they return."""

from collections.abc import Sequence
from typing import Any

import pluggy

from mechwright.contracts.exporter import Exporter
from mechwright.contracts.family import Family
from mechwright_cam.controls.contract import Control

PROJECT = "mechwright"
hookspec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)
"""Mark a hook implementation with this."""


@hookspec
def mechwright_register_families() -> Sequence[type[Family[Any]]]:  # type: ignore[empty-body]
    """Give the mechanism families of this plugin."""


@hookspec
def mechwright_register_posts() -> Sequence[type[Control]]:  # type: ignore[empty-body]
    """Give the controls of this plugin, one class for each."""


@hookspec
def mechwright_register_exporters() -> Sequence[type[Exporter]]:  # type: ignore[empty-body]
    """Give the exporters of this plugin, one class per file format."""
