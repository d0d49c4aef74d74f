"""Concentric shells: which link lies between which radii.

From the sphere outwards: the coupler, crank and rocker, the arm of a five-bar, the ground link. Links that
share a shell must keep clear of each other sideways; a pin crosses the shells between its two links.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from mechwright_spherical.params import SphericalParams

Span = tuple[float, float]
"""Inner and outer radius, mm."""


@dataclass(frozen=True, slots=True)
class Shells:
    """Radii of links and pins, mm.

    Parameters
    ----------
    links
        Link to the span of its shell: that of its bosses.
    recess
        By how much the arcs are thinner than the bosses, on each side.
    pins
        Pin to its span: ``a``, ``c``, ``b`` (five-bar), ``a0``, ``b0``, ``tool``.
    """

    links: Mapping[str, Span]
    recess: float
    pins: Mapping[str, Span]

    def arc(self, link: str) -> Span:
        """Span of a link's arc between its bosses."""
        inner, outer = self.links[link]
        return inner + self.recess, outer - self.recess

    @property
    def outside(self) -> float:
        """Outer radius of the outermost shell, mm."""
        return self.links["ground"][1]


SHAFT_END = 2.0
"""How far shafts stick out of the ground link, mm, where they carry nothing: room for a clip."""


def shells_of(params: SphericalParams) -> Shells:
    """The shells of a design."""
    hardware = params.hardware
    order = [("coupler",), ("crank", "rocker"), ("ground",)]
    if params.kind == "five-bar":
        order.insert(2, ("arm",))
    thickness = hardware.link_thickness + 2 * hardware.boss_height
    links: dict[str, Span] = {}
    at = params.radius + hardware.standoff
    for names in order:
        links |= dict.fromkeys(names, (at, at + thickness))
        at += thickness + hardware.gap
    ground, coupler, crank = links["ground"], links["coupler"], links["crank"]
    end = ground[1] + SHAFT_END
    if params.kind == "five-bar" and params.drive.gears:
        end = ground[1] + hardware.gap + params.drive.face_width + SHAFT_END
    pins = {
        "a": (coupler[0], crank[1]),
        "c": (coupler[0], crank[1]),
        "a0": (crank[0], end),
        "tool": (params.radius, coupler[1]),
    }
    if params.kind == "five-bar":
        arm = links["arm"]
        pins |= {"b": (crank[0], arm[1]), "b0": (arm[0], end), "idler": (ground[0], end)}
    else:
        pins["b0"] = (crank[0], end)
    return Shells(links, hardware.boss_height, pins)
