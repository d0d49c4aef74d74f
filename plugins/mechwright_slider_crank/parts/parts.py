"""The parts of a slider-crank."""

from dataclasses import replace

from mechwright import Colour, FittingMark, Instance, Part
from mechwright.contracts.measure import between_walls
from mechwright.mechanics.linkage import PIN_MATERIAL, bushing_part, pin_part
from mechwright.standards.parts import GREY, dowel_part
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.parts.base import shaft_end, shaft_form
from mechwright_slider_crank.parts.dimensions import Dimensions
from mechwright_slider_crank.parts.plates import layout_of
from mechwright_slider_crank.parts.rail_screws import dowel_span

COLOURS: dict[str, Colour] = {
    "base": (0.78, 0.80, 0.82),
    "rail": (0.60, 0.66, 0.72),
    "crank": (0.80, 0.45, 0.30),
    "rod": (0.35, 0.52, 0.70),
    "slider": (0.85, 0.70, 0.35),
}


def parts_of(table: Mechanism) -> tuple[Part, ...]:
    """All parts, plates first.

    Raises
    ------
    GeometryError
        As :func:`layout_of`.
    """
    params, layout = table.given, layout_of(table)
    sizes, heights, spans = layout.sizes, layout.stack, layout.stack.spans
    at: dict[str, tuple[Instance, ...]] = {
        name: (Instance(name, heights.bottom(name)),) for name in ("base", "crank", "rod")
    }
    at["slider"] = (Instance("slider", layout.slider_bottom),)
    under, over = heights.bottom("base") + params.thickness, heights.bottom("rail-1")
    lowest = heights.layer["rail-1"] == 1  # rails of the first layer lie on the base, others on spacers
    foot = under if lowest else over
    at["rail"] = tuple(Instance(name, foot) for name in ("rail-1", "rail-2"))
    parts = [
        Part(name, layout.outlines[name], params.thickness, params.material, at[name], COLOURS[name])
        for name in ("base", "rail", "crank", "rod", "slider")
    ]
    parts[1], parts[4] = _guiding(table, sizes, parts[1]), _guided(sizes, parts[4])
    screwed = layout.rail_screws
    if screwed is not None:
        parts[1] = screwed.threaded(parts[1])
        parts += screwed.parts(heights.bottom("base"), under, foot, params.material)
    parts += _shaft_parts(table, spans["shaft"])
    for name, body in (("crank-pin", "crank-pin"), ("wrist-pin", "slider")):
        low, high = spans[name]
        head = sizes.head if layout.has_head(name) else (0.0, 0.0)
        length = high - low + (params.gap if head[0] else 0.0)
        pin = pin_part(name, sizes.pin, length, (Instance(body, low),), *head)
        # The slider lies on the base, and its pin ends above that.
        clear = heights.bottom("slider") - layout.slider_bottom if body == "slider" else 0.0
        parts.append(replace(pin, play=round(clear, 6)))
    low, high = spans["dowel-1"]
    start, long = dowel_span(sizes.dowel, round(high - low - (over - foot), 6), params.thickness)
    dowels = tuple(Instance(f"dowel-{number}", low + start) for number in range(1, 5))
    above = high - low - (over - foot) - start - long
    ends = round(max(start, above), 6)  # it ends below the faces of base and rail
    parts.append(replace(dowel_part("dowel", sizes.dowel, long, dowels), play=ends))
    if not lowest:
        spacers = tuple(Instance(f"dowel-{number}", under) for number in range(1, 5))
        parts.append(
            bushing_part("spacer", sizes.dowel, 2 * sizes.spacer, over - under, spacers, params.material)
        )
    if params.bushing > 0:
        rods = [layout.bushing("rod", other) for other in ("crank", "slider")]
        alike: dict[float, list[Instance]] = {}
        for name, (low, high) in zip(("rod", "rod-end"), rods, strict=True):
            alike.setdefault(round(high - low, 6), []).append(Instance(name, low))
        for number, (length, those) in enumerate(alike.items(), start=1):
            name = "bushing" if number == 1 else f"bushing-{number}"
            spaces = round(length - params.thickness, 6)
            parts.append(bushing_part(name, sizes.pin, sizes.rod_bore, length, those, spaces=spaces))
        low, high = layout.bushing("base", "crank")
        length = round(high - low, 6)
        base = (Instance("base", low),)
        parts.append(
            bushing_part(
                "shaft-bushing",
                sizes.shaft,
                sizes.base_bore,
                length,
                base,
                spaces=round(length - params.thickness, 6),
            )
        )
    return tuple(parts)


def _guiding(table: Mechanism, sizes: Dimensions, rail: Part) -> Part:
    """A rail with what decides how the slider runs between two of them."""
    edge = between_walls("axes of the dowels to the guiding edge", sizes.rail / 2, 1)
    note = (
        "Before the screws of the rails are tight, the slider passes all along between them with a feeler "
        f"gauge of {2 * table.given.play:g} mm beside it."
    )
    marks = (FittingMark(note),) if table.given.play > 0 else ()
    return replace(rail, measures=(*rail.measures, edge), marks=marks)


def _guided(sizes: Dimensions, slider: Part) -> Part:
    """The slider with the width that runs between the rails."""
    width = between_walls("width across the guiding faces", sizes.slider_width, 2)
    return replace(slider, measures=(*slider.measures, width))


def _shaft_parts(table: Mechanism, span: tuple[float, float]) -> list[Part]:
    """The crank's shaft, and the circlip on it under the base."""
    (low, high), end = span, shaft_end(table)
    at = Instance("crank", low - end.whole)
    form = shaft_form(table, high - low)
    parts = [Part("shaft", None, 0.0, PIN_MATERIAL, (at,), GREY, turned=form)]
    if end.ring is not None:
        under = (Instance("crank", low - table.given.gap - end.ring.thickness),)
        parts.append(Part(end.ring.part_name, None, 0.0, PIN_MATERIAL, under, GREY, bought=end.ring.bought))
    return parts
