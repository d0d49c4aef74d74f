"""What wheel and driver as their programs leave them do: roller in its slot, error of the wheel, the lock."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from mechwright import Array, AsMade, Finding, MadeCurve, MadeFigure, MadePart, Severity, Stage
from mechwright.tolerances import OFF_CENTRE
from mechwright_geneva.as_made.lock import Lock
from mechwright_geneva.as_made.play import Play, Room, drawn_room, made_room
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.kinematics.geometry import Points, Stroke
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.rules.clearances import LEAST_GROOVE, LEAST_LOCK

SAMPLES = 49
"""Positions of a stroke, both ends and the middle among them."""
MICRO = 1e6


@dataclass(frozen=True, eq=False)
class Made:
    """The parts of one mechanism as made."""

    m: Mechanism
    parts: Mapping[str, Sequence[MadePart]]

    @cached_property
    def stroke(self) -> Stroke:
        """The exact stroke at the positions."""
        return self.m.stroke(np.linspace(0, 1, SAMPLES))

    @property
    def wheel(self) -> MadePart:
        """The wheel."""
        return self.parts["wheel"][0]

    @property
    def corridor(self) -> float:
        """How far a wall of the wheel may be off its place, mm."""
        return self.wheel.corridor

    @cached_property
    def room(self) -> Room:
        """The room beside all walls as made, about the middle of the wheel's bore."""
        x, y = self.wheel.bore_middle(self.m.params.bore)
        return made_room(shapely.affinity.translate(self._beside(planned=False), -x, -y), self.m.roller)

    def _beside(self, *, planned: bool) -> shapely.Geometry:
        """What stands beside the rollers."""
        pieces = [self.wheel.section(self.m.params.groove_depth / 2).shape(planned=planned)]
        islands = self.parts.get("island", ())
        for k in range(self.m.slots if islands else 0):
            island = islands[min(k, len(islands) - 1)].outline.shape(planned=planned)
            turn = 2 * k * self.m.wheel_half
            pieces.append(shapely.affinity.rotate(island, turn, origin=(0, 0), use_radians=True))
        return shapely.union_all(pieces)

    @cached_property
    def roller_off(self) -> Points:
        """How far the middle of roller 0 is off its place, (n,), mm, fixed frame: pin to shaft as bored."""
        params, crank = self.m.params, self.parts.get("crank", ())
        pin = crank[0].hole_at(self.m.crank, 0.0, params.pin_diameter) if crank else None
        if pin is None:
            return np.zeros(SAMPLES, dtype=complex)
        x, y = crank[0].bore_middle(params.driver_bore)
        off = complex(pin.x - x - self.m.crank, pin.y - y)
        moved: Points = -off * np.exp(1j * self.stroke.phi)
        return moved

    @cached_property
    def apart(self) -> list[Play]:
        """The play in slot 0 with the axes too near, and too far apart."""
        return [self.play(0, off) for off in (-OFF_CENTRE, OFF_CENTRE)]

    def planned(self) -> Play:
        """The play in slot 0 if every wall stood where its cutters were to make it."""
        return Play.of(self.stroke, made_room(self._beside(planned=True), self.m.roller))

    def play(self, slot: int = 0, off_centre: float = 0.0) -> Play:
        """The play in one slot, with the crank's axis farther away by ``off_centre``, mm."""
        to_slot = np.exp(2j * slot * self.m.wheel_half)
        return Play.of(self.stroke, lambda points: self.room(points * to_slot), self.roller_off + off_centre)


def as_made(params: GenevaParams, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge a mechanism whose plates are as made."""
    if not {"wheel", "locking-disc"} <= set(made):
        return AsMade()
    m = mechanism_of(params)
    one = Made(m, made)
    lock = Lock.of(m, made["wheel"][0], made["locking-disc"][0])
    slots = [one.play(slot) for slot in range(m.slots)]
    figures, curve = _motion(one, slots)
    findings = (*_binding(one, slots), *_seizing(m, lock))
    return AsMade((*figures, *_locked(m, lock, slots)), (curve,), findings)


def _turn(name: str, title: str, rule: str, design: float | None, *values: float) -> MadeFigure:
    """The figure of an angle, rad: as drawn, as made, and its least and greatest value."""
    drawn = None if design is None else design * MICRO
    found, low, high = (value * MICRO for value in values)
    return MadeFigure(name, title, "µrad", None, drawn, found, low, high, rule)


def _motion(one: Made, slots: list[Play]) -> tuple[list[MadeFigure], MadeCurve]:
    """Room and play of the roller, and how far the wheel is off where it drives."""
    m, corridor, half = one.m, one.corridor, one.m.params.groove_clearance / 2
    drawn, planned = [Play.of(one.stroke, drawn_room(m, half)).turns()], one.planned().turns()
    nominal = [found.turns() for found in slots]
    tight, loose = ([slots[0].turns(more)] for more in (-corridor, corridor))
    bounds = [found.turns(more) for found in one.apart for more in (-corridor, corridor)]

    def worst(turns: list[tuple[Array, Array]]) -> Array:
        return np.asarray(np.abs(turns).max(axis=(0, 1)))

    def entry(turns: list[tuple[Array, Array]]) -> list[float]:
        return [float(ahead[0] + behind[0]) for ahead, behind in turns]

    errors = [worst(turns) for turns in (drawn, nominal, tight, [*tight, *loose, *bounds])]
    room, ends = np.stack([found.here for found in slots]), entry([*tight, *loose])
    least, most = float(room.min()), float(room.max())
    singular = "" if m.straight else "; at mid stroke √(2 h / (ρ² (κ + 1/ρ))): no tolerance cures it"
    figures = [
        MadeFigure(
            "slot.room",
            "least room of a roller in its slot, on either side",
            "mm",
            0.0,
            half,
            least,
            least - corridor,
            most + corridor,
            "half the groove clearance less what stays on each wall",
        ),
        _turn(
            "slot.play.entry",
            "play of the wheel as a roller enters",
            "as far as the walls reach; between two endless walls 2 h / lever",
            *(*entry([planned]), max(entry(nominal)), min(ends), max(ends)),
        ),
        _turn(
            "wheel.error",
            "greatest error of the wheel in motion",
            f"turned until the roller meets a wall, axes ± {OFF_CENTRE:g} mm{singular}",
            *(float(error.max()) for error in errors),
        ),
    ]
    curve = MadeCurve(
        "Error of the wheel in motion",
        "crank from the start of the stroke, degrees",
        "µrad",
        np.degrees(m.crank_half - one.stroke.phi),
        {"as drawn": errors[0] * MICRO, "as made": errors[1] * MICRO, "in the worst case": errors[3] * MICRO},
    )
    return figures, curve


def _locked(m: Mechanism, lock: Lock, slots: list[Play]) -> list[MadeFigure]:
    """The lock: clearance and play in dwell, and what it takes from the play as it closes."""
    offs, walls = (-OFF_CENTRE, OFF_CENTRE), (-lock.corridor, lock.corridor)
    ends = [lock.play(off, more) for off in offs for more in walls]
    found, low, high = lock.play(), min(ends), max(ends)
    entry = max(float(max(turn[0], turn[-1])) for slot in slots for turn in slot.turns())
    return [
        MadeFigure(
            "lock.clearance",
            "least clearance of disc and wheel",
            "mm",
            OFF_CENTRE,
            m.params.lock_clearance,
            lock.least,
            lock.least - lock.corridor,
            lock.least + lock.corridor,
            "d_wheel + d_disc + what the axes may be off has to find room in it",
        ),
        _turn(
            "lock.play",
            "turn of the locked wheel either way",
            "ψ_L - acos((a² + l² - R_L²) / (2 a l))",
            *(m.lock_play(m.arc, m.lock), found, low, high),
        ),
        _turn(
            "lock.pulls",
            "turn that the lock takes back as it closes",
            "play in the mouth of the slot over that of the lock",
            None,
            *(max(0.0, entry - play) for play in (found, high, low)),
        ),
    ]


def _binding(one: Made, slots: list[Play]) -> list[Finding]:
    """Whether a roller binds with the axes in place, and with them off."""
    for plays, severity in ((slots, Severity.ERROR), (one.apart, Severity.WARNING)):
        room = [float(found.here.min()) - one.corridor for found in plays]
        worst = int(np.argmin(room))
        if room[worst] > 0:
            continue
        given = one.m.params.groove_clearance
        at = one.m.crank_half - one.stroke.phi[int(np.argmin(plays[worst].here))]
        lacking = min(room[worst], *(float(found.here.min()) - one.corridor for found in one.apart))
        better = _better(given, LEAST_GROOVE, -2 * lacking)
        near = ("near", "far apart")[worst % 2]
        where = f"in slot {worst + 1}" if plays is slots else f"with axes {OFF_CENTRE:g} mm too {near}"
        message = (
            f"as made the roller binds {where}: {-room[worst]:.4f} mm are lacking at "
            f"{math.degrees(at):.1f} degrees of the stroke"
        )
        remedy = (
            f"make groove_clearance {better:g}: on these walls that leaves "
            f"{lacking + (better - given) / 2:.4f} mm on either side"
        )
        return [_finding("geneva.as-made", severity, "groove_clearance", message, room[worst], remedy)]
    return []


def _seizing(m: Mechanism, lock: Lock) -> list[Finding]:
    """Whether the disc seizes with the axes in place, and with them too near."""
    least, given = lock.least - lock.corridor, m.params.lock_clearance
    for off, severity in ((0.0, Severity.ERROR), (OFF_CENTRE, Severity.WARNING)):
        if least - off > 0:
            continue
        better = _better(given, LEAST_LOCK, OFF_CENTRE - least)
        near = f" with axes {off:g} mm too near" if off else ""
        message = f"as made the locking disc seizes in the wheel{near}: {off - least:.4f} mm are lacking"
        remedy = (
            f"make lock_clearance {better:g}: on these walls that leaves "
            f"{least - OFF_CENTRE + better - given:.4f} mm"
        )
        return [_finding("geneva.as-made-lock", severity, "lock_clearance", message, least - off, remedy)]
    return []


def _finding(
    code: str, severity: Severity, parameter: str, message: str, room: float, remedy: str
) -> Finding:
    """A clearance that leaves less than no room, mm."""
    return Finding(code, severity, parameter, message, room, 0.0, "mm", remedy, Stage.MACHINING)


def _better(given: float, rule: float, lacking: float) -> float:
    """The clearance of the rule, or, where walls keep more than it allows for, what they need, mm."""
    return max(rule, math.ceil((given + lacking) * 1e3 + 1) / 1e3)
