"""Outlines of the plates of a slider-crank, each in its own coordinates."""

from mechwright import Outline
from mechwright.mechanics.linkage import Boss, bent_link, disc, hull_link, rectangle, web_link
from mechwright_slider_crank.kinematics.course import ends_of
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.parts.dimensions import Dimensions, corner_of

FILLET_SHARE = 0.6
"""Fillet between rod and boss over the boss's radius: a smooth flow of force, and room for a cutter."""

BEND_SHARE = 2.0
"""Radius of a bent rod's middle line over its width."""


def crank_outline(table: Mechanism) -> Outline:
    """A disc about the pivot, or an arm; the bores are for shaft and pin, both pressed in."""
    params, sizes = table.given, table.dimensions
    shaft = Boss(0j, sizes.shaft / 2 + sizes.wall, sizes.shaft, "shaft")
    pin = Boss(complex(params.crank), sizes.pin_boss, sizes.pin, "crank-pin")
    if params.crank_shape == "disc":
        return disc(max(params.crank + pin.radius, shaft.radius), (shaft, pin))
    return hull_link((shaft, pin))


def rod_outline(table: Mechanism) -> Outline:
    """Straight, waisted, bent, or ternary where the coupler point has a bore.

    Raises
    ------
    GeometryError
        Width or bend do not fit the bosses; the message gives the limit.
    """
    params, sizes = table.given, table.dimensions
    one = Boss(0j, sizes.rod_boss, sizes.rod_bore, "crank-pin")
    two = Boss(complex(params.rod), sizes.rod_boss, sizes.rod_bore, "wrist-pin")
    width = params.rod_width
    if params.coupler_bore > 0:
        point = Boss(
            params.coupler_point, params.coupler_bore / 2 + sizes.wall, params.coupler_bore, "coupler-point"
        )
        return hull_link((one, two, point))
    if params.rod_bend:
        elbow = complex(params.rod / 2, params.rod_bend)
        width = sizes.rod_boss if width is None else width
        return bent_link(one, two, elbow, width, FILLET_SHARE * sizes.rod_boss, BEND_SHARE * width)
    if width is None:
        return hull_link((one, two))
    return web_link(one, two, width, FILLET_SHARE * sizes.rod_boss)


def slider_outline(sizes: Dimensions) -> Outline:
    """With the bore of its pin in the middle."""
    half = complex(sizes.slider_length, sizes.slider_width) / 2
    return rectangle(-half, half, _corner(half), (Boss(0j, 0, sizes.pin, "wrist-pin"),))


def _corner(half: complex) -> float:
    """The corner radius, smaller on what is small."""
    return float(corner_of(half.real, half.imag))


def rails_of(
    table: Mechanism, sizes: Dimensions
) -> tuple[Outline, tuple[complex, complex], tuple[complex, ...]]:
    """A rail in its own coordinates (origin in its middle), both places, and the dowels in the base."""
    params, (low, high) = table.given, (float(end) for end in ends_of(table).way)
    # The slider stays on the rails for its whole stroke; the dowels stand beyond its ends.
    half = (high - low + sizes.slider_length) / 2 + sizes.overhang
    apart = sizes.slider_width / 2 + params.play + sizes.rail / 2
    middle = complex((low + high) / 2, params.offset)
    dowel = half - sizes.rail / 2
    corner = complex(half, sizes.rail / 2)
    holes = tuple(Boss(complex(x), 0, sizes.dowel, "dowel") for x in (-dowel, dowel))
    outline = rectangle(-corner, corner, _corner(corner), holes)
    places = (middle - 1j * apart, middle + 1j * apart)
    return outline, places, tuple(place + hole.centre for place in places for hole in holes)
