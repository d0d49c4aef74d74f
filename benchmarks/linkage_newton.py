"""A planar machine by Newton's method on all joint equations at once, and rates by central differences.

Unknown are x, y, mm, and the angle, rad, of every moving link; a pin gives two equations, a slide two, the
drive one. No dyad, no branch and no derivative of ``mechwright.mechanics.planar.positions`` is in it.
"""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from mechwright.mechanics.planar.free_bodies import GROUND
from mechwright.mechanics.planar.machine import Machine, Prismatic, Revolute

Array = NDArray[np.float64]

STEPS, SMALL = 40, 1e-13
"""Most steps, and the step at which Newton ends, over the size of the machine."""

FIRST = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
SECOND = np.array([-1 / 560, 8 / 315, -1 / 5, 8 / 5, -205 / 72, 8 / 5, -1 / 5, 8 / 315, -1 / 560])
"""Central differences of eighth order."""


def equations(machine: Machine, q: Array, at: float) -> tuple[Array, Array]:
    """Errors (e,) of joints and drive, and their derivatives (e, m) by the unknowns."""
    links = machine.links
    errors: list[float] = []
    rows: list[Array] = []

    def frame(link: str) -> tuple[complex, float]:
        if link == GROUND:
            return 0j, 0.0
        x, y, angle = q[3 * links.index(link) :][:3]
        return complex(x, y), float(angle)

    def add(error: float, *terms: tuple[str, tuple[float, float, float]]) -> None:
        row = np.zeros(q.size)
        for link, slope in terms:
            if link != GROUND:
                row[3 * links.index(link) :][:3] += slope
        errors.append(error)
        rows.append(row)

    for joint in machine.joints:
        one, two = joint.links[:2]
        (origin, angle), (other, turned) = frame(one), frame(two)
        arm = complex(joint.place(one)) * np.exp(1j * angle)  # type: ignore[union-attr]
        lever = complex(joint.place(two)) * np.exp(1j * turned)  # type: ignore[union-attr]
        off = other + lever - origin - arm
        if isinstance(joint, Revolute):
            add(off.real, (one, (-1, 0, arm.imag)), (two, (1, 0, -lever.imag)))
            add(off.imag, (one, (0, -1, -arm.real)), (two, (0, 1, lever.real)))
        elif isinstance(joint, Prismatic):
            normal = 1j * np.exp(1j * (angle + float(joint.line_angle)))
            aside = (off * np.conj(normal)).real
            turn = (off * np.conj(1j * normal) - 1j * arm * np.conj(normal)).real
            push = (1j * lever * np.conj(normal)).real
            x, y = normal.real, normal.imag
            add(aside, (one, (-x, -y, turn)), (two, (x, y, push)))
            wound = turned + float(joint.block_angle) - angle - float(joint.line_angle)
            add(float(np.angle(np.exp(1j * wound))), (one, (0, 0, -1)), (two, (0, 0, 1)))
    drive = machine.drives[0]
    off_drive = frame(drive.link)[1] - frame(drive.on)[1] - at
    add(float(np.angle(np.exp(1j * off_drive))), (drive.link, (0, 0, 1)), (drive.on, (0, 0, -1)))
    return np.array(errors), np.array(rows)


def standing(machine: Machine, start: Array, at: float, size: float) -> Array:
    """The unknowns (m,) at an input; raises ArithmeticError where Newton does not converge."""
    q = start.copy()
    scale = np.tile([size, size, 1.0], q.size // 3)
    for _ in range(STEPS):
        error, slopes = equations(machine, q, at)
        step = np.linalg.lstsq(slopes * scale, error, rcond=None)[0]
        q -= scale * step
        if np.abs(step).max() < SMALL:
            return q
    raise ArithmeticError(f"Newton goes on at the input {at}")


def rates(place: Callable[[float, Array], Array], start: Array, at: float, h: float) -> tuple[Array, Array]:
    """First and second derivative of the unknowns by the input."""
    found = [start]
    for way in (1, -1):
        last, some = start, []
        for number in range(1, 5):
            last = place(at + way * number * h, last)
            some.append(last)
        found = [*found, *some] if way == 1 else [*reversed(some), *found]
    values = np.array(found)
    return FIRST @ values / h, SECOND @ values / h**2


def unknowns(machine: Machine, poses: Mapping[str, tuple[complex, float]]) -> Array:
    """The unknowns (m,) of poses."""
    return np.array(
        [one for link in machine.links for z, angle in [poses[link]] for one in (z.real, z.imag, angle)]
    )
