"""Masses of the parts of many cams, as :mod:`mechwright_cam_follower.parts` draws them.

Outlines are lines and arcs, but for the cam's: of that, Green's theorem gives the area as an integral over
the turn. With the pitch curve c in the cam's frame, V its rate over the cam's angle and R the roller's radius

    A = A_c - R L + π R²,  2 A_c = ∫ Im(c̄ V) dθ over the cam,  L = ∫ |V| dθ

(the parallel curve of one that winds once), and with the support function h of a flat face, whose normal
stands under β, and the radius of curvature ρ

    2 A = ∫ h ρ |β'| dθ.

Between breaks of the law all this is smooth, and Gauss' quadrature meets it.
"""

import math
from collections.abc import Callable, Collection
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, material
from mechwright.contracts.by_arrays import Answer
from mechwright.contracts.mass import KILOGRAMS
from mechwright.contracts.masses import OF_PART, TOTAL, is_mass
from mechwright.mechanics.linkage.areas import (
    circle_area,
    hull_area,
    rectangle_area,
    strip_area,
    two_discs_area,
)
from mechwright.mechanics.openings import opening_of
from mechwright_cam_follower.geometry import geometry_of
from mechwright_cam_follower.many import Cams, Course, Seen
from mechwright_cam_follower.motion import ROLLERS
from mechwright_cam_follower.parts import BOSSES
from mechwright_cam_follower.sizes import CORNER, FREE

NODES = 24
"""Of a smooth piece of the turn: those of the laws, up to a whole turn wide, are met to 1e-9."""

_GAUSS = np.polynomial.legendre.leggauss(NODES)


def give_masses(found: Answer, columns: Collection[str], course: Course, left: NDArray[np.intp]) -> None:
    """Give the masses that are asked for of the designs ``left``, those of the course."""
    asked = [name for name in columns if is_mass(name)]
    if not asked:
        return
    weights = _Weights(found, course, left)
    makers = weights.makers()
    wanted = makers if TOTAL in asked else {OF_PART + name for name in makers} & set(asked)
    one = {name: np.broadcast_to(np.ravel(make()), left.size) for name, (make, _) in makers.items()
           if name in wanted or OF_PART + name in wanted}  # fmt: skip
    for name in asked:
        if name == TOTAL:
            total = np.sum([copies * one[part] for part, (_, copies) in makers.items()], axis=0)
            found.give(name, KILOGRAMS * total, left)
        elif (part := name.removeprefix(OF_PART)) in one:
            found.give(name, KILOGRAMS * one[part], left)


class _Weights:
    """Masses (n, 1) of one of each part, mm³ times g/cm³."""

    def __init__(self, found: Answer, course: Course, left: NDArray[np.intp]) -> None:
        self.found, self.course, self.left = found, course, left
        self.cams: Cams = course.cams
        self.geometry = geometry_of(self.cams)
        self.density = material(self.cams.common.material).density

    def makers(self) -> dict[str, tuple[Callable[[], Any], int]]:
        """Part to how it is weighed, and how many there are."""
        cams = self.cams
        found: dict[str, tuple[Callable[[], Any], int]] = {"cam": (lambda: self.cam(0), 1)}
        if cams.conjugate:
            found["cam-2"] = lambda: self.cam(1), 1
        found["slide" if cams.translating else "lever"] = self.follower, 1
        if cams.contact == "roller":
            found |= dict.fromkeys(ROLLERS[: 1 + cams.conjugate], (self.roller, 1))
        if cams.translating:
            found["rail"] = self.rail, 2
        return found

    def cam(self, number: int) -> Any:
        """One of a pair, or the only one."""
        cams = self.cams
        keyed = opening_of(cams.common) if cams.common.keyway_width > 0 else None
        bore = circle_area(cams.bore) if keyed is None else abs(keyed.loop().area)
        area = self._inside(number) - bore - cams.screws * circle_area(cams.screw_diameter)
        return area * cams.thickness * self.density

    def _inside(self, number: int) -> Array:
        """Area (n, 1) of a cam without its bores."""
        cams, nodes, weights = self.cams, *_GAUSS
        swept: Any = 0.0
        length: Any = 0.0
        for piece in self.course.pieces:
            half = (piece.high - piece.low) / 2
            u = piece.low + half * (1 + nodes) if piece.segment.law else np.array([piece.low])
            spread = (half * weights if piece.segment.law else np.array([1.0])) * piece.segment.width
            rates = Seen(cams, piece.segment.at(u[None])).rates
            if cams.contact == "flat":
                swept = swept + self._facing(rates) @ spread
                continue
            centre, first, *_ = self.geometry.roller(rates, bool(number))
            velocity = first - 1j * cams.sense * centre
            swept = swept + (np.conj(centre) * velocity).imag @ spread
            length = length + np.abs(velocity) @ spread
        whole = np.reshape(np.abs(swept), (-1, 1)) / 2
        if cams.contact == "flat":
            return whole
        radius = cams.value("roller_radius")
        return np.asarray(whole - radius * np.reshape(length, (-1, 1)) + math.pi * radius**2)

    def _facing(self, rates: Any) -> Array:
        """What a flat face's support, radius of curvature and turning give (n, k)."""
        cams, radius = self.cams, self.geometry.contact(rates).radius
        if cams.translating:
            return np.asarray((cams.base_radius + rates.s) * radius)
        support = cams.value("centre_distance") * np.cos(self.geometry.start - rates.s) - cams.face
        return np.asarray(support * radius * np.abs(rates.v + cams.sense))

    def follower(self) -> Any:
        """Slide or lever."""
        cams = self.cams
        area = self._slide() if cams.translating else self._lever()
        if not cams.translating:
            area = area - circle_area(cams.pivot_bore)
        if cams.contact == "roller":
            area = area - (1 + cams.conjugate) * circle_area(cams.pin_diameter)
        if cams.conjugate:
            way = (
                cams.stroke if cams.translating else cams.value("centre_distance") * math.radians(cams.stroke)
            )
            area = area - strip_area(way, cams.bore / 2 + FREE)
        return area * self._depth * self.density

    @property
    def _depth(self) -> Any:
        """Thickness of bar, lever and rails, mm."""
        return self.cams.thickness if self.cams.contact == "flat" else self.cams.follower_thickness

    def _slide(self) -> Any:
        cams, start = self.cams, self.geometry.start
        low: Any
        if cams.contact == "flat":
            margin, (low, high) = cams.value("face_margin"), self._face
            width = high - low + 2 * margin
            reach = np.maximum(self._sought(lambda seen: np.abs(seen.contacts[0].point)), start + cams.stroke)
            corner = np.minimum(np.minimum(CORNER, margin), width / 3)
            return rectangle_area(width, reach + FREE + cams.guide_length - start, corner)
        width = self._bar
        apart: Any = self.geometry.apart if cams.conjugate else 0.0
        return strip_area(apart + cams.stroke + width / 2 + FREE + cams.guide_length, width / 2)

    @property
    def _bar(self) -> Any:
        """Width of a slide's bar, mm."""
        cams = self.cams
        if not cams.conjugate:
            return cams.follower_width
        room = 2 * (cams.bore / 2 + FREE + cams.least_wall + np.abs(cams.value("offset")))
        return np.maximum(cams.follower_width, room)

    @property
    def _face(self) -> tuple[Array, Array]:
        """From where to where (n, 1) a flat face is touched."""

        def along(seen: Seen) -> Array:
            return seen.geometry.along_face(seen.contacts[0], seen.rates)

        return -self._sought(lambda seen: -along(seen)), self._sought(along)

    def _sought(self, measure: Callable[[Seen], Array]) -> Array:
        most, sure = self.course.greatest(measure)
        self.found.doubt(~sure, self.left)
        return np.asarray(most)[:, None]

    def _lever(self) -> Any:
        cams, half = self.cams, self.cams.follower_width / 2
        if cams.contact == "flat":
            margin, (low, high) = cams.value("face_margin"), self._face
            corner = np.minimum(CORNER, margin)
            ends = [low - margin + corner, high + margin - corner]
            sides = [cams.face - corner, cams.face - cams.follower_width + corner]
            corners = [end + 1j * side for side in sides for end in ends]
            return self._hull([0j, *corners], [half, *[corner] * 4])
        arm = cams.value("arm_length")
        if not cams.conjugate:
            return two_discs_area(arm, half, half)
        axis, room = cams.value("centre_distance"), cams.bore / 2 + FREE + cams.least_wall
        turns = np.linspace(0.0, math.radians(cams.stroke), BOSSES)
        places = [axis * np.exp(1j * (self.geometry.start + turn)) for turn in turns]
        studs = [0j, arm, arm * np.exp(1j * self.geometry.apart)]
        return self._hull([*studs, *places], [half] * 3 + [room] * BOSSES)

    def _hull(self, centres: list[Any], radii: list[Any]) -> Array:
        places, sizes = ([np.ravel(one) for one in some] for some in (centres, radii))
        return hull_area(places, sizes, len(self.cams))[:, None]

    def roller(self) -> Any:
        """With its stud."""
        cams, density = self.cams, material(self.cams.common.roller_material).density
        stud = circle_area(cams.pin_diameter) * (cams.axial_gap + cams.follower_thickness)
        return density * (circle_area(2 * cams.value("roller_radius")) * cams.thickness + stud)

    def rail(self) -> Any:
        """One of a slide's."""
        cams = self.cams
        width = 2 * (cams.guide_screw + cams.least_wall)
        area = rectangle_area(width, cams.guide_length, CORNER) - 2 * circle_area(cams.guide_screw)
        return area * self._depth * self.density
