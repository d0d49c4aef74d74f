"""What plates do to the pins of a linkage over a period: forces at their heights, bending, shear, sliding.

A pin is a cantilever out of the plate into which it is pressed. Each plate on it presses in the middle of its
thickness. Between two plates into which a pin is pressed, each force bends it as if the nearer one alone had
it: a beam that is clamped at both ends bends less.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import KinematicsError
from mechwright.mechanics.linkage.kinematics.forces import period_forces
from mechwright.mechanics.linkage.parts.axes import axes_of
from mechwright.mechanics.linkage.parts.layout import Layout
from mechwright.mechanics.linkage.parts.pins import Pin
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.planar.dynamics import Forces
from mechwright.mechanics.planar.machine import Prismatic, Revolute
from mechwright.mechanics.planar.positions import Solution
from mechwright.mechanics.planar.relative_motion import relative
from mechwright.mechanics.planar.rigid import Plane


@dataclass(frozen=True)
class PlateLoad:
    """What one plate does to a pin.

    Parameters
    ----------
    plate
        Its name.
    height, thickness
        Of the middle of the plate, and of the plate, mm.
    force
        On the pin (n,), x + i y on the ground, N.
    turning
        Of the plate, or of the roller in its slot, over the pin (n,), rad/s.
    slide
        The slide in whose slot the pin runs; nothing for a bore.
    """

    plate: str
    height: float
    thickness: float
    force: Plane
    turning: Array
    slide: str = ""


@dataclass(frozen=True)
class PinLoads:
    """A pin, the plates that hold it with lower and upper face, mm, and what other plates do to it."""

    pin: Pin
    pressed: Mapping[str, tuple[float, float]]
    loads: tuple[PlateLoad, ...]

    @property
    def name(self) -> str:
        """For findings."""
        return f"{'shaft' if self.pin.name.startswith('shaft') else 'pin'} {self.pin.eye}"

    @property
    def bending(self) -> float:
        """The greatest bending moment, N mm."""
        return max((float(np.nanmax(np.abs(moment))) for _, moment in self._sections()), default=0.0)

    @property
    def shear(self) -> float:
        """The greatest shear force, N."""
        return max((float(np.nanmax(np.abs(force))) for force, _ in self._sections()), default=0.0)

    def carried(self, plate: str) -> Plane:
        """What a plate into which the pin is pressed carries (n,), N."""
        return np.asarray(sum(one.force for one, own, _ in self._held() if own == plate) + 0j)

    def _held(self) -> Iterator[tuple[PlateLoad, str, float]]:
        """Each load with the plate that carries it, and the height of its face on that side."""
        for load in self.loads:
            faces = [
                (abs(face - load.height), plate, face) for plate, own in self.pressed.items() for face in own
            ]
            _, plate, face = min(faces)
            yield load, plate, face

    def _sections(self) -> Iterator[tuple[Plane, Plane]]:
        """Shear force and bending moment (n,) at each face and under each load."""
        held = list(self._held())
        for at in {(plate, face) for _, plate, face in held}:
            own = [load for load, plate, face in held if (plate, face) == at]
            for section in (at[1], *(load.height for load in own)):
                out = abs(section - at[1])
                beyond = [load for load in own if abs(load.height - at[1]) > out]
                if beyond:
                    yield (
                        np.asarray(sum(load.force for load in beyond)),
                        np.asarray(sum(load.force * abs(load.height - section) for load in beyond)),
                    )


def pin_loads(table: AnyPlanarTable) -> tuple[PinLoads, ...]:
    """All pins of a design, guide pins among them; none where the drive stands in a dead centre.

    Raises
    ------
    GeometryError
        The design has no layout.
    """
    return table.once("pin loads", lambda: _pin_loads(table))


def _pin_loads(table: AnyPlanarTable) -> tuple[PinLoads, ...]:
    layout = table.layout
    try:
        period, forces = period_forces(table)
    except KinematicsError:
        return ()
    found = _Found(layout, period.solution, forces)
    return tuple(found.of_guide_pin(pin) if pin.number else found.of_pin(pin) for pin in layout.pins)


@dataclass(frozen=True)
class _Found:
    """A layout, its motion over a period, and the forces of its joints."""

    layout: Layout
    solution: Solution
    forces: Forces

    def of_pin(self, pin: Pin) -> PinLoads:
        """A pin through two links or more."""
        axis = next(one for one in axes_of(self.layout.linkage) if one.point == pin.eye)
        loads: list[PlateLoad] = []
        for plates, rolls in ((pin.turning, False), (pin.rolling, True)):
            links = [link for _, link in plates]
            for plate, link in plates:
                force = _on_pin(axis.joints, link, self.forces) / links.count(link)
                slide = axis.rollers[link] if rolls else None
                turning = self._turning(link, pin.body) if slide is None else self._rolling(slide)
                name = "" if slide is None else slide.name
                loads.append(PlateLoad(plate, *self._place(plate), force, turning, name))
        return PinLoads(pin, self._faces(pin), tuple(loads))

    def of_guide_pin(self, pin: Pin) -> PinLoads:
        """One of the two pins of a block, which share the slide's force and turn its moment into a pair."""
        slide = next(
            one
            for one in self.layout.linkage.machine.joints
            if isinstance(one, Prismatic) and one.name == pin.eye
        )
        guide = self.solution.bodies[slide.guide].turning.direction * np.exp(
            1j * np.asarray(slide.line_angle)
        )
        pair = self.forces.moments[slide.name] / self.layout.sizes.guide_length
        sign = -1.0 if pin.number == 1 else 1.0
        force = self.forces.joints[slide.name] / 2 + sign * 1j * guide * pair
        loads = tuple(
            PlateLoad(plate, *self._place(plate), force, self._rolling(slide), slide.name)
            for plate, _ in pin.rolling
        )
        return PinLoads(pin, self._faces(pin), loads)

    def _place(self, plate: str) -> tuple[float, float]:
        """Height of the middle of a plate, and its thickness, mm."""
        thickness = self.layout.sizes.thickness_of(plate)
        return self.layout.stack.bottom(plate) + thickness / 2, thickness

    def _faces(self, pin: Pin) -> dict[str, tuple[float, float]]:
        places = {plate: self._place(plate) for plate in pin.pressed}
        return {plate: (middle - thick / 2, middle + thick / 2) for plate, (middle, thick) in places.items()}

    def _turning(self, link: str, body: str) -> Array:
        bodies = self.solution.bodies
        return np.asarray(bodies[link].turning.omega - bodies[body].turning.omega)

    def _rolling(self, slide: Prismatic) -> Array:
        """Turning of a roller that rolls along its slot, rad/s."""
        bodies = self.solution.bodies
        way = relative(bodies[slide.block], bodies[slide.guide]).point(slide.point, 1)
        return np.asarray(np.abs(way.velocity) / (self.layout.sizes.roller / 2))


def _on_pin(joints: tuple[Revolute, ...], link: str, forces: Forces) -> Plane:
    """The force of a link on the pin of its joints (n,), N: the opposite of that on the link."""
    on_link = sum(
        forces.joints[joint.name] * (1.0 if link == joint.two else -1.0)
        for joint in joints
        if link in joint.links
    )
    return np.asarray(-1.0 * on_link)
