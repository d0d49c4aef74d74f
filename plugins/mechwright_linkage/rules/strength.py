"""Strength of pins, eyes, bushings, slots and guide pins, from the forces over a period.

The stresses are those of one design. Of a table each row that no rule before has forbidden is asked alone.
Only the plates beside the bores and the walls of slots have a stress that breaks them: other rules of this
module forbid nothing, and cost a table nothing.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright import Severity, Stage, material
from mechwright.contracts.design_rule import DesignRule, Failure, Note
from mechwright.contracts.finding import Change
from mechwright.contracts.rule_list import all_of
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL
from mechwright.mechanics.strength.allowed import PIN_BENDING, PIN_SHEAR, allowed
from mechwright.mechanics.strength.bearings_life import SINTERED_PRESSURE, bush_pressure
from mechwright.mechanics.strength.fastening import pin_shear, stud_bending
from mechwright.mechanics.strength.hertz import YIELD, contact_modulus, line_pressure
from mechwright.mechanics.strength.judging import SLOWEST, Stress, StressRule, Way, worst
from mechwright.mechanics.strength.turning_pair import TurningPair, bush_stresses, eye_stresses
from mechwright_linkage.kinematics.forces import period_forces
from mechwright_linkage.kinematics.linkage_table import LinkageTable, table_of
from mechwright_linkage.kinematics.pin_loads import PinLoads, PlateLoad, pin_loads
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.parts.design import sizes_of

MILLI = 1e-3

Rule = DesignRule[LinkageTable]
Fails = Failure[LinkageTable]


@dataclass(frozen=True)
class RowStressRule(StressRule[LinkageTable]):
    """A rule of stresses that are those of one design; ``breaks`` is whether one of them breaks a part."""

    breaks: bool = False

    def forbids(self, table: LinkageTable, stage: Stage) -> NDArray[np.bool_] | None:
        """Give the designs (n,) in which a stress breaks a part, found row by row; None where none can."""
        if not self.breaks or self.stage.is_after(stage):
            return None
        return np.array([self._fails(table.row(place)) for place in range(table.size)], bool)

    def _fails(self, m: LinkageTable) -> bool:
        found = self.stresses(m)
        return bool(found) and worst(found).severity is Severity.ERROR


def pairs_of(params: LinkageParams) -> list[TurningPair]:
    """Every bore and slot on every pin as a bearing."""
    return [_pair(params, pin, load) for pin in pin_loads(params) for load in pin.loads]


def _pair(params: LinkageParams, pin: PinLoads, load: PlateLoad) -> TurningPair:
    sizes = sizes_of(params)
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


def pin_stresses(m: LinkageTable) -> list[Stress]:
    """Shear and bending of all pins but guide pins."""
    return [one for pin in pin_loads(m.given) if not pin.pin.number for one in _pin_stresses(m.given, pin)]


def _pin_stresses(params: LinkageParams, pin: PinLoads) -> Iterator[Stress]:
    d = params.pin_diameter
    name = pin.pin.name.replace("-", " ") if pin.pin.number else pin.name
    shear, bending = pin_shear(pin.shear, d), stud_bending(pin.bending, 1.0, d)
    yield Stress(f"{name} is sheared with", shear, PIN_SHEAR["hardened, alternating"])
    yield Stress(f"{name} is bent with", bending, PIN_BENDING)


def eyes(m: LinkageTable) -> list[Stress]:
    """The plates beside all bores, those that hold a pin among them."""
    params = m.given
    bores = [_pair(params, pin, load) for pin in pin_loads(params) for load in pin.loads if not load.slide]
    return eye_stresses([*bores, *_pressed(params)])


def _pressed(params: LinkageParams) -> Iterator[TurningPair]:
    """The bores into which pins are pressed."""
    sizes = sizes_of(params)
    for pin in pin_loads(params):
        for plate, (low, high) in pin.pressed.items():
            force = np.nan_to_num(np.abs(pin.carried(plate)))
            name = f"{pin.pin.name.replace('-', ' ') if pin.pin.number else pin.name} in {plate}"
            d, rim = sizes.pin_diameter, sizes.rim
            yield TurningPair(name, force, np.zeros(1), d, 0.0, high - low, d, rim, sizes.material, False)


def bushings(m: LinkageTable) -> list[Stress]:
    """What heats and wears the bushings in bores and slots."""
    return bush_stresses(pairs_of(m.given))


def guides(m: LinkageTable) -> list[Stress]:
    """Walls of slots under their rollers, and guide pins."""
    params, found = m.given, []
    sizes = sizes_of(params)
    plate = material(sizes.material)
    roller = material(BUSHING_MATERIAL if sizes.bushing_wall > 0 else PIN_MATERIAL)
    modulus, yields = contact_modulus(plate, roller), YIELD * min(plate.strength, roller.strength)
    for pin in pin_loads(params):
        for load in pin.loads:
            if load.slide:
                pair = _pair(params, pin, load)
                pressure = line_pressure(pair.greatest, load.thickness, sizes.roller / 2, modulus)
                said = f"{pair.name} presses on its slot with"
                found.append(Stress(said, float(pressure), allowed(sizes.material).contact, yields))
        if pin.pin.number:
            found += _pin_stresses(params, pin)
    return found


def _load(m: LinkageTable) -> str:
    most = max(pairs_of(m.given), key=lambda pair: pair.greatest, default=None)
    return "" if most is None else f"{most.greatest:.4g} N at {most.name.removeprefix('the ')}"


def _pin(m: LinkageTable) -> Way:
    return Way("pin_diameter", m.given.pin_diameter)


def _plates(m: LinkageTable) -> list[Way]:
    given = m.given
    return [Way("thickness", given.thickness), Way("ground_thickness", given.ground_thickness)]


def _slower(m: LinkageTable) -> Way:
    return Way("speed", m.given.speed, up=False)


def _again(params: LinkageParams) -> LinkageTable:
    return table_of(params)


PIN = RowStressRule("linkage.pin", pin_stresses, lambda m: [_pin(m), _slower(m)], _again, _load)
EYE = RowStressRule(
    "linkage.eye",
    eyes,
    lambda m: [Way("rim", m.given.rim), *_plates(m), _slower(m)],
    _again,
    _load,
    breaks=True,
)
BUSHING = RowStressRule("linkage.bushing", bushings, lambda m: [*_plates(m), _slower(m)], _again, _load)
GUIDE = RowStressRule(
    "linkage.guide",
    guides,
    lambda m: [_pin(m), Way("guide_length", m.given.guide_length), *_plates(m), _slower(m)],
    _again,
    _load,
    breaks=True,
)


def most_pressed(m: LinkageTable) -> tuple[TurningPair | None, float]:
    """The bearing with the greatest pressure on its projected area, and that, N/mm²."""
    pressures = [(bush_pressure(one.greatest, one.pin, one.width), one) for one in pairs_of(m.given)]
    pressure, pair = max(pressures, key=lambda one: one[0], default=(0.0, None))
    return pair, pressure


def _pressed_message(f: Fails) -> str:
    pair, pressure = most_pressed(f.m)
    assert pair is not None  # noqa: S101 - without a bearing there is no pressure
    return f"{pair.name} carries up to {pair.greatest:.4g} N, {pressure:.4g} N/mm² on its bearing"


def _larger(f: Fails) -> Iterator[Change]:
    """Larger bearings, or less inertia; larger ones make heavier plates, so that more may be needed."""
    given, over = f.m.given, f.value / f.limit
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
        if (speed := given.speed / math.sqrt(over) / share) >= SLOWEST:
            yield {"parameters.speed": float(f"{speed:.2g}")}


def _half(size: float) -> float:
    """The next half millimetre."""
    return math.ceil(2 * size) / 2


BEARING = Rule(
    "linkage.bearing-pressure",
    "pin_diameter",
    _pressed_message,
    value=lambda m: most_pressed(m)[1],
    limit=SINTERED_PRESSURE,
    unit="N/mm^2",
    remedy="take thicker pins or plates, a smaller load or a lower speed",
    must_be="at most",
    severity=Severity.WARNING,
    proposed=_larger,
)


def _effort(m: LinkageTable) -> float:
    """The drive's greatest effort: N m of one that turns, N of one that slides."""
    effort = float(np.nanmax(np.abs(period_forces(m.given)[1].drive)))
    return effort if m.driver_slides else effort * MILLI


def _forces_message(m: LinkageTable) -> str:
    most = max(pairs_of(m.given), key=lambda pair: pair.greatest)
    shaking = float(np.nanmax(np.abs(period_forces(m.given)[1].shaking)))
    return (
        f"the drive needs up to {_effort(m):.4g} {'N' if m.driver_slides else 'N m'}; "
        f"{most.name} carries up to {most.greatest:.4g} N, and the moving masses shake the ground with up to "
        f"{shaking:.4g} N"
    )


def _note(unit: str, *, slides: bool) -> Note[LinkageTable]:
    return Note(
        "linkage.forces",
        _forces_message,
        _effort,
        unit,
        when=lambda m: m.driver_slides is slides and bool(pin_loads(m.given)),
    )


STRENGTH = all_of(PIN, EYE, BUSHING, GUIDE, BEARING, _note("N*m", slides=False), _note("N", slides=True))
"""What pins, plates and bushings bear."""
