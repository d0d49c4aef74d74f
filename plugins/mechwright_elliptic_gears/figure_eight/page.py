"""``figure-eight.html``: one file that needs no network, no library, and no other file."""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mechwright import Build, Page
from mechwright_elliptic_gears.parameters import REPORTED_PHASES, EllipticGearParams

NAME = "figure-eight.html"
"""The file."""

REPORTED_ECCENTRICITIES = (0.2, 0.4, 0.6, 0.8)
"""Of the published trains."""


class FigureEightPage(Page):
    """``figure-eight.html``: phase and eccentricity on sliders, the speed of Q, and both published tables."""

    name = "figure-eight"
    commands = frozenset({"solve", "build"})
    doing = "motion"

    def files(self, build: Build) -> Mapping[str, str]:
        """The page of a train; none for any other design."""
        params = build.design.params
        if not isinstance(params, EllipticGearParams) or params.stages == 1:
            return {}
        return {NAME: html(build.design.name, params)}


def data_of(params: EllipticGearParams) -> dict[str, Any]:
    """What the script computes from: mm, rad/s, mm/s, phases in degrees."""
    from mechwright_elliptic_gears.kinematics.figures import band_of
    from mechwright_elliptic_gears.parts.gear import ellipse_of

    phases = params.set_phases if params.adjustable else {*REPORTED_PHASES, params.phase_degrees}
    return {
        "a": ellipse_of(params).semi_major,
        "e": params.eccentricity,
        "gamma": params.phase_degrees,
        "omega": params.speed * math.tau / 60,
        "band": band_of(params),
        "along": params.point_along,
        "across": params.point_across,
        "phases": sorted(phases),
        "settable": params.adjustable,
        "eccentricities": sorted({*REPORTED_ECCENTRICITIES, params.eccentricity}),
    }


def html(name: str, params: EllipticGearParams) -> str:
    """The page of a design by its name; the same design gives the same text."""
    import jinja2
    from markupsafe import Markup

    pages = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        keep_trailing_newline=True,
    )
    design = data_of(params)
    data = json.dumps(design, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    return pages.get_template("page.html").render(
        name=name,
        design=design,
        data=Markup(data),  # noqa: S704 - plain numbers
    )
