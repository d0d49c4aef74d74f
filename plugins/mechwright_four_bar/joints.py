"""The joints: what is pressed into which link, what turns in which, and the bosses that this gives plates.

The crank's shaft and its pin A are pressed into the crank, pin B into the follower. With one ground plate
pin B0 is pressed into it, and the follower turns on it. With two the follower has a shaft that turns in the
second one, from which the output is taken.
"""

from dataclasses import dataclass

from mechwright.mechanics.linkage import Boss
from mechwright_four_bar.params import FourBarParams
from mechwright_four_bar.phases import spare_holes

HEAD, HEAD_HEIGHT = 1.6, 0.3
"""Diameter and height of a pin's head, in pin diameters: those of small rivets and clevis pins."""

SHAFT = 3.0
"""Length of a shaft outside its ground plate, in pin diameters: room for a coupling."""


@dataclass(frozen=True)
class Joint:
    """A pin or shaft.

    Parameters
    ----------
    body
        The body it is pressed into.
    frame
        The frame of the motion on its axis that moves with that body.
    place
        Its axis in the body, x + i y, mm.
    plates
        The plates it joins.
    head
        Whether it has a head on top; without it ends flush with its plates.
    below, above
        How far it goes on under its lowest plate and over its highest one, in pin diameters.
    """

    body: str
    frame: str
    place: complex
    plates: tuple[str, str]
    head: bool = True
    below: float = 0.0
    above: float = 0.0


def turning_bore(params: FourBarParams) -> float:
    """Diameter of a plate's bore in which a pin turns, with or without a bushing, mm."""
    if params.bushing_wall > 0:
        return params.pin_diameter + 2 * params.bushing_wall
    return params.pin_diameter + params.running_fit


def joints(params: FourBarParams, sides: int) -> dict[str, Joint]:
    """Shafts and pins by name, with ground plates on that many sides; between two, links hold each other."""
    a, b = complex(params.crank), complex(params.follower)
    one = sides == 1
    found = {
        "shaft": Joint("crank", "crank", 0j, ("ground", "crank"), False, below=SHAFT),
        "pin-a": Joint("crank", "crank-a", a, ("crank", "coupler"), one),
        "pin-b": Joint("follower", "follower-b", b, ("follower", "coupler"), one),
    }
    if one:
        b0 = Joint("ground", "ground-b0", complex(params.ground), ("ground", "follower"))
        return {**found, "pin-b0": b0}
    b0 = Joint("follower", "follower", 0j, ("follower", "ground-2"), False, above=SHAFT)
    return {**found, "shaft-b0": b0}


def bosses(params: FourBarParams, sides: int) -> dict[str, tuple[Boss, ...]]:
    """The bosses of every plate, in its body's frame."""
    pressed, turning = params.pin_diameter, turning_bore(params)

    def boss(x: complex, bore: float, tag: str) -> Boss:
        return Boss(complex(x), bore / 2 + params.rim, bore, tag)

    point = params.coupler_point
    third = () if point is None else (boss(point, pressed, "coupler-point"),)
    spare = tuple(boss(at, turning, f"{name}-spare") for name, at in spare_holes(params))
    links = {
        "crank": (boss(0, pressed, "A0"), boss(params.crank, pressed, "A")),
        "coupler": (boss(0, turning, "A"), boss(params.coupler, turning, "B"), *third, *spare),
    }
    end, one = boss(params.follower, pressed, "B"), boss(0, turning, "A0")
    if sides == 1:
        ground = (one, boss(params.ground, pressed, "B0"))
        return {"ground": ground, **links, "follower": (boss(0, turning, "B0"), end)}
    other = boss(params.ground, turning, "B0")
    return {"ground": (one,), "ground-2": (other,), **links, "follower": (boss(0, pressed, "B0"), end)}
