"""The page of the rod's acceleration poles."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright.pipeline.poles import NAME, Coupler, PolesPage
from mechwright_slider_crank.kinematics.course import course_of
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.parameters import SliderCrankParams


class SliderCrankPoles(PolesPage):
    """``poles.html`` of a slider-crank."""

    name = "slider-crank-poles"
    family = "slider-crank"

    def couplers(self, params: SliderCrankParams) -> Mapping[str, Coupler]:
        """The rod, in both assemblies where it keeps to one."""
        linkage = params.linkage
        both = (linkage,) if linkage.at_limit else (linkage, replace(linkage, branch=-linkage.branch))

        def moved(crank: Turning) -> Sequence[BodyMotion]:
            return [one.bodies(crank.theta, crank).rod for one in both]

        def drawn(phi: float) -> tuple[dict[str, complex], Sequence[Sequence[complex]]]:
            bodies = linkage.bodies(phi)
            a, b = complex(bodies.rod.origin.position[0]), complex(bodies.slider.origin.position[0])
            along = np.exp(1j * linkage.direction) * linkage.crank / 2
            return {"A0": 0j, "A": a, "B": b}, [(0j, a, b), (b - along, b + along)]

        return {NAME: Coupler(course_of(Mechanism.of(params)), moved, drawn, linkage.rod)}
