"""What forbids each of many designs first: the errors of the checks, in their order, without their words."""

import math
from dataclasses import fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, Stage
from mechwright.contracts.by_arrays import Answer
from mechwright.geometry.keyway import LEAST_WIDTH
from mechwright.tolerances import exceeds, falls_short
from mechwright_geneva.assembly import BINDING, LEAST_GROOVE, LEAST_LOCK
from mechwright_geneva.body_checks import ROLLER_WALL
from mechwright_geneva.contact import carried, peak_of, sampled
from mechwright_geneva.feasible import ANGLE_SLACK, FLATTEST, LEAST_FLOOR, LENGTH_SLACK
from mechwright_geneva.limits import FINE_SAMPLES, Measures, bends, measure, sharpened
from mechwright_geneva.many import Mechanisms
from mechwright_geneva.openings import around, reaches, unfit
from mechwright_geneva.relief import drawn
from mechwright_geneva.sound import LEAST_LOCKED, LEAST_TIP
from mechwright_geneva.stud_checks import stresses_under

Places = NDArray[np.intp]


class Verdicts:
    """An answer that is told by columns of some designs.

    Parameters
    ----------
    answer
        Of all designs.
    places
        (m,) those that are looked at.
    """

    def __init__(self, answer: Answer, places: Places) -> None:
        self.answer = answer
        self.places = places

    def forbid(self, code: str, which: Any) -> None:
        """Say what forbids designs, given as a column (m, 1), of those nothing was said of so far."""
        held = np.broadcast_to(which, (self.places.size, 1))[:, 0]
        if held.any():
            self.answer.forbid(f"geneva.{code}" if "." not in code else code, held, self.places)

    @property
    def left(self) -> NDArray[np.bool_]:
        """Which of the designs (m,) nothing was said of so far."""
        left: NDArray[np.bool_] = self.answer.open[self.places]
        return left


def judge(m: Mechanisms, answer: Answer, stage: Stage) -> tuple[Mechanisms, Places]:
    """What forbids designs up to a stage; those of which all was asked, with discs, and their places."""
    told = Verdicts(answer, np.arange(len(m)))
    _feasibility(m, told, stage)
    if stage is Stage.MOTION:
        return m, told.places
    for check in (_bottom, _mouths, _walls, _openings, _lock, _hub, _loads):
        left = np.flatnonzero(told.left)
        m, told = m.rows(left), Verdicts(answer, told.places[left])
        if not left.size:
            return m, told.places
        m = check(m, told)
    if stage is Stage.MACHINING:
        for given, least in (
            (m.params.groove_clearance, LEAST_GROOVE),
            (m.params.lock_clearance, LEAST_LOCK),
        ):
            told.forbid("clearance", np.asarray(falls_short(given, least)) & np.asarray(given < BINDING))
    left = np.flatnonzero(told.left)
    return m.rows(left), told.places[left]


def _feasibility(m: Mechanisms, told: Verdicts, stage: Stage) -> None:
    """As :func:`mechwright_geneva.feasible.feasibility`."""
    params, parts = m.params, stage is not Stage.MOTION
    if m.straight:
        wanted = 90 - 180 / params.slots
        told.forbid("straight", np.abs(params.crank_half_angle - wanted) > ANGLE_SLACK)
        told.forbid("straight", np.asarray(params.offset_angle != 0))
    else:
        angles: tuple[Any, Any] = np.degrees(m.frame.entry_angle), np.degrees(m.crank_half)
        entry, half = angles
        reach = entry + half / 2
        far = np.asarray(exceeds(reach, 90 - FLATTEST))
        told.forbid("angles", far & ((reach == 90) | parts))
        none = ~far & falls_short(entry, FLATTEST)
        told.forbid("angles", none & ((entry <= 0) | parts))
    if m.table.common.centre_distance is not None:
        told.forbid("centre-distance", np.abs(m.axes - params.centre_distance) > LENGTH_SLACK)
    locked = 360 / params.rollers - 2 * np.degrees(m.crank_half)
    close = locked < math.degrees(LEAST_LOCKED) - ANGLE_SLACK
    told.forbid("rollers", close & ((locked < 0) | parts))
    if parts and params.slots_made != "through":
        told.forbid("floor", np.asarray(params.roller_length < LEAST_FLOOR))


def hub_of(m: Mechanisms) -> Any:
    """Radius about the wheel's axis that the slots must leave alone, mm."""
    return np.maximum(_wheel_reaches(m), m.params.hub_diameter / 2)


def _wheel_reaches(m: Mechanisms) -> Any:
    return reaches(np.asarray(m.params.bore), m.params.keyway_width, m.params.keyway_relief)


def _bottom(m: Mechanisms, told: Verdicts) -> Mechanisms:
    told.forbid("slot-bottom", falls_short(m.bottom - m.groove, hub_of(m) + m.params.least_wall))
    return m


def _mouths(m: Mechanisms, told: Verdicts) -> Mechanisms:
    """The web of straight slots; sign, mouth, and undercut as far as some samples show it, of curved ones."""
    if m.straight:
        web = 2 * (m.bottom * np.sin(m.wheel_half) - m.groove)
        told.forbid("web", falls_short(web, m.params.least_wall))
        return m
    told.forbid("offset-sign", (m.side == 0) | (m.frame.offset * m.side >= 0))
    mouth = -m.side * m.rim * np.sin(m.frame.offset) - m.groove * np.sin(m.wheel_half + m.crank_half)
    told.forbid("mouth", ~(mouth > 0))
    rows = np.flatnonzero(told.left)
    tight = np.zeros((len(m), 1))
    if rows.size:
        tight[rows] = m.rows(rows).each(_tightest)
    told.forbid("undercut", m.groove * tight >= 1 + SURE)
    return m


def _tightest(m: Mechanisms) -> Array:
    """Greatest curvature (m, 1) of the way among some samples, to either side."""
    tightest: Array = np.abs(bends(m.frame, m.law, np.ones((len(m), 1)))).max(axis=-1, keepdims=True)
    return tightest


def _walls(m: Mechanisms, told: Verdicts) -> Mechanisms:
    """Undercut, loop, tip, neck and web of curved slots."""
    if m.straight:
        return m
    groove, least = np.broadcast_to(m.groove, (len(m), 1)), m.params.least_wall
    found: Any = measure(m.frame, m.law, groove, FINE_SAMPLES)
    found = _decided(m, found, groove)
    island = found.island_limit[:, None]
    told.forbid("undercut", (groove >= island) | (groove >= found.hub_limit[:, None]))
    told.forbid("loop", ~(found.width[:, None] > 0))
    told.forbid("island-tip", falls_short(island - groove, LEAST_TIP))
    told.forbid("island", falls_short(2 * found.neck[:, None], least))
    told.forbid("web", falls_short(found.web[:, None], least))
    return m.with_columns(nearest=found.nearest[:, None])


SURE = 1e-9
"""Share by which a wall is undercut beyond rounding."""


def _decided(m: Mechanisms, found: Measures, groove: Array) -> Measures:
    """The same with critical radii to rounding where one is next to what it is compared with."""
    island, hub, half = found.island_limit, found.hub_limit, groove[:, 0]
    close = (np.abs(island - half) < NEXT * island) | (np.abs(island - half - LEAST_TIP) < NEXT * island)
    rows = np.flatnonzero(close | (np.abs(hub - half) < NEXT * hub))
    if not rows.size:
        return found
    part = Measures(*(getattr(found, field.name)[rows] for field in fields(Measures)))
    sharp = sharpened(part, m.frame.rows(rows), m.law)
    limits = island.copy(), hub.copy()
    limits[0][rows], limits[1][rows] = sharp.island_limit, sharp.hub_limit
    return replace(found, island_limit=limits[0], hub_limit=limits[1])


NEXT = 0.01
"""Share of a critical radius by which its samples are surely nearer to it: they are within 1e-9."""


def _openings(m: Mechanisms, told: Verdicts) -> Mechanisms:
    """Construction, openings and driver."""
    params = m.params
    told.forbid("islands-loose", params.slots_made == ("backed" if m.straight else "through"))
    driver = np.asarray(params.driver_bore), params.driver_keyway_width, params.keyway_relief
    for opening in ((np.asarray(params.bore), params.keyway_width, params.keyway_relief), driver):
        for code, which in unfit(*opening):
            told.forbid(code, which)
    for size in (params.keyway_relief, params.fixing):
        told.forbid("bore.size", (np.asarray(size) > 0) & (np.asarray(size) < LEAST_WIDTH))
    inner, outer = reaches(*driver), m.axes - m.rim - params.lock_clearance
    told.forbid("driver", falls_short(outer - inner, around(0.0, params.least_wall, params.fixing)))
    return m


def _lock(m: Mechanisms, told: Verdicts) -> Mechanisms:
    """The locking disc."""
    m = m.with_columns(greatest_lock=m.each(Mechanisms.locked))
    params = m.params
    told.forbid("lock", falls_short(m.greatest_lock, m.least_lock))
    told.forbid("horn", falls_short(m.nearest - m.groove - m.arc, params.least_wall))
    told.forbid("lock", falls_short(m.lock, m.least_lock))
    cosine = (m.axes**2 + m.rim**2 - m.arc**2) / (2 * m.axes * m.rim)
    told.answer.doubt(~(np.abs(cosine) < 1)[:, 0], told.places)
    told.forbid("horn", (m.wheel_half - np.arccos(cosine)) * m.rim < params.least_wall / 2)
    return m


def _hub(m: Mechanisms, told: Verdicts) -> Mechanisms:
    """Whether the disc can be drawn; hub and pin."""
    params = m.params
    locks = m.each(drawn)
    told.forbid("lock", (locks < 0)[:, None])
    told.answer.doubt(locks == 0, told.places)
    told.forbid("hub", falls_short(m.axes - m.arc - hub_of(m), params.least_wall))
    ring, wanted = params.hub_diameter / 2 - _wheel_reaches(m), around(0.0, params.least_wall, params.fixing)
    told.forbid("hub", np.asarray(params.hub_diameter > 0) & falls_short(ring, wanted))
    told.forbid("pin", exceeds(params.pin_diameter, 2 * m.roller * (1 - ROLLER_WALL)))
    return m


def _loads(m: Mechanisms, told: Verdicts) -> Mechanisms:
    """The middle of the stroke under a torque, and the studs."""
    params = m.params
    found = m.each(force_and_carried)
    if not m.straight and np.any(np.asarray(params.load_torque) > 0):
        work = params.load_torque * found[:, 1:]
        ratio = m.wheel_half / m.crank_half * float(m.law.at(0.5).v)
        energy = params.load_inertia * (ratio * m.driver.speed) ** 2 / 2
        told.forbid("singular", np.asarray(params.load_torque > 0) & (work >= energy))
    m = m.with_columns(force=found[:, :1])
    force: Any = m.params.force  # type: ignore[attr-defined]
    for one in stresses_under(m.params, force):
        fails = one.breaks is not None and exceeds(one.value, one.breaks)
        told.forbid("stud", exceeds(one.value, one.limit) & np.asarray(fails))
    return m


def force_and_carried(m: Mechanisms) -> Array:
    """Greatest contact force, N, and angle of the wheel in the blocked zone, rad, (m, 2)."""
    run, ((stroke, found),) = sampled(m)
    force = peak_of(m, found, stroke, "force")[0]
    zone = carried(run, found)
    return np.concatenate((force, np.broadcast_to(zone[:, None], force.shape)), axis=-1)
