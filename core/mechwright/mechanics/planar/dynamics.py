"""Forces in a linkage whose motion is known: Newton and Euler for every body, one linear system per sample.

:mod:`free_bodies` says what links, joints, actuators and loads are. A drive is an actuator. Links that gears
turn with each other may each have a drive instead of the mesh. The shaft of the first one then takes their
sum, each times its ratio.

A linkage with one degree of freedom and one drive has as many unknowns as equations.

Units are any consistent ones: kg, mm and s give forces in mN and moments in mN mm (µN m).
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import KinematicsError
from mechwright.mechanics.planar.equilibrium import BLOCK, unknowns
from mechwright.mechanics.planar.free_bodies import GROUND, Actuator, Gears, Joint, Link, Load, Pin, Slide
from mechwright.mechanics.planar.rigid import BodyMotion, Plane, Turning
from mechwright.mechanics.planar.springs import AnySpring, spring_loads

__all__ = ["BLOCK", "GROUND", "Actuator", "Forces", "Gears", "Link", "Load", "Pin", "Slide", "forces"]


@dataclass(frozen=True)
class Forces:
    """What the joints carry.

    Parameters
    ----------
    joints
        Name of a joint to its force (..., n) on its body ``two``, mN.
    moments
        Name of a slide to its moment (..., n) on its body ``two`` about the slide's place, mN mm.
    drives
        Driven link to the moment (..., n) on it, mN mm, or the force of an actuator along a direction, mN.
    shaking
        Force (..., n) of the moving links' inertia on the ground, - Σ m a_G, mN; loads and weight are not in
        it.
    gears
        Name of a mesh to the moment (..., n) on its gear ``two``, mN mm.
    """

    joints: dict[str, Plane]
    moments: dict[str, Array]
    drives: dict[str, Array]
    shaking: Plane
    gears: dict[str, Array] = field(default_factory=dict)

    @property
    def drive(self) -> Array:
        """Moment or force (..., n) on the first driven link."""
        return next(iter(self.drives.values()))

    def scaled(self, factor: float) -> "Forces":
        """The same in another unit: with 1e-3 in N and N mm."""
        joints = {name: force * factor for name, force in self.joints.items()}
        moments = {name: moment * factor for name, moment in self.moments.items()}
        drives = {name: moment * factor for name, moment in self.drives.items()}
        gears = {name: moment * factor for name, moment in self.gears.items()}
        return Forces(joints, moments, drives, self.shaking * factor, gears)


def forces(
    links: Sequence[Link],
    joints: Sequence[Joint],
    driven: str | Actuator | Sequence[str | Actuator],
    loads: Sequence[Load] = (),
    springs: Sequence[AnySpring] = (),
    gravity: complex = 0j,
) -> Forces:
    """Forces in all joints, and the moments or forces that drive the linkage.

    Parameters
    ----------
    links, joints, loads
        As :mod:`free_bodies` describes them.
    driven
        Actuators; the name of a link stands for a moment of the ground on it.
    springs
        With rates in the units of the result, mN/mm and mN mm/rad for kg, mm and s.
    gravity
        Acceleration of free fall, x + i y, mm/s².

    Results of several designs are NaN where a motion is NaN or in a dead centre.

    Raises
    ------
    KinematicsError
        The linkage has not as many unknowns as equations, a joint or load names a body that is not there, or
        the linkage, if it is one design, is in a dead centre, where no finite moment drives it.

    Examples
    --------
    A mass of 2 kg on a crank of 10 mm at 3 rad/s pulls with 2 · 10 · 9 mN:

    >>> from mechwright.mechanics.planar import Turning
    >>> crank = Link("crank", BodyMotion.about(0j, Turning.of([0.0], 3.0)), 2.0, 10 + 0j)
    >>> found = forces([crank], [Pin("shaft", GROUND, "crank", np.zeros(1, complex))], "crank")
    >>> found.joints["shaft"].round(9).tolist(), found.shaking.round(9).tolist()
    ([(-180+0j)], [(180-0j)])
    """
    single = isinstance(driven, str | Actuator)
    drives = [
        Actuator(one) if isinstance(one, str) else one
        for one in ((driven,) if isinstance(driven, str | Actuator) else driven)
    ]
    _count(len(links), joints, len(drives), single=single)
    bodies = {link.name: link.motion for link in links}
    given = [*loads, *spring_loads(springs, bodies | {GROUND: _rest()})]
    _names(links, joints, drives, given)
    values, centres = unknowns(links, (*joints, *drives), given, gravity)
    left = iter(values)
    found: dict[str, Plane] = {}
    moments: dict[str, Array] = {}
    gears: dict[str, Array] = {}
    for joint in joints:
        if isinstance(joint, Gears):
            gears[joint.name] = next(left)
        elif isinstance(joint, Pin):
            found[joint.name] = next(left) + 1j * next(left)
        else:
            found[joint.name] = next(left) * (1j * np.asarray(joint.direction))
            moments[joint.name] = next(left)
    inertia = np.broadcast_arrays(*(link.mass * centres[link.name].acceleration for link in links))
    shaking: Plane = -np.sum(inertia, axis=0)
    return Forces(found, moments, {drive.key: next(left) for drive in drives}, shaking, gears)


def _count(links: int, joints: Sequence[Joint], drives: int, *, single: bool) -> None:
    count = 3 * links
    number = sum(1 if isinstance(joint, Gears) else 2 for joint in joints) + drives
    if number != count:
        said = "a drive" if single else f"{drives} drives"
        raise KinematicsError(
            f"{links} links give {count} equations, but {len(joints)} joints and {said} have "
            f"{number} unknowns; the linkage needs one degree of freedom for each drive"
        )


def _names(
    links: Sequence[Link], joints: Sequence[Joint], drives: Sequence[Actuator], loads: Sequence[Load]
) -> None:
    named = {name for joint in joints for name in (joint.one, joint.two)} | {load.body for load in loads}
    named |= {joint.carrier for joint in joints if isinstance(joint, Gears)}
    named |= {name for drive in drives for name in (drive.link, drive.on)}
    missing = named - {link.name for link in links} - {GROUND}
    idle = any(drive.link == GROUND == drive.on for drive in drives)
    if missing or idle:
        raise KinematicsError(f"no moving link is called {', '.join(sorted(missing)) or GROUND}")


def _rest() -> BodyMotion:
    return BodyMotion.about(0j, Turning.of(np.zeros(1)))
