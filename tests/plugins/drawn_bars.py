"""Four-bars and slider-cranks of their own families, drawn as linkages."""

import cmath
from typing import Any

import numpy as np

from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.kinematics.reach import bar_of
from mechwright_four_bar.parameters import FourBarParams
from mechwright_linkage.parameters import LinkageParams
from mechwright_slider_crank.parameters import SliderCrankParams

SIZES = (
    "speed", "pin_diameter", "bushing_wall", "running_fit", "rim", "web_width", "thickness",
    "ground_thickness", "material", "frame", "clearance",
)  # fmt: skip


def _points(**places: complex) -> dict[str, dict[str, float]]:
    return {name: {"x": complex(z).real, "y": complex(z).imag} for name, z in places.items()}


def four_bar(bar: FourBarParams, **table: Any) -> LinkageParams:
    """With its crank along X, as its own family begins; the load is on the follower."""
    loop = close(bar_of(bar), np.array([0.0]))
    a, b0 = complex(bar.crank), complex(bar.ground)
    places = {"A0": 0j, "B0": b0, "A": a, "B": b0 + bar.follower * complex(loop.follower.direction[0])}
    links = {
        "ground": ["A0", "B0"],
        "crank": ["A0", "A"],
        "coupler": ["A", "B"],
        "follower": ["B0", "B"],
    }
    if bar.coupler_point is not None:
        places["P"] = a + bar.coupler_point * complex(loop.coupler.direction[0])
        links["coupler"].append("P")
    own = {key: getattr(bar, key) for key in SIZES}
    if bar.load_torque:
        own["loads"] = [{"link": "follower", "torque": bar.load_torque}]
    given = {"linkage": "drawn", "points": _points(**places), "links": links, "output": "follower"}
    return LinkageParams.model_validate(given | own | table)


def slider_crank(params: SliderCrankParams, crank: float = 0.6, **table: Any) -> LinkageParams:
    """With its crank at that angle from the slide, rad; the load is on the slider."""
    link = params.linkage
    turn = cmath.exp(1j * link.direction)
    a = link.crank * cmath.exp(1j * crank)
    across = (link.offset - a.imag) / link.rod
    rod = link.branch * np.sqrt(1 - across**2) + 1j * across
    b = a + link.rod * rod
    places = {"A0": 0j, "A": turn * a, "B": turn * b, "P": turn * (a + params.coupler_point * rod)}
    links = {"ground": ["A0"], "crank": ["A0", "A"], "rod": ["A", "B", "P"], "slider": ["B"]}
    slides = [{"block": "slider", "point": "B", "angle": float(np.degrees(link.direction))}]
    own: dict[str, Any] = {"speed": params.speed}
    if params.load:
        own["loads"] = [{"link": "slider", "force_x": params.load, "point": "B"}]
    given = {"linkage": "drawn", "points": _points(**places), "links": links, "slides": slides}
    return LinkageParams.model_validate(given | {"output": "slider"} | own | table)
