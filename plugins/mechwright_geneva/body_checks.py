"""Checks of everything but the slots: construction, locking, hub, driver, stack."""

import math
from collections.abc import Iterator

from mechwright import Finding, GeometryError
from mechwright.contracts.finding import errors
from mechwright.tolerances import exceeds, falls_short
from mechwright_geneva.counterbore import counterbore_findings
from mechwright_geneva.crank import boss_radius
from mechwright_geneva.fixings import driver_room, greatest_island_dowel, island_places, web_place
from mechwright_geneva.mechanism import Mechanism
from mechwright_geneva.openings import driver_radius, hub_radius, opening_findings, reach, wheel_opening
from mechwright_geneva.relief import lock_loop
from mechwright_geneva.sound import LEAST_BITE
from mechwright_geneva.wheel import Wheel

SIZING = ("entry_radius", "centre_distance", "crank_half_angle", "offset_angle")
"""Keys that tell how much room the driver has."""

ROLLER_WALL = 0.1
"""Least wall of a roller about its pin, in roller radii: what the smallest needle rollers have."""


def body_findings(m: Mechanism) -> Iterator[Finding]:
    """Construction, openings, locking, driver."""
    found = [*_construction(m), *opening_findings(m.params)]
    if not errors(found):
        found += _driver(m)
    if not errors(found):
        found += [*_lock(m), *_hub(m), *_pin(m), *counterbore_findings(m)]
    yield from found


def _construction(m: Mechanism) -> Iterator[Finding]:
    if not m.straight and m.params.slots_made == "through":
        yield Finding.error(
            "geneva.islands-loose",
            "construction",
            f"slots that are cut through set their islands free: {m.slots} pieces fall out of the wheel",
            remedy='use construction = "blind" for grooves with a floor, or "backed" for islands on a plate',
        )
    if m.straight and m.params.slots_made == "backed":
        yield Finding.error(
            "geneva.islands-loose",
            "construction",
            "straight slots have no islands that a backing plate could carry",
            remedy='use construction = "through" or "blind"',
        )


def _lock(m: Mechanism) -> Iterator[Finding]:
    params = m.params
    least, most = m.least_lock, m.greatest_lock
    horn = m.nearest - m.groove - m.arc
    if falls_short(most, least):
        yield Finding.error(
            "geneva.lock",
            "lock_radius" if params.lock_radius else "least_wall",
            f"a locking disc needs {least:.3f} mm to reach {LEAST_BITE:g} mm into the wheel, and at most "
            f"{most:.3f} mm leave horns of {params.least_wall:g} mm beside the slots",
            most,
            least,
            "mm",
        )
        return
    if falls_short(horn, params.least_wall):
        yield Finding.error(
            "geneva.horn",
            "lock_radius",
            f"the horns between concave arcs and slots are {horn:.3f} mm thick",
            horn,
            params.least_wall,
            "mm",
            f"make lock_radius at most {_down(most)}, or leave it out",
        )
        return
    if falls_short(m.lock, least):
        yield Finding.error(
            "geneva.lock",
            "lock_radius",
            f"a locking disc of {m.lock:g} mm reaches {m.lock - m.axes + m.rim:.3f} mm into the wheel",
            m.lock,
            least,
            "mm",
            f"make lock_radius at least {math.ceil(least * 100) / 100:g}, or leave it out",
        )
        return
    bites = m.wheel_half - Wheel(m).horn_angle
    if bites * m.rim < params.least_wall / 2:
        yield Finding.error(
            "geneva.horn",
            "lock_radius",
            "neighbouring concave arcs leave no rim between them",
            2 * bites * m.rim,
            params.least_wall,
            "mm",
            "leave lock_radius out" if params.lock_radius else "",
        )
        return
    try:
        lock_loop(m)
    except GeometryError as error:
        yield Finding.error(
            "geneva.lock",
            "lock_radius",
            f"no locking disc: {error}",
            m.lock,
            most,
            "mm",
            f"make lock_radius at most {_down(most)}, or leave it out" if most < m.lock else "",
        )


def _hub(m: Mechanism) -> Iterator[Finding]:
    params = m.params
    room = m.axes - m.arc - hub_radius(params)
    if falls_short(room, params.least_wall):
        yield Finding.error(
            "geneva.hub",
            "bore" if params.hub_diameter / 2 <= reach(wheel_opening(params)) else "hub_diameter",
            f"{room:.3f} mm stay between hub or bore and the concave arcs",
            room,
            params.least_wall,
            "mm",
            "make bore and hub smaller, or lock_radius smaller",
        )
    if params.hub_diameter > 0:
        inside = params.hub_diameter / 2 - reach(wheel_opening(params))
        wanted = 2 * params.least_wall + params.fixing if params.fixing else params.least_wall
        if falls_short(inside, wanted):
            yield Finding.error(
                "geneva.hub",
                "hub_diameter",
                f"the hub plate is a ring of {inside:.3f} mm; its dowels and walls need {wanted:.3f} mm",
                inside,
                wanted,
                "mm",
                "make hub_diameter at least "
                f"{math.ceil((params.hub_diameter + 2 * (wanted - inside)) * 10) / 10:g}, or 0 for none",
            )
    if m.params.slots_made == "backed" and params.fixing > 0:
        yield from _dowels(m)


def _dowels(m: Mechanism) -> Iterator[Finding]:
    fixing, least = m.params.fixing, m.params.least_wall
    if len(island_places(m, fixing)) < 2:
        most = greatest_island_dowel(m)
        yield Finding.error(
            "geneva.fixing",
            "fixing",
            f"an island has no room for two dowels of {fixing:g} mm",
            fixing,
            most,
            "mm",
            f"make fixing at most {most:g}"
            if most
            else 'make least_wall smaller, or use construction = "blind"',
        )
    _, room = web_place(m)
    if falls_short(room, fixing / 2 + least):
        yield Finding.error(
            "geneva.fixing",
            "fixing",
            f"the webs between slots have no room for dowels of {fixing:g} mm",
            fixing,
            max(0.0, 2 * (room - least)),
            "mm",
            f"make fixing at most {max(0.0, math.floor(20 * (room - least)) / 10):g}",
        )


def _pin(m: Mechanism) -> Iterator[Finding]:
    most = 2 * m.roller * (1 - ROLLER_WALL)
    if exceeds(m.params.pin_diameter, most):
        yield Finding.error(
            "geneva.pin",
            "pin_diameter",
            f"a pin of {m.params.pin_diameter:g} mm leaves nothing of a roller of {2 * m.roller:g} mm",
            m.params.pin_diameter,
            most,
            "mm",
            f"make pin_diameter at most {_down(most)}",
        )


def _driver(m: Mechanism) -> Iterator[Finding]:
    params = m.params
    inner, outer = driver_room(m)
    wanted = driver_radius(0.0, params.least_wall, params.fixing)
    if falls_short(outer - inner, wanted):
        blame = "driver_bore" if params.fixing == 0 or outer - inner < params.least_wall else "fixing"
        given = [key for key in SIZING if key not in params.left_out]
        if blame in params.left_out and given:
            blame = given[0]
        cures = []
        dowel = outer - inner - 2 * params.least_wall
        if params.fixing > 0 and dowel >= 1:
            cures.append(f"make fixing at most {math.floor(dowel * 10) / 10:g}")
        elif params.fixing > 0 and outer - inner >= params.least_wall:
            cures.append("set fixing to 0")
        bore = 2 * (outer - wanted)
        if bore >= 1 and params.driver_keyway_width == 0 and "driver_bore" not in params.left_out:
            cures.append(f"make driver_bore at most {math.floor(bore * 10) / 10:g}")
        yield Finding.error(
            "geneva.driver",
            blame,
            f"the relief leaves {max(0.0, outer):.3f} mm of the locking disc about the crank's axis: with an "
            f"opening that reaches {inner:.3f} mm, {outer - inner:.3f} mm stay for walls and dowels",
            outer - inner,
            wanted,
            "mm",
            ", or ".join(cures),
        )
    overhang = m.crank + boss_radius(m) - (m.axes - reach(wheel_opening(params)))
    if overhang > 0:
        yield Finding.note(
            "geneva.shaft",
            f"the crank passes {overhang:.2f} mm over the wheel's bore: its shaft ends below "
            f"{params.thickness + params.axial_gap:g} mm",
            overhang,
            "mm",
        )


def _down(length: float) -> str:
    """A length in hundredths, not rounded up."""
    return f"{math.floor(length * 100) / 100:g}"
