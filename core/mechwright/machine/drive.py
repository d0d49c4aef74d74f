"""Torque that a mechanism asks of its drive, by virtual power.

With F = [R | p] the frame of a body and M = ∫ p pᵀ dm its moments, what its inertia asks of the input at the
angle θ is tr(F̈ M F_θᵀ), F_θ = dF/dθ. For a shaft with the ratio i that is J i (i' ω² + i α): a driver whose
speed varies is in it. Weights ask g up · F_θ ∫ p dm, given forces and torques - f · (F_θ p) - τ · ω_θ, and a
resistance T |ω_θ| against the turning. Run backwards all but the resistances keep their value at each angle,
and so change their sign in the sense of the running.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import Vector
from mechwright.contracts.load import Load
from mechwright.contracts.mass import body_moments
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright.machine.course import Course, course_of
from mechwright.machine.outputs import fixed_to, output_of
from mechwright.machine.settings import MachineSettings
from mechwright.mechanics.strength.drive import energy_swing, flywheel

SAMPLES = 1441
"""Of the motion: every quarter of a degree of a turn."""

MICRO, MILLI = 1e-6, 1e-3
"""From kg mm²/s² to N m, and from N mm to N m."""

GRAVITY = 9.80665
"""Standard gravity, m/s²."""

_OWN = "[machine]"
"""Name of the load of that table."""


@dataclass(frozen=True, eq=False)
class Run:
    """The drive in one sense.

    Parameters
    ----------
    name
        ``"forwards"`` or ``"backwards"``.
    torque
        (n,) N m at the input, positive where the motor drives, negative where it brakes; of a lever it is
        about the angle of the motion.
    power
        (n,) W.
    """

    name: str
    torque: Array
    power: Array


@dataclass(frozen=True, eq=False)
class Drive:
    """What a mechanism asks of its input over a period; all arrays (n,), as ``course`` has them.

    Parameters
    ----------
    course
        Angle, time and speed of the input.
    inertia, weight, given, resisting
        Parts of the torque about the angle, N m: of accelerated masses, of weights, of forces that the
        mechanism's own loads give, and of what resists its turning.
    reflected
        Inertia of all that moves as the input feels it, kg m².
    runs
        In each sense that is asked for.
    of_load
        What of ``resisting`` is of the load of ``[machine]``.
    """

    course: Course
    inertia: Array
    weight: Array
    given: Array
    resisting: Array
    reflected: Array
    runs: tuple[Run, ...]
    of_load: Array

    def lightened(self, share: float) -> "Drive":
        """The same drive with that share of the load of ``[machine]``."""
        resisting = self.resisting - (1 - share) * self.of_load
        conservative = self.inertia + self.weight + self.given
        runs = tuple(_run(self.course, conservative, resisting, run.name) for run in self.runs)
        return replace(self, resisting=resisting, of_load=share * self.of_load, runs=runs)

    def slowed(self, share: float) -> "Drive":
        """The same drive at that share of its speed; bodies of the course keep their rates."""
        course = replace(
            self.course,
            time=self.course.time / share,
            speed=self.course.speed * share,
            acceleration=self.course.acceleration * share**2,
        )
        inertia = self.inertia * share**2
        runs = tuple(
            _run(course, inertia + self.weight + self.given, self.resisting, run.name) for run in self.runs
        )
        return replace(self, course=course, inertia=inertia, runs=runs)

    def peak(self) -> tuple[float, float, str]:
        """The greatest torque either way, N m with its sign, at which angle, rad, and in which run."""
        found = [(*greatest(run.torque, self.course.angle), run.name) for run in self.runs]
        most = max(abs(one[0]) for one in found)
        return next(one for one in found if abs(one[0]) >= (1 - _SAME) * most)

    @property
    def reverses(self) -> bool:
        """Whether the torque of a run changes its sense by more than a trace of its peak."""
        most = TRACE * abs(self.peak()[0])
        return any(run.torque.min() < -most and run.torque.max() > most for run in self.runs)

    @property
    def rms(self) -> float:
        """Root mean square of the torque over time, N m, of the run where it is greater."""
        return max(float(np.sqrt(self.mean_of(run.torque**2))) for run in self.runs)

    def mean_of(self, values: Array) -> float:
        """Mean (n,) over time."""
        time = self.course.time
        return float(np.trapezoid(values, time) / (time[-1] - time[0]))

    def inertia_of(self, number: int) -> Array:
        """What of a run's torque (n,) is of inertia, N m."""
        if self.course.rocks:
            return self.inertia
        sense = np.sign(self.course.angle[-1] - self.course.angle[0])
        way = 1.0 if self.runs[number].name == "forwards" else -1.0
        return np.asarray(self.inertia * (sense * way))

    @property
    def power(self) -> tuple[float, float]:
        """Greatest and mean power, W, of the run where each is greater; a mean that is rounding is 0."""
        most = max(float(run.power.max()) for run in self.runs)
        mean = max(self.mean_of(run.power) for run in self.runs)
        return most, mean if abs(mean) > _NOTHING * most else 0.0

    @property
    def speed(self) -> float:
        """Greatest speed of the input, rad/s."""
        return float(np.abs(self.course.speed).max())

    @property
    def mean_speed(self) -> float:
        """Mean speed of an input that turns, rad/s."""
        time = self.course.time
        return float(abs(self.course.angle[-1] - self.course.angle[0]) / (time[-1] - time[0]))

    @property
    def swing(self) -> float | None:
        """Greatest less least of the work beyond the mean torque, J; None if the speed does not come back."""
        if self.course.rocks or not self.repeats:
            return None
        angle = np.abs(self.course.angle - self.course.angle[0])
        return max(energy_swing(run.torque, angle) for run in self.runs)

    @property
    def uniform(self) -> bool:
        """Whether the input turns on at one speed."""
        return not self.course.rocks and bool(np.ptp(self.course.speed) <= _SAME * self.speed)

    @property
    def repeats(self) -> bool:
        """Whether speed and torque end as they begin."""
        speed = self.course.speed
        return bool(abs(speed[-1] - speed[0]) <= _SAME * self.speed)

    def flywheel(self, variation: float) -> float | None:
        """Inertia at the input, kg m², that keeps the speed within that share of its mean, up or down.

        None as :attr:`swing`.
        """
        return None if self.swing is None else flywheel(self.swing, 2 * variation, self.mean_speed)


_NOTHING = 1e-6
"""Share of the greatest power below which the mean is rounding."""

TRACE = 0.01
"""Share of the peak by which a torque has to go below 0 to change its sense: less is rounding."""

_SAME = 1e-6
"""Share by which speeds at both ends of a period may differ, and peaks that are equally high."""


def drive_of(motion: Motion, parts: Sequence[Part], settings: MachineSettings) -> Drive:
    """The drive of a motion with its parts; ``motion`` has :data:`SAMPLES`, or at least 9, over its period.

    Raises
    ------
    DesignError
        The settings ask for what the mechanism has not.
    GeometryError
        A part that moves has no mass.
    """
    course = course_of(motion, settings.speed)
    loads = all_loads(motion, settings)
    masses = moving_masses(motion, parts)
    moving = with_own_inertia(motion, masses)
    inertia, reflected, weight = _of_masses(course, masses, moving, settings.upwards)
    given, resisting = _of_loads(course, loads)
    of_load = _of_loads(course, {key: load for key, load in loads.items() if key == _OWN})[1]
    conservative = inertia + weight + given
    runs = tuple(
        _run(course, conservative, resisting, name)
        for name in ("forwards", "backwards")
        if settings.direction in {name, "both"}
    )
    return Drive(course, inertia, weight, given, resisting, reflected, runs, of_load)


def all_loads(motion: Motion, settings: MachineSettings) -> dict[str, Load]:
    """The loads of a motion and the one of the settings; raises DesignError for an output that is none."""
    loads = dict(motion.loads)
    if settings.load > 0:
        loads[_OWN] = Load(output_of(motion, settings.output), resisting=settings.load)
    elif settings.output:
        output_of(motion, settings.output)
    return loads


def _run(course: Course, conservative: Array, resisting: Array, name: str) -> Run:
    way = 1.0 if name == "forwards" else -1.0
    if course.rocks:
        torque = conservative + way * resisting
        return Run(name, torque, torque * way * course.speed)
    torque = way * np.sign(course.angle[-1] - course.angle[0]) * conservative + resisting
    return Run(name, torque, torque * np.abs(course.speed))


def greatest(values: Array, at: Array) -> tuple[float, float]:
    """The value (n,) farthest from 0 and where it is, by a parabola through the samples about a smooth one.

    >>> x = np.linspace(0, 3, 31)
    >>> [round(number, 5) for number in greatest(2 - (x - 1.234) ** 2, x)]
    [2.0, 1.234]
    """
    top = int(np.argmax(np.abs(values)))
    if not 0 < top < values.size - 1:
        return float(values[top]), float(at[top])
    left, middle, right = values[top - 1 : top + 2]
    bend = left - 2 * middle + right
    if bend == 0 or max(abs(middle - left), abs(middle - right)) > _SMOOTH * abs(middle):
        return float(middle), float(at[top])
    shift = float((left - right) / (2 * bend))
    return float(middle - (left - right) * shift / 4), float(
        at[top] + shift * (at[top + 1] - at[top - 1]) / 2
    )


_SMOOTH = 0.05
"""Share of a peak by which its neighbours differ at the most, where it is no jump."""


def moving_masses(motion: Motion, parts: Sequence[Part]) -> dict[str, Array]:
    """Moments (4, 4) of every body that has parts and moves, kg and mm."""
    placed: dict[str, list[tuple[Part, float]]] = {}
    for part in parts:
        for one in part.instances:
            poses = motion.poses.get(one.body)
            if poses is not None and np.ptp(poses.frames, axis=0).max() > 0:
                placed.setdefault(one.body, []).append((part, one.z))
    return {body: body_moments(here) for body, here in placed.items()}


def with_own_inertia(motion: Motion, masses: Mapping[str, Array]) -> dict[str, Array]:
    """The moments with those of loads that bring their inertia along."""
    found = dict(masses)
    for load in motion.loads.values():
        if load.inertia is not None or load.mass is not None:
            for body in fixed_to(load.body, motion.joints) & found.keys():
                found[body] = np.zeros((4, 4))
            half = (load.inertia or 0.0) / MICRO / 2
            found[load.body] = np.diag([half, half, 0.0, load.mass or 0.0])
    return found


def _of_masses(
    course: Course, weighing: Mapping[str, Array], moving: Mapping[str, Array], up: Vector
) -> tuple[Array, Array, Array]:
    """Torque of inertia, reflected inertia, and torque of weights, (n,)."""
    torque, reflected, weight = (np.zeros(course.angle.size) for _ in range(3))
    direction = np.array(up)
    for body, moments in moving.items():
        along = course.along(body)
        carried = along @ moments
        torque += np.einsum("nij,nij->n", course.bodies[body].second, carried) * MICRO
        reflected += np.einsum("nij,nij->n", along, carried) * MICRO
    for body, moments in weighing.items() if direction.any() else ():
        weight += GRAVITY * (course.along(body) @ moments[:, 3]) @ direction * MILLI
    return torque, reflected, weight


def _of_loads(course: Course, loads: Mapping[str, Load]) -> tuple[Array, Array]:
    """Torque of given forces and torques, and of what resists in the sense of the running, (n,)."""
    given, resisting = np.zeros(course.angle.size), np.zeros(course.angle.size)
    for load in loads.values():
        share = 1.0 if load.share is None else load.share
        if any(load.force):
            way = course.along(load.body) @ np.array([*load.point, 1.0])
            given -= share * (way @ np.array(load.force)) * MILLI
        if any(load.torque) or load.resisting:
            turning = course.turning(load.body)
            given -= share * (turning @ np.array(load.torque))
            resisting += load.resisting * np.linalg.norm(turning, axis=1)
    return given, resisting * (np.where(course.rests, 0.0, np.sign(course.speed)) if course.rocks else 1.0)
