"""The report on a program as an HTML page. Imports jinja2."""

from pathlib import Path

import numpy as np
import shapely
from markupsafe import Markup

from mechwright.output import svg
from mechwright_cam.pages.setup_sheet.sheet import environment
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.report import Proof
from mechwright_cam.proof.scene import Scene

DRAWN = 20_000
"""So many moves are drawn at most: a page with more is slow to open."""
CHORD = 0.02
"""Chord error of drawn arcs, mm."""


def report_html(scene: Scene, proof: Proof, program: str) -> str:
    """What the proof says of a program: a page that needs no other file and no network, and prints on A4."""
    shown = {
        "proof": proof,
        "program": program,
        "job": scene.job,
        "control": scene.control.title,
        "tools": sorted(scene.tools.values(), key=lambda tool: tool.number),
        "lines": scene.run.lines,
        "plan": Markup(_plan(scene, proof)),  # noqa: S704 - our own markup; all text in it is escaped
    }
    return environment(Path(__file__).parent).get_template("report.html").render(shown)


def _plan(scene: Scene, proof: Proof) -> str:
    """The part in its stock, the paths of the cutters in the work, and where checks have failed."""
    job, paths = scene.job, scene.paths
    x0, y0, x1, y1 = job.stock
    size = max(x1 - x0, y1 - y0)
    thin = size / 600
    parts = [svg.element("rect", x=x0, y=-y1, width=x1 - x0, height=y1 - y0, fill="#eef1f4")]
    for polygon in shapely.get_parts(job.target).tolist():
        rings = [polygon.exterior, *polygon.interiors]
        data = "".join(svg.path(list(ring.coords)[:-1], close=True) for ring in rings)
        parts.append(svg.element("path", d=data, fill="#cfe0d3", fill_rule="evenodd", stroke="none"))
    low = paths.cuts[paths.low[paths.cuts] < -NEAR][:DRAWN]
    points, owner = paths.points(paths.whole(low), CHORD)
    edges = np.flatnonzero(np.diff(owner)) + 1
    data = "".join(svg.path(line.tolist()) for line in np.split(points, edges) if len(line) > 1)
    look = {"fill": "none", "stroke": "#2b6cb0", "stroke_width": thin, "stroke_linejoin": "round"}
    parts.append(svg.element("path", d=data, **look))
    for tab in job.tabs:
        shape = svg.path(list(tab.shape.exterior.coords)[:-1], close=True)
        parts.append(svg.element("path", d=shape, fill="#e6a100", fill_opacity=0.75))
    for number, check in enumerate(proof.failures, start=1):
        if check.at is not None and np.isfinite(check.at[:2]).all():
            x, y = check.at[:2]
            mark = {"fill": "none", "stroke": "#b00020", "stroke_width": 3 * thin}
            parts.append(svg.element("circle", cx=x, cy=-y, r=size / 50, **mark))
            parts.append(svg.text(x + size / 45, y + size / 45, str(number), size / 28, fill="#b00020"))
    edge = size / 20
    box = (x0 - edge, -y1 - edge, x1 - x0 + 2 * edge, y1 - y0 + 2 * edge)
    return svg.picture("".join(parts), box, f"plan view of {job.part.name} with the paths of the cutters")
