"""The pictures: loci of the pole on the ground and in the coupler, and the circles of one position."""

from collections.abc import Mapping, Sequence

import numpy as np

from mechwright.mechanics.planar import Plane
from mechwright.pipeline.figures.sheet import INK, Window, linkage
from mechwright.pipeline.poles.coupler import Coupler

COLOURS = ("#b3261e", "#1f5fa8", "#2e7d32", "#8a5a00", "#6a3d9a")
"""Of the ratios of a picture, in their order."""

FAR = 3.0
"""How many sizes of the linkage about its middle a picture shows at most: loci go on far beyond."""

MARKED = (-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0)
"""Ratios that are marked on the inflection circle."""


def ground(
    coupler: Coupler, ratios: Sequence[float], phi: float, marks: Mapping[str, complex] | None = None
) -> str:
    """Loci on the ground, and the linkage at a crank angle; dashed: the first ratio in the other assembly.

    ``marks`` are places to show besides, by name, from A0, mm.
    """
    label = f"loci of the acceleration pole on the {coupler.seen_from}"
    return _loci(coupler, ratios, 0, coupler.drawn(phi), label, marks or {})


def moving(coupler: Coupler, ratios: Sequence[float]) -> str:
    """Loci in the link, as its outline shows it."""
    plain = {"A": 0j, "B": complex(coupler.length)}, [[0j, complex(coupler.length)]]
    label = f"loci of the acceleration pole in the {coupler.link}"
    return _loci(coupler, ratios, 1, plain if coupler.outline is None else coupler.outline, label, {})


def _loci(
    coupler: Coupler,
    ratios: Sequence[float],
    plane: int,
    linked: tuple[dict[str, complex], Sequence[Sequence[complex]]],
    label: str,
    marks: Mapping[str, complex],
) -> str:
    joints, lines = linked
    curves = [coupler.locus(ratio)[plane] for ratio in ratios]
    other = [coupler.locus(ratios[0], 1)[plane]] if coupler.assemblies > 1 else []
    window = _window([*joints.values(), *marks.values()], curves + other)
    drawn = linkage(window, joints, lines)
    drawn += [window.line(one, COLOURS[0], 1.0, stroke_dasharray=window.dashes()) for one in other]
    drawn += [window.line(*one, 1.8) for one in reversed(list(zip(curves, COLOURS, strict=False)))]
    drawn += [window.dot(place, INK, name, 1.3) for name, place in marks.items()]
    names = [(f"k = {ratio:g}", colour) for ratio, colour in zip(ratios, COLOURS, strict=False)]
    return window.picture([*drawn, window.scale(), window.key(names)], label)


def _window(joints: Sequence[complex], curves: Sequence[Plane]) -> Window:
    """All of the joints, and of the curves what is near them."""
    core = Window.about(joints)
    points = np.concatenate([curve[np.isfinite(curve)] for curve in curves])
    points = points[np.abs(points - core.middle) < FAR * core.size]
    return Window.about([*joints, *points.tolist()])


def position(coupler: Coupler, ratio: float, phi: float) -> str:
    """The instant centre, the circles and the poles of all ratios at a crank angle."""
    joints, lines = coupler.drawn(phi)
    found = coupler.circles(phi, ratio)
    p, g = complex(found.instant_centre[0]), coupler.pole(phi, ratio)
    core = Window.about(joints.values())
    near = [place for place in (p, g) if np.isfinite(place) and abs(place - core.middle) < FAR * core.size]
    window = Window.about([*joints.values(), *near], 0.1)
    drawn = linkage(window, joints, lines)
    drawn.append(window.line(coupler.poles_of_all_ratios(phi), COLOURS[1], 1.8))
    half = complex(found.tangential[0]) / 2
    drawn.append(window.circle(p + half, abs(half), COLOURS[2], 1.4, stroke_dasharray=window.dashes()))
    for mark in MARKED:
        place = coupler.pole(phi, mark)
        drawn.append(window.dot(place, COLOURS[1], f"{mark:g}".replace("-", "−"), 0.6, before=True))
    drawn += [window.dot(p, INK, "P"), window.dot(g, COLOURS[0], "G", 1.3)]
    names = [
        ("inflection circle, k", COLOURS[1]),
        ("tangential circle", COLOURS[2]),
        (f"G, k = {ratio:g}", COLOURS[0]),
    ]
    label = f"circles of the {coupler.link} at a crank angle of {np.degrees(phi):.4g} degrees"
    return window.picture([*drawn, window.scale(), window.key(names)], label)
