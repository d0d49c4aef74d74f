"""The bed side of a plate: its edges are broken, so that the squeezed first layer stays within the wall.

A chamfer of 45 degrees is as wide as the foot and half a first layer: where the slicer cuts that layer, in
the middle of its height, the wall stands back by the foot.
"""

from dataclasses import replace

from mechwright.contracts.details import Chamfer
from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.contracts.sections import blind
from mechwright.contracts.underside import from_below
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline, circle
from mechwright.geometry.mirror import turned_over
from mechwright_print.compensation.offsets import material_left

DEEPEST = 0.4
"""The bed side takes so much of a plate's thickness at the most: the rest bears."""


def chamfer_width(foot: float, first_layer: float) -> float:
    """Width of the chamfer on the bed side, mm; 0 where no foot is.

    >>> chamfer_width(0.1, 0.2), chamfer_width(0.0, 0.2)
    (0.2, 0.0)
    """
    return foot + first_layer / 2 if foot > 0 else 0.0


def from_underside(part: Part) -> Part:
    """The plate seen from below, turned over about X; what is closed there is left out with its details.

    Raises GeometryError as :func:`from_below` does.
    """
    assert part.outline is not None  # noqa: S101 - asked of plates
    outline = part.outline
    kept = [one for one in part.features if one.top + one.depth >= part.thickness - 1e-6]
    return replace(
        part,
        outline=Outline(
            turned_over(outline.outer, "x"),
            tuple(turned_over(loop, "x") for loop in outline.inner),
            outline.deviation,
        ),
        machined=tuple(from_below(one, part.thickness, "x") for one in kept),
        details=(),
    )


def broken_top(part: Part, width: float) -> Part:
    """The plate with all edges of its top face broken at least so wide, mm; wider ones stay."""
    assert part.outline is not None  # noqa: S101 - asked of plates
    own = [one for one in part.details if isinstance(one, Chamfer)]
    if own:
        return replace(part, details=tuple(replace(one, width=max(one.width, width)) for one in own))
    edges: list[Chamfer] = [
        Chamfer(f"bed-{number}", loop, "outside" if number == 0 else "inside", width)
        for number, loop in enumerate(part.outline.loops)
    ]
    for feature in blind(part):
        if feature.top > 0:
            continue
        match feature:
            case Bore():
                loops = [(Loop((circle(feature.centre, feature.diameter / 2),)), "inside")]
            case Profile():
                loops = [(feature.loop, feature.side)]
            case Pocket():
                loops = [(feature.boundary, "inside"), *((one, "outside") for one in feature.islands)]
        for number, (loop, side) in enumerate(loops):
            if side == "inside":
                run = material_left(loop, opening=True).reversed()
                edges.append(Chamfer(f"bed-{feature.name}-{number}", run, "inside", width))
            else:
                run = material_left(loop, opening=False)
                edges.append(Chamfer(f"bed-{feature.name}-{number}", run, "outside", width))
    return replace(part, details=tuple(edges))


def zone_height(part: Part, width: float) -> float:
    """How far above the bed the bed side ends, mm; raises GeometryError for too thin a plate."""
    height = max(2 * width, 0.5)
    if height > DEEPEST * part.thickness:
        height = 1.5 * width
    if height > DEEPEST * part.thickness:
        raise GeometryError(
            f"part {part.name}: a chamfer of {width:g} mm against the first layer takes too much of a plate "
            f"{part.thickness:g} mm thick; set deviation.foot = 0 in the file of the printer"
        )
    return height
