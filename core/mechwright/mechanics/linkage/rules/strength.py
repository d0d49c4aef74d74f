"""Strength of pins, eyes, bushings, slots and guide pins, from the forces over a period.

:func:`strength_rules` gives a family its rules, whose codes begin with the word of its table.

The stresses are those of one design. Of a table each row that no rule before has forbidden is asked alone.
Only the plates beside the bores and the walls of slots have a stress that breaks them: other rules of this
module forbid nothing, and cost a table nothing.
"""

import math
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

import numpy as np

from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.finding import Change, Severity
from mechwright.contracts.materials import material
from mechwright.contracts.procedure import Note
from mechwright.contracts.rule_list import Rules, all_of
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL
from mechwright.mechanics.linkage.kinematics.forces import period_forces
from mechwright.mechanics.linkage.kinematics.pin_loads import PinLoads, PlateLoad, pin_loads
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.strength.allowed import PIN_BENDING, PIN_SHEAR, allowed
from mechwright.mechanics.strength.bearings_life import SINTERED_PRESSURE, bush_pressure
from mechwright.mechanics.strength.fastening import pin_shear, stud_bending
from mechwright.mechanics.strength.hertz import YIELD, contact_modulus, line_pressure
from mechwright.mechanics.strength.judging import SLOWEST, RowStressRule, Stress, Way
from mechwright.mechanics.strength.turning_pair import TurningPair, bush_stresses, eye_stresses

MILLI = 1e-3

T = TypeVar("T", bound=AnyPlanarTable)
Rule = DesignRule[AnyPlanarTable]
Fails = Failure[AnyPlanarTable]


def pairs_of(table: AnyPlanarTable) -> list[TurningPair]:
    """Every bore and slot on every pin as a bearing."""
    return [_pair(table, pin, load) for pin in pin_loads(table) for load in pin.loads]


def _pair(table: AnyPlanarTable, pin: PinLoads, load: PlateLoad) -> TurningPair:
    sizes = table.sizes
    several = len(pin.loads) > 1
    roller = f"roller {pin.pin.number} of {load.slide}" if pin.pin.number else f"the roller of {load.slide}"
    name = roller if load.slide else f"{pin.name} in {load.plate}" if several else pin.name
    arm = min(abs(face - load.height) for faces in pin.pressed.values() for face in faces)
    return TurningPair(
        name,
        np.nan_to_num(np.abs(load.force)),
        np.nan_to_num(load.turning),
        sizes.pin_diameter,
        arm,
        load.thickness,
        sizes.slot_width if load.slide else sizes.turning_bore,
        sizes.rim,
        sizes.material,
        sizes.bushing_wall > 0,
    )


def pin_stresses(m: AnyPlanarTable) -> list[Stress]:
    """Shear and bending of all pins but guide pins."""
    return [one for pin in pin_loads(m) if not pin.pin.number for one in _pin_stresses(m, pin)]


def _pin_stresses(table: AnyPlanarTable, pin: PinLoads) -> Iterator[Stress]:
    d = table.sizes.pin_diameter
    name = pin.pin.name.replace("-", " ") if pin.pin.number else pin.name
    shear, bending = pin_shear(pin.shear, d), stud_bending(pin.bending, 1.0, d)
    yield Stress(f"{name} is sheared with", shear, PIN_SHEAR["hardened, alternating"])
    yield Stress(f"{name} is bent with", bending, PIN_BENDING)


def eyes(m: AnyPlanarTable) -> list[Stress]:
    """The plates beside all bores, those that hold a pin among them."""
    bores = [_pair(m, pin, load) for pin in pin_loads(m) for load in pin.loads if not load.slide]
    return eye_stresses([*bores, *_pressed(m)])


def _pressed(table: AnyPlanarTable) -> Iterator[TurningPair]:
    """The bores into which pins are pressed."""
    sizes = table.sizes
    for pin in pin_loads(table):
        for plate, (low, high) in pin.pressed.items():
            force = np.nan_to_num(np.abs(pin.carried(plate)))
            name = f"{pin.pin.name.replace('-', ' ') if pin.pin.number else pin.name} in {plate}"
            d, rim = sizes.pin_diameter, sizes.rim
            yield TurningPair(name, force, np.zeros(1), d, 0.0, high - low, d, rim, sizes.material, False)


def bushings(m: AnyPlanarTable) -> list[Stress]:
    """What heats and wears the bushings in bores and slots."""
    return bush_stresses(pairs_of(m))


def guides(m: AnyPlanarTable) -> list[Stress]:
    """Walls of slots under their rollers, and guide pins."""
    found: list[Stress] = []
    sizes = m.sizes
    plate = material(sizes.material)
    roller = material(BUSHING_MATERIAL if sizes.bushing_wall > 0 else PIN_MATERIAL)
    modulus, yields = contact_modulus(plate, roller), YIELD * min(plate.strength, roller.strength)
    for pin in pin_loads(m):
        for load in pin.loads:
            if load.slide:
                pair = _pair(m, pin, load)
                pressure = line_pressure(pair.greatest, load.thickness, sizes.roller / 2, modulus)
                said = f"{pair.name} presses on its slot with"
                found.append(Stress(said, float(pressure), allowed(sizes.material).contact, yields))
        if pin.pin.number:
            found += _pin_stresses(m, pin)
    return found


def _load(m: AnyPlanarTable) -> str:
    most = max(pairs_of(m), key=lambda pair: pair.greatest, default=None)
    return "" if most is None else f"{most.greatest:.4g} N at {most.name.removeprefix('the ')}"


def _pin(m: AnyPlanarTable) -> Way:
    return Way("pin_diameter", m.given.pin_diameter)


def _plates(m: AnyPlanarTable) -> list[Way]:
    given = m.given
    return [Way("thickness", given.thickness), Way("ground_thickness", given.ground_thickness)]


def _slower(m: AnyPlanarTable) -> Way:
    return Way("speed", m.given.speed, up=False)


def most_pressed(m: AnyPlanarTable) -> tuple[TurningPair | None, float]:
    """The bearing with the greatest pressure on its projected area, and that, N/mm²."""
    pressures = [(bush_pressure(one.greatest, one.pin, one.width), one) for one in pairs_of(m)]
    pressure, pair = max(pressures, key=lambda one: one[0], default=(0.0, None))
    return pair, pressure


def _pressed_message(f: Fails) -> str:
    pair, pressure = most_pressed(f.m)
    assert pair is not None  # noqa: S101 - without a bearing there is no pressure
    return f"{pair.name} carries up to {pair.greatest:.4g} N, {pressure:.4g} N/mm² on its bearing"


def larger_bearings(given: Any, over: float, load: str = "") -> Iterator[Change]:
    """Larger bearings, or less of what they carry, which is so many times ``over`` its limit.

    Larger ones make heavier plates, so that more than the first may be needed. ``load`` is the parameter of
    the load, where one is enough.
    """
    for share in (1.05, 1.2, 1.5):
        much = over * share
        pin, plate = (_half(much * one) for one in (given.pin_diameter, given.thickness))
        yield {"parameters.pin_diameter": pin}
        yield {"parameters.thickness": plate}
        root = math.sqrt(much)
        yield {
            "parameters.pin_diameter": _half(root * given.pin_diameter),
            "parameters.thickness": _half(root * given.thickness),
        }
    for share in (1.05, 1.2):
        if load and (carried := getattr(given, load)) != 0:
            yield {f"parameters.{load}": float(f"{carried / over / share:.2g}")}
        if (speed := given.speed / math.sqrt(over) / share) >= SLOWEST:
            yield {"parameters.speed": float(f"{speed:.2g}")}


def _half(size: float) -> float:
    """The next half millimetre."""
    return math.ceil(2 * size) / 2


def _effort(m: AnyPlanarTable) -> float:
    """The drive's greatest effort: N m of one that turns, N of one that slides."""
    effort = float(np.nanmax(np.abs(period_forces(m)[1].drive)))
    return effort if m.driver_slides else effort * MILLI


def _forces_message(m: AnyPlanarTable) -> str:
    most = max(pairs_of(m), key=lambda pair: pair.greatest)
    shaking = float(np.nanmax(np.abs(period_forces(m)[1].shaking)))
    return (
        f"the drive needs up to {_effort(m):.4g} {'N' if m.driver_slides else 'N m'}; "
        f"{most.name} carries up to {most.greatest:.4g} N, and the moving masses shake the ground with up to "
        f"{shaking:.4g} N"
    )


def _note(code: str, unit: str, *, slides: bool) -> Note[AnyPlanarTable]:
    return Note(
        f"{code}.forces",
        _forces_message,
        _effort,
        unit,
        when=lambda m: m.driver_slides is slides and bool(pin_loads(m)),
    )


def strength_rules(kind: type[AnyPlanarTable]) -> Rules[Any]:
    """What pins, plates and bushings bear."""
    code = kind.code

    def rule(
        name: str,
        stresses: Callable[[AnyPlanarTable], list[Stress]],
        ways: Callable[[AnyPlanarTable], list[Way]],
        *,
        breaks: bool = False,
    ) -> RowStressRule[AnyPlanarTable]:
        return RowStressRule(f"{code}.{name}", stresses, ways, kind.of, _load, breaks=breaks)

    pin = rule("pin", pin_stresses, lambda m: [_pin(m), _slower(m)])
    eye = rule("eye", eyes, lambda m: [Way("rim", m.given.rim), *_plates(m), _slower(m)], breaks=True)
    bushing = rule("bushing", bushings, lambda m: [*_plates(m), _slower(m)])
    guide = rule(
        "guide",
        guides,
        lambda m: [_pin(m), Way("guide_length", m.given.guide_length), *_plates(m), _slower(m)],
        breaks=True,
    )
    bearing = Rule(
        f"{code}.bearing-pressure",
        "pin_diameter",
        _pressed_message,
        value=lambda m: most_pressed(m)[1],
        limit=SINTERED_PRESSURE,
        unit="N/mm^2",
        remedy="take thicker pins or plates, a smaller load or a lower speed",
        must_be="at most",
        severity=Severity.WARNING,
        proposed=lambda f: larger_bearings(f.m.given, f.value / f.limit),
    )
    return all_of(
        pin, eye, bushing, guide, bearing, *(_note(code, unit, slides=unit == "N") for unit in ("N*m", "N"))
    )
