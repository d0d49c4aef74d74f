"""The page of the coupler's acceleration poles."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from numpy.typing import ArrayLike

from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright.pipeline.poles import NAME, Coupler, PolesPage
from mechwright_four_bar.kinematics.change_point import close_through
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import Loop, close
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.table import FourBarTable


class FourBarPoles(PolesPage):
    """``poles.html`` of a four-bar."""

    name = "four-bar-poles"
    family = "four-bar"

    def couplers(self, params: FourBarParams) -> Mapping[str, Coupler]:
        """The coupler, on both branches where it keeps to one."""
        table = FourBarTable.of(params)
        bar, course, through = table.bar, table.closed_ways.course, bool(table.through)
        both = (bar,) if through else (bar, replace(bar, branch=-bar.branch))

        def loop(one: FourBar, phi: ArrayLike) -> Loop:
            return close_through(one, phi, course.travel) if through else close(one, phi)

        def moved(crank: Turning) -> Sequence[BodyMotion]:
            return [loop(one, crank.theta).bodies(one, crank)["coupler"] for one in both]

        def drawn(phi: float) -> tuple[dict[str, complex], Sequence[Sequence[complex]]]:
            found = loop(bar, [phi])
            pivot = complex(found.bodies(bar, 1.0)["follower"].origin.position[0])
            a, b = complex(found.joint_a[0]), complex(found.joint_b[0])
            return {"A0": 0j, "A": a, "B": b, "B0": pivot}, [(0j, a, b, pivot)]

        return {NAME: Coupler(course, moved, drawn, bar.coupler)}
