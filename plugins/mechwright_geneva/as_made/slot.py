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
from mechwright_geneva.as_made.play import Play, drawn_room, made_room, play
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
    def material(self) -> shapely.Geometry:
        """What stands beside the rollers, about the middle of the wheel's bore as made."""
        x, y = self.wheel.bore_middle(self.m.params.bore)
        return shapely.affinity.translate(self._beside(planned=False), -x, -y)

    def _beside(self, *, planned: bool) -> shapely.Geometry:
        whole = self.wheel.section(self.m.params.groove_depth / 2).shape(planned=planned)
        islands = self.parts.get("island", ())
        turned = [
            shapely.affinity.rotate(
                islands[min(k, len(islands) - 1)].outline.shape(planned=planned),
                2 * k * self.m.wheel_half,
                origin=(0, 0),
                use_radians=True,
            )
            for k in range(self.m.slots if islands else 0)
        ]
        beside: shapely.Geometry = shapely.union_all([whole, *turned])
        return beside

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
        return play(self.stroke, made_room(self._beside(planned=True), self.m.roller))

    def play(self, slot: int = 0, off_centre: float = 0.0) -> Play:
        """The play in one slot, with the crank's axis farther away by ``off_centre``, mm."""
        turned = shapely.affinity.rotate(
            self.material, -2 * slot * self.m.wheel_half, origin=(0, 0), use_radians=True
        )
        return play(self.stroke, made_room(turned, self.m.roller), self.roller_off + off_centre)


def as_made(params: GenevaParams, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge a mechanism whose plates are as made."""
    if not {"wheel", "locking-disc"} <= set(made):
        return AsMade()
    m = mechanism_of(params)
    one = Made(m, made)
    lock = Lock.of(m, made["wheel"][0], made["locking-disc"][0])
    slots = [one.play(slot) for slot in range(m.slots)]
    figures, curve = _motion(one, slots)
    return AsMade(
        (*figures, *_locked(m, lock, slots)),
        (curve,),
        (*_binding(one, slots), *_seizing(m, lock)),
    )


def _motion(one: Made, slots: list[Play]) -> tuple[list[MadeFigure], MadeCurve]:
    """Room and play of the roller, and how far the wheel is off where it drives."""
    m, corridor = one.m, one.corridor
    drawn = play(one.stroke, drawn_room(m, m.params.groove_clearance / 2))
    nominal = [found.turns() for found in slots]
    tight, loose = ([slots[0].turns(more)] for more in (-corridor, corridor))
    bounds = [found.turns(more) for found in one.apart for more in (-corridor, corridor)]
    design = drawn.turns()

    def worst(turns: list[tuple[Array, Array]]) -> Array:
        found: Array = np.max([np.maximum(np.abs(ahead), np.abs(behind)) for ahead, behind in turns], axis=0)
        return found

    def entry(turns: list[tuple[Array, Array]]) -> list[float]:
        return [float(ahead[0] + behind[0]) * MICRO for ahead, behind in turns]

    room = [float(found.here.min()) for found in slots]
    ends = [*entry(tight), *entry(loose)]
    error = worst(nominal) * MICRO
    spread = worst([*tight, *loose, *bounds]) * MICRO
    figures = [
        MadeFigure(
            "slot.room",
            "least room of a roller in its slot, on either side",
            "mm",
            0.0,
            m.params.groove_clearance / 2,
            min(room),
            min(room) - corridor,
            max(float(found.here.max()) for found in slots) + corridor,
            "half the groove clearance less what stays on each wall",
        ),
        MadeFigure(
            "slot.play.entry",
            "play of the wheel as a roller enters",
            "µrad",
            None,
            entry([one.planned().turns()])[0],
            max(entry(nominal)),
            min(ends),
            max(ends),
            "as far as the walls reach; between two endless walls 2 h / lever",
        ),
        MadeFigure(
            "wheel.error",
            "greatest error of the wheel in motion",
            "µrad",
            None,
            float(worst([design]).max()) * MICRO,
            float(error.max()),
            float((worst(tight) * MICRO).max()),
            float(spread.max()),
            f"turned until the roller meets a wall, axes ± {OFF_CENTRE:g} mm"
            + ("" if m.straight else "; at mid stroke √(2 h / (ρ² (κ + 1/ρ))): no tolerance cures it"),
        ),
    ]
    curve = MadeCurve(
        "Error of the wheel in motion",
        "crank from the start of the stroke, degrees",
        "µrad",
        np.degrees(m.crank_half - one.stroke.phi),
        {"as drawn": worst([design]) * MICRO, "as made": error, "in the worst case": spread},
    )
    return figures, curve


def _locked(m: Mechanism, lock: Lock, slots: list[Play]) -> list[MadeFigure]:
    """The lock: clearance and play in dwell, and what it takes from the play as it closes."""
    exact = Lock.drawn(m)
    plays = [
        lock.play(off, more) for off in (-OFF_CENTRE, OFF_CENTRE) for more in (-lock.corridor, lock.corridor)
    ]
    entry = max(float(max(turn[0], turn[-1])) for found in slots for turn in found.turns())
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
        MadeFigure(
            "lock.play",
            "turn of the locked wheel either way",
            "µrad",
            None,
            exact.play() * MICRO,
            lock.play() * MICRO,
            min(plays) * MICRO,
            max(plays) * MICRO,
            "ψ_L - acos((a² + l² - R_L²) / (2 a l))",
        ),
        MadeFigure(
            "lock.pulls",
            "turn that the lock takes back as it closes",
            "µrad",
            None,
            None,
            max(0.0, entry - lock.play()) * MICRO,
            max(0.0, entry - max(plays)) * MICRO,
            max(0.0, entry - min(plays)) * MICRO,
            "play in the mouth of the slot over that of the lock",
        ),
    ]


def _binding(one: Made, slots: list[Play]) -> list[Finding]:
    """Whether a roller binds with the axes in place, and with them off."""
    for plays, severity in ((slots, Severity.ERROR), (one.apart, Severity.WARNING)):
        room = [float(found.here.min()) - one.corridor for found in plays]
        worst = int(np.argmin(room))
        if room[worst] > 0:
            continue
        params = one.m.params
        at = one.m.crank_half - one.stroke.phi[int(np.argmin(plays[worst].here))]
        lacking = min(room[worst], *(float(found.here.min()) - one.corridor for found in one.apart))
        better = _better(params.groove_clearance, LEAST_GROOVE, -2 * lacking)
        left = lacking + (better - params.groove_clearance) / 2
        near = ("near", "far apart")[worst % 2]
        where = f"in slot {worst + 1}" if plays is slots else f"with axes {OFF_CENTRE:g} mm too {near}"
        return [
            Finding(
                "geneva.as-made",
                severity,
                "groove_clearance",
                f"as made the roller binds {where}: {-room[worst]:.4f} mm are lacking at "
                f"{math.degrees(at):.1f} degrees of the stroke",
                room[worst],
                0.0,
                "mm",
                f"make groove_clearance {better:g}: on these walls that leaves {left:.4f} mm on either side",
                Stage.MACHINING,
            )
        ]
    return []


def _seizing(m: Mechanism, lock: Lock) -> list[Finding]:
    for off, severity in ((0.0, Severity.ERROR), (OFF_CENTRE, Severity.WARNING)):
        left = lock.least - lock.corridor - off
        if left > 0:
            continue
        given = m.params.lock_clearance
        better = _better(given, LEAST_LOCK, OFF_CENTRE - (lock.least - lock.corridor))
        works = lock.least - lock.corridor - OFF_CENTRE + better - given
        return [
            Finding(
                "geneva.as-made-lock",
                severity,
                "lock_clearance",
                "as made the locking disc seizes in the wheel"
                + (f" with axes {off:g} mm too near" if off else "")
                + f": {-left:.4f} mm are lacking",
                left,
                0.0,
                "mm",
                f"make lock_clearance {better:g}: on these walls that leaves {works:.4f} mm",
                Stage.MACHINING,
            )
        ]
    return []


def _better(given: float, rule: float, lacking: float) -> float:
    """The clearance of the rule, or, where walls keep more than it allows for, what they need, mm."""
    return max(rule, math.ceil((given + lacking) * 1e3 + 1) / 1e3)
