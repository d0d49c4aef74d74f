"""The page itself: one file that needs no network, no library, and no other file. Imports jinja2."""

import json
from collections.abc import Sequence
from pathlib import Path

from markupsafe import Markup

from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright.output.templates import templates
from mechwright_cad.animation.scene import scene

MOTION = "motion.html"
"""The file."""


def motion_html(name: str, title: str, parts: Sequence[Part], motion: Motion, *, solids: bool) -> str:
    """The page of a design by its name, and in a few words; the same input gives the same text.

    The rest is as :func:`~mechwright_cad.animation.scene.scene` takes it.
    """
    data = json.dumps(scene(parts, motion, solids=solids), separators=(",", ":"), allow_nan=False)
    # What a name holds must not end the element that it stands in.
    safe = Markup(data.replace("<", "\\u003c"))  # noqa: S704 - plain data, with nothing left that opens a tag
    return (
        templates(Path(__file__).parent).get_template("page.html").render(name=name, title=title, data=safe)
    )
