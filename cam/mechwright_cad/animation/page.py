"""The page itself: one file that needs no network, no library, and no other file. Imports jinja2."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup

from mechwright.contracts.family import Family
from mechwright.contracts.motion import Motion
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import Part
from mechwright_cad.animation.scene import PAGE_SAMPLES, scene

MOTION = "motion.html"
"""The file."""

_SCRIPTS = ("data.js", "plane.js", "space.js", "plots.js", "player.js")
"""In the order in which they stand in the page; they share what they declare."""


def motion_html(name: str, title: str, parts: Sequence[Part], motion: Motion, *, solids: bool) -> str:
    """A page on which the mechanism moves.

    Parameters
    ----------
    name
        Of the design.
    title
        What it is, in a few words.
    parts
        With their instances.
    motion
        Of the bodies that the parts belong to.
    solids
        Whether to draw parts that are no plates, which takes the CAD kernel; else the page names them.

    Returns
    -------
    html
        The same input gives the same text.

    Raises
    ------
    GeometryError
        An instance names a body that the motion does not have, or a part cannot be made.
    """
    data = json.dumps(scene(parts, motion, solids=solids), separators=(",", ":"), allow_nan=False)
    pages = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        keep_trailing_newline=True,
    )
    # What a name holds must not end the element that it stands in.
    safe = Markup(data.replace("<", "\\u003c"))  # noqa: S704 - plain data, with nothing left that opens a tag
    return pages.get_template("page.html").render(name=name, title=title, data=safe, scripts=_SCRIPTS)


def page_of(
    name: str,
    family: Family[Any],
    params: Parameters,
    *,
    solids: bool,
    parts: Sequence[Part] | None = None,
) -> str:
    """The page of a design whose own check has found no error; ``parts`` if they are known already."""
    parts = family.parts(params) if parts is None else parts
    return motion_html(name, family.title, parts, family.solve(params, PAGE_SAMPLES), solids=solids)
