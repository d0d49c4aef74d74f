"""The joints: what is pressed into which link, what turns in which, and the openings that this gives plates.

Shafts are pressed into crank and arm and turn in the ground plate; their gears hang below it. Pin B1 is
pressed into the arm. Where A or C has a hole for each phase, its pin is pressed into crank or rocker and
turns in the coupler; where it has a slot, it is a stud that is clamped in the coupler and turns in them.
"""

from dataclasses import dataclass

from mechwright import GeometryError, Loop
from mechwright.mechanics.linkage import Boss
from mechwright.mechanics.linkage.scale import WIDTH
from mechwright.mechanics.linkage.slots import Setting
from mechwright_five_bar.kinematics.phases import set_joints
from mechwright_five_bar.kinematics.train import train_of
from mechwright_five_bar.parameters import FiveBarParams
from mechwright_five_bar.parts.hardware import clamp_of_design, head_of, running_bore, turning_bore
from mechwright_five_bar.parts.hub import Hub, hub_of

LINKS = ("crank", "arm", "rocker", "coupler")


@dataclass(frozen=True)
class Joint:
    """A pin or shaft.

    Parameters
    ----------
    body, place
        The body on whose axis it stands, and where in its frame, x + i y, mm.
    plates
        The plates it joins.
    head
        Whether it has a head on top; without it ends flush with its plates.
    stud
        Whether it is a stud, clamped in the coupler.
    """

    body: str
    place: complex
    plates: tuple[str, ...]
    head: bool = True
    stud: bool = False


def slotted(params: FiveBarParams, name: str) -> bool:
    """Whether joint A or C is set in a slot."""
    return set_joints(params)[name].slot is not None


def hub_or_none(params: FiveBarParams) -> Hub | None:
    """The clamp of the arm's gear; None also where none can be made."""
    try:
        return hub_of(params)
    except GeometryError:
        return None


def joints_of(params: FiveBarParams) -> dict[str, Joint]:
    """Shafts and pins by name; ``params`` shows its first phase."""
    below = ("clamp", "wheel") if hub_or_none(params) is not None else ("wheel",)
    a, c = slotted(params, "A"), slotted(params, "C")
    found = {
        "shaft-a0": Joint("crank", 0j, ("pinion", "ground", "crank"), head=False),
        "shaft-b0": Joint("arm", 0j, (*below, "ground", "arm"), head=False),
        "pin-a": Joint("crank", complex(params.crank), ("crank", "coupler"), not a, a),
        "pin-b1": Joint("arm", complex(params.arm), ("arm", "rocker")),
        "pin-c": Joint("rocker", complex(params.rocker), ("rocker", "coupler"), not c, c),
    }
    if params.idler_teeth:
        place = train_of(params).places["idler"]
        found["pin-idler"] = Joint("ground", place, ("idler", "ground"), head=False)
    return found


def bosses_of(params: FiveBarParams) -> dict[str, tuple[Boss, ...]]:
    """The round ends of links, in their frames; those along a slot have no bore."""
    pressed, turning = params.pin_diameter, turning_bore(params)

    def boss(x: complex, bore: float, tag: str) -> Boss:
        return Boss(complex(x), bore / 2 + params.rim, bore, tag)

    coupler: list[Boss] = [boss(params.coupler_point, pressed, "point")]
    for name, one in set_joints(params).items():
        if one.slot is None:
            coupler += [boss(at, turning, name) for at in one.places]
        else:
            coupler += one.slot.bosses(land_of(params, one))
    ends = {name: turning if slotted(params, name) else pressed for name in "AC"}
    return {
        "crank": (boss(0, pressed, "A0"), boss(params.crank, ends["A"], "A")),
        "arm": (boss(0, pressed, "B0"), boss(params.arm, pressed, "B1")),
        "rocker": (boss(0, turning, "B1"), boss(params.rocker, ends["C"], "C")),
        "coupler": tuple(coupler),
    }


def land_of(params: FiveBarParams, one: Setting) -> float:
    """From a slot's centre line to the plate's edge: its rim, and room for the washer and a scale, mm."""
    clamp = clamp_of_design(params)
    width = one.slot.width if one.slot is not None else 0.0
    return max(width / 2 + params.rim, 0.0 if clamp is None else clamp.reach + WIDTH)


def slot_loops(params: FiveBarParams) -> tuple[Loop, ...]:
    """The walls of the coupler's slots."""
    return tuple(
        one.slot.loop(f"{name}-slot") for name, one in set_joints(params).items() if one.slot is not None
    )


def raised(params: FiveBarParams) -> dict[str, float]:
    """By how much crank and rocker stand over their layers' undersides: the heads of studs lie below, mm."""
    height = head_of(params)[1]
    return {
        link: height if slotted(params, name) else 0.0 for link, name in (("crank", "A"), ("rocker", "C"))
    }


def running(params: FiveBarParams) -> float:
    """Of the wheel's bore where it is clamped, mm."""
    return running_bore(params) if hub_or_none(params) is not None else params.pin_diameter
