"""The parts on both fixed axes of a ground link with a motor's flange, and where they stand on these."""

import math
from dataclasses import dataclass, replace

import numpy as np

from mechwright import Array, Bought, Turned, kept
from mechwright.contracts.shape import Shape
from mechwright_spherical.frame import shells_of
from mechwright_spherical.linkage import linkage_of
from mechwright_spherical.mount import AIR, hubs_of, shaft_form, spacer_form
from mechwright_spherical.params import SphericalParams
from mechwright_spherical.places import link_arcs


@dataclass(frozen=True)
class OnAxis:
    """A part on a fixed axis.

    Parameters
    ----------
    body
        Of the motion.
    place
        Direction of the axis in the body, and the radius at which the part begins, mm.
    shape
        Standing on z = 0.
    """

    body: str
    place: tuple[Array, float]
    shape: Shape
    material: str
    turned: Turned | None = None
    bought: Bought | None = None


@kept
def mounted_parts(params: SphericalParams) -> dict[str, OnAxis]:
    """By part name; none without a flange."""
    hubs = hubs_of(params)
    if not hubs:
        return {}
    shells, arc = shells_of(params), link_arcs(linkage_of(params))["ground"]
    own = np.array([1.0, 0.0, 0.0])
    axes = {"a0": own, "b0": np.array([math.cos(arc), math.sin(arc), 0.0])}
    found: dict[str, OnAxis] = {}
    spacer, steel = spacer_form(params), params.hardware.pin_material
    for name, body in (("a0", "crank"), ("b0", "rocker")):
        hub, shaft = hubs[name], shaft_form(params, shells, name)
        found[f"shaft-{name}"] = OnAxis(body, (own, shells.pins[name][0]), shaft.shape, steel, turned=shaft)
        for number, (bush, low) in enumerate(hub.bushes, start=1):
            bought = bush.bought
            shape = bought.shape or Shape(())
            key = f"bush-{name}-{number}"
            found[key] = OnAxis(
                "ground", (axes[name], low), shape, "brass", bought=replace(bought, shape=None)
            )
        ring = hub.ring.bought
        found[f"circlip-{name}"] = OnAxis(
            body, (own, hub.seat), ring.shape or Shape(()), "steel", bought=replace(ring, shape=None)
        )
        if spacer is not None:
            low = shells.links["crank"][1] + AIR / 2
            found[f"spacer-{name}"] = OnAxis(body, (own, low), spacer.shape, "brass", turned=spacer)
    return found
