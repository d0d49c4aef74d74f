"""The page itself: one file that needs no network, no library, and no other file. Imports jinja2."""

from collections.abc import Sequence
from pathlib import Path

from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright.output.templates import templates
from mechwright.pipeline.result_store import stored
from mechwright_cad.animation.scene import scene
from mechwright_cad.viewer import VIEWER
from mechwright_cad.viewer.script import script_data

MOTION = "motion.html"
"""The file."""


@stored
def motion_html(name: str, title: str, parts: Sequence[Part], motion: Motion, *, solids: bool) -> str:
    """The page of a design by its name, and in a few words; the same input gives the same text.

    The rest is as :func:`~mechwright_cad.animation.scene.scene` takes it.
    """
    data = script_data(scene(parts, motion, solids=solids, space=True))
    page = templates(Path(__file__).parent, VIEWER).get_template("page.html")
    return page.render(name=name, title=title, data=data)
