"""Errors of slider and coupler point from links, pins, guide and input, exact and to first order.

In the slide frame, with u = exp(i σ') the direction of the rod. Pins move the hole of one link against that
of the other by v, complex, in the directions along and across the rod: v1 at A0, v2 at A, v3 at B. The slider
stands off its line by g in its guide. The loop is then

    v1 + a e^{iφ'} + v2 + c u + v3 = s + i (e + g)

and to first order

    Re(u) ds    = dc + u·(da e^{iφ'} + Σ v + i a e^{iφ'} dφ) - Im(u) (de + g)
    c Re(u) dσ' = de + g - Im(da e^{iφ'} + Σ v + i a e^{iφ'} dφ) - Im(u) dc
    dP          = v1 + da e^{iφ'} + v2 + i a e^{iφ'} dφ + i p u dσ' + dp u

Re(u) = 0, the rod across the slide, is a toggle.
"""

from collections.abc import Sequence

import numpy as np

from mechwright import Array, DesignError, Output, ToleranceModel, Tolerances
from mechwright.mechanics.planar import Plane
from mechwright_slider_crank.course import course_of
from mechwright_slider_crank.params import SliderCrankParams
from mechwright_slider_crank.sizes import sizes_of

SLIDER = Output("slider position", "mm")
POINT = Output("coupler point", "mm", 2)

JOINTS = ("shaft", "crank-pin", "wrist-pin")

FIT = "H7/g6"
"""Of pins and shaft in their bushings: runs without shake at moderate speed, the usual fit of such joints."""

GUIDE_WALLS = 4
"""Milled walls between which the slider has its play: two of the rails and its own."""

_POSITIONS = 361
"""Positions of the crank, both ends of the turn, or of a lever's swing, included."""

_TOGGLE = 1e-6
"""Cosine of the rod's angle below which a first order says nothing: errors there go with the square root."""


class SliderCrankTolerances(ToleranceModel):
    """The model of one design; crank angles count from X, as in the motion."""

    input_name = "phi"

    def __init__(self, params: SliderCrankParams, tolerances: Tolerances) -> None:
        self.link = params.linkage
        self.place = params.coupler_point
        sizes = sizes_of(params)
        if self.link.at_limit:
            raise DesignError(
                "rod: where it stands across the slide, no error is of first order; make it longer"
            )
        course = course_of(params)
        self.positions = (
            np.sort(course.way(_POSITIONS))
            if course.rocks
            else self.link.direction + np.linspace(0, 2 * np.pi, _POSITIONS)
        )
        lengths = [tolerances.length(name, getattr(params, name)) for name in ("crank", "rod", "offset")]
        diameters = (sizes.shaft, sizes.pin, sizes.pin)
        pins = [
            tolerances.pin(name, diameter, FIT, member=name != "shaft")
            for name, diameter in zip(JOINTS, diameters, strict=True)
        ]
        self.contributors = (
            *lengths,
            *pins,
            tolerances.gap("guide", 2 * params.play, GUIDE_WALLS),
            tolerances.length("point-along", self.place.real),
            tolerances.length("point-across", self.place.imag),
            *tolerances.input("input"),
        )
        self.outputs = (SLIDER, POINT)

    def nominal(self, output: str, at: Array) -> Array:
        """The slider's position, or the coupler point from A0, mm."""
        crank, u = self._closed(at, 0.0, 0.0, 0.0, 0.0, 0j)
        start = self.link.crank * crank
        if output == SLIDER.name:
            return np.asarray((start + self.link.rod * u).real)[None]
        return self._fixed(start + self.place * u)

    def sensitivities(self, output: str, at: Array) -> list[Array]:
        """Formulas of the module."""
        link = self.link
        crank, u = self._closed(at, 0.0, 0.0, 0.0, 0.0, 0j)
        none = 0 * u
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = np.where(np.abs(u.real) > _TOGGLE, 1 / u.real, np.nan)
        # By contributor and direction: shift of A, of the loop besides, of the rod's length, of the slide
        # line, and of the point in the rod.
        pin = [(u, none), (1j * u, none)]
        named: dict[str, list[tuple[Plane, ...]]] = {
            "crank": [(crank, none, none, none, none)],
            "rod": [(none, none, 1 + none, none, none)],
            "offset": [(none, none, none, 1 + none, none)],
            "shaft": [(v, none, none, none, none) for v, _ in pin],
            "crank-pin": [(v, none, none, none, none) for v, _ in pin],
            "wrist-pin": [(none, v, none, none, none) for v, _ in pin],
            "guide": [(none, none, none, 1 + none, none)],
            "point-along": [(none, none, none, none, u)],
            "point-across": [(none, none, none, none, 1j * u)],
            "input": [(1j * link.crank * crank, none, none, none, none)],
        }
        found = []
        for one in self.contributors:
            moved: list[Plane] = []
            for start, shift, length, line, place in named[one.name][: one.components]:
                if output == SLIDER.name:
                    along = (np.conj(u) * (start + shift)).real
                    moved.append((length.real + along - u.imag * line.real) * inverse + none)
                else:
                    across = (start + shift).imag + u.imag * length.real
                    turn = (line.real - across) * inverse / link.rod
                    moved.append(start + 1j * self.place * u * turn + place)
            row = np.stack(moved)
            found.append(row.real[None] if output == SLIDER.name else self._fixed(row))
        return found

    def errors(self, output: str, deviations: Sequence[Array], at: Array) -> Array:
        """The loop closed anew."""
        named = {one.name: value for one, value in zip(self.contributors, deviations, strict=True)}
        link = self.link
        crank, u = self._closed(at, 0.0, 0.0, 0.0, 0.0, 0j)
        pins = [_plane(named[name]) * u for name in JOINTS]
        a, c, e, g = (named[name][0] for name in ("crank", "rod", "offset", "guide"))
        turned = at + named["input"][0] if "input" in named else at
        moved, s = self._closed(turned, a, c, e, g, sum(pins))
        start = pins[0] + pins[1] + (link.crank + a) * moved - link.crank * crank
        if output == SLIDER.name:
            return np.asarray((start + pins[2] + (link.rod + c) * s - link.rod * u).real)[None]
        place = self.place + named["point-along"][0] + 1j * named["point-across"][0]
        return self._fixed(start + place * s - self.place * u)

    def _fixed(self, z: Plane) -> Array:
        """Both coordinates (2, ...) in the fixed frame."""
        turned = z * np.exp(1j * self.link.direction)
        return np.stack([turned.real, turned.imag])

    def _closed(
        self,
        at: Array,
        a: Array | float,
        c: Array | float,
        e: Array | float,
        g: Array | float,
        shift: Plane | complex,
    ) -> tuple[Plane, Plane]:
        """Directions of crank and rod in the slide frame; NaN where the rod does not reach."""
        link = self.link
        crank = np.exp(1j * (at - link.direction))
        rod = link.rod + c
        across = (link.offset + e + g - ((link.crank + a) * crank + shift).imag) / rod
        with np.errstate(invalid="ignore"):
            along = link.branch * np.sqrt(1 - across * across)
        return crank, np.asarray(along + 1j * across)


def _plane(v: Array) -> Plane:
    """A pin's displacement: along the rod alone where it is loaded."""
    return np.asarray(v[0] + 1j * v[1] if len(v) == 2 else v[0] + 0j)
