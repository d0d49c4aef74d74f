"""The joints: what is pressed into which link, what turns in which, and the bosses that this gives plates.

The crank's shaft and its pin A are pressed into the crank, pin B into the follower. With one ground plate
pin B0 is pressed into it, and the follower turns on it. With two the follower has a shaft that turns in the
second one, from which the output is taken. Where A or B is set in a slot of the coupler, its pin is a stud
that is clamped there and turns in crank or follower.
"""

from dataclasses import dataclass

from mechwright.mechanics.linkage import Boss
from mechwright.mechanics.linkage.scale import WIDTH
from mechwright.mechanics.linkage.slots import ArcSlot
from mechwright.mechanics.linkage.turned import HEAD_HEIGHT, SHAFT
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.phases import clamp_of_design, set_joints, slotted, spare_holes
from mechwright_four_bar.parts.sizes import turning_bore


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
    stud
        Whether it is clamped in a slot of the coupler, and turns in the other plate.
    below, above
        How far it goes on under its lowest plate and over its highest one, in pin diameters.
    """

    body: str
    frame: str
    place: complex
    plates: tuple[str, str]
    head: bool = True
    stud: bool = False
    below: float = 0.0
    above: float = 0.0


def joints(params: FourBarParams, sides: int) -> dict[str, Joint]:
    """Shafts and pins by name, with ground plates on that many sides; between two, links hold each other."""
    a, b = complex(params.crank), complex(params.follower)
    one, in_slot = sides == 1, {name: slotted(params, name) for name in "AB"}
    found = {
        "shaft": Joint("crank", "crank", 0j, ("ground", "crank"), False, below=SHAFT),
        "pin-a": Joint("crank", "crank-a", a, ("crank", "coupler"), one and not in_slot["A"], in_slot["A"]),
        "pin-b": Joint(
            "follower", "follower-b", b, ("follower", "coupler"), one and not in_slot["B"], in_slot["B"]
        ),
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
    ways, ends = set_joints(params), {"A": pressed, "B": pressed}
    shown = tuple(boss(way.places[0], turning, name) for name, way in ways.items() if way.slot is None)
    third = () if point is None else (boss(point, pressed, "coupler-point"),)
    spare = tuple(boss(at, turning, f"{name}-spare") for name, at in spare_holes(params))
    slots: tuple[Boss, ...] = ()
    for name, way in ways.items():
        if way.slot is not None:
            ends[name] = turning
            slots += way.slot.bosses(land_of(params, way.slot))
    links = {
        "crank": (boss(0, pressed, "A0"), boss(params.crank, ends["A"], "A")),
        "coupler": (*shown, *third, *spare, *slots),
    }
    end, one = boss(params.follower, ends["B"], "B"), boss(0, turning, "A0")
    if sides == 1:
        ground = (one, boss(params.ground, pressed, "B0"))
        return {"ground": ground, **links, "follower": (boss(0, turning, "B0"), end)}
    other = boss(params.ground, turning, "B0")
    return {"ground": (one,), "ground-2": (other,), **links, "follower": (boss(0, pressed, "B0"), end)}


def land_of(params: FourBarParams, slot: ArcSlot) -> float:
    """From a slot's centre line to the plate's edge: its rim, and room for the washer and a scale, mm."""
    clamp = clamp_of_design(params)
    return max(slot.width / 2 + params.rim, 0.0 if clamp is None else clamp.reach + WIDTH)


def raised(params: FourBarParams) -> dict[str, float]:
    """By how much crank and follower stand over their layers' undersides, for the heads of studs, mm."""
    height = HEAD_HEIGHT * params.pin_diameter
    return {
        link: height if slotted(params, name) else 0.0 for link, name in (("crank", "A"), ("follower", "B"))
    }
