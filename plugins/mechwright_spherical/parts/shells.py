"""Concentric shells: which link lies between which radii.

From the sphere outwards: the coupler, crank and rocker, the arm of a five-bar, the ground link. Links that
share a shell must keep clear of each other sideways; a pin crosses the shells between its two links. A
four-bar whose links do not may stand between two arcs of the ground instead.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from mechwright_spherical.parameters import SphericalParams

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
    def inside(self) -> Span:
        """Span of the innermost shell, mm; links stand in order."""
        return next(iter(self.links.values()))

    @property
    def outside(self) -> float:
        """Outer radius of the outermost shell, mm."""
        return self.links["ground"][1]


RISE, FLANGE = 6.0, 6.0
"""From the ground link to a motor's flange on it, mm: room for heads of screws; and its thickness."""

SHAFT_END = 2.0
"""How far shafts stick out of the ground link, mm, where they carry nothing: room for a clip."""


def one_side(params: SphericalParams, over: float = 0.0) -> Shells:
    """The shells with the ground link outside all others.

    ``over`` is what stands over crank and rocker, mm: the heads of studs.
    """
    hardware = params.hardware
    links = _stacked(params, [("coupler",), ("crank", "rocker")], params.radius + hardware.standoff)
    outer = [("arm",), ("ground",)] if params.kind == "five-bar" else [("ground",)]
    links |= _stacked(params, outer, links["crank"][1] + hardware.gap + over)
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


def two_sides(params: SphericalParams) -> Shells:
    """The shells of a four-bar between two arcs of the ground, so that no pin crosses another link.

    From the centre: ``ground-2`` with the input axis, crank, the sphere of the path point, coupler, rocker,
    and ``ground`` with the output axis.
    """
    hardware = params.hardware
    thickness = hardware.link_thickness + 2 * hardware.boss_height
    inside = params.radius - 2 * (hardware.gap + thickness)
    links = _stacked(params, [("ground-2",), ("crank",)], inside)
    links |= _stacked(params, [("coupler",), ("rocker",), ("ground",)], params.radius + hardware.standoff)
    crank, coupler, rocker = links["crank"], links["coupler"], links["rocker"]
    pins = {
        "a": (crank[0], coupler[1]),
        "c": (coupler[0], rocker[1]),
        "a0": (inside - SHAFT_END, crank[1]),
        "b0": (rocker[0], links["ground"][1] + SHAFT_END),
        "tool": (params.radius, coupler[1]),
    }
    return Shells(links, hardware.boss_height, pins)


def _stacked(params: SphericalParams, order: Sequence[tuple[str, ...]], start: float) -> dict[str, Span]:
    """Links to their spans, from an inner radius outwards; those of one group share a shell."""
    hardware = params.hardware
    thickness = hardware.link_thickness + 2 * hardware.boss_height
    links: dict[str, Span] = {}
    for names in order:
        links |= dict.fromkeys(names, (start, start + thickness))
        start = start + thickness + hardware.gap  # which may be a column
    return links
