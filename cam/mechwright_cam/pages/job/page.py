"""The page itself: one file that needs no network and no other file. Imports jinja2."""

from pathlib import Path
from typing import Any

from markupsafe import Markup

from mechwright.output.templates import templates
from mechwright_cad.viewer import ANIMATION, VIEWER
from mechwright_cad.viewer.script import script_data
from mechwright_cam.pages.job.bodies import fixtures_of, ghost_of, tools_of
from mechwright_cam.pages.job.marks import KINDS, marks_of
from mechwright_cam.pages.job.relief import relief_of
from mechwright_cam.pages.job.steps import NO_STEPS, steps_of, texts
from mechwright_cam.pages.setup_sheet.raster import simulated_view
from mechwright_cam.proof.report import Proof
from mechwright_cam.proof.scene import Scene

MOST_STEPS = 300_000
"""Steps of a program that a page plays: it has 17 MB then, and a browser takes seconds to open it."""


def job_data(scene: Scene, proof: Proof) -> dict[str, Any]:
    """What the page shows of a program and its proof, as plain data."""
    job, steps = scene.job, len(scene.run)
    large = steps > MOST_STEPS
    return {
        "large": f"{steps:,} steps, more than the {MOST_STEPS:,} that a page plays: split it"
        if large
        else "",
        "steps": NO_STEPS if large else steps_of(scene),
        "relief": relief_of(scene),
        "tools": tools_of(scene),
        "fixtures": fixtures_of(scene),
        "ghost": ghost_of(scene),
        "marks": [] if large else marks_of(scene, proof),
        "kinds": KINDS,
        "clearance": job.settings.clearance,
        "text": [] if large else [line for text in texts(scene) for line in text.splitlines()],
    }


def job_html(scene: Scene, proof: Proof, program: str, sheet: str = "") -> str:
    """The program played on its stock; ``sheet`` is the file of its setup sheet, empty for none."""
    page = templates(Path(__file__).parent, VIEWER, ANIMATION).get_template("job.html")
    return page.render(
        program=program,
        part=scene.job.part.name,
        control=scene.control.title,
        proof=proof,
        sheet=sheet,
        still=Markup(simulated_view(scene.simulation, scene.job)),  # noqa: S704 - our own markup, without names
        data=script_data(job_data(scene, proof)),
    )
