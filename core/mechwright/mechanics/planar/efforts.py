"""Forces in the joints of a planar machine, and what its drives need, for masses, loads, springs and weight.

Units are N, N mm, kg, kg mm² and s. Conventions:

* a pin's force is that of the link ``one`` on the link ``two``;
* a slide's force is that of the guide on the block, at the block's point and normal to the line; its moment
  is on the block about that point;
* a gear pair's moment m is on the gear ``two``; ``one`` takes -ratio m and the carrier (ratio - 1) m;
* a drive that turns gives the moment on ``drive.link``, one that slides the force on the block along the
  line; the other link takes the opposite.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.mechanics.linkage.mass import Mass
from mechwright.mechanics.planar.dynamics import Forces, forces
from mechwright.mechanics.planar.free_bodies import Actuator, Gears, Link, Load, Pin, Slide
from mechwright.mechanics.planar.machine import Machine, Place, Prismatic, Revolute
from mechwright.mechanics.planar.positions import Solution
from mechwright.mechanics.planar.springs import AnySpring

MILLI = 1e-3
"""From kg to t, which give N with mm and s."""


@dataclass(frozen=True)
class PointLoad:
    """A force on a point of a link, and a moment.

    Parameters
    ----------
    link
        The loaded link.
    place
        The point in the frame of the link, x + i y, mm.
    force
        N, x + i y on the ground, constant or (..., n).
    moment
        N mm, constant or (..., n).
    """

    link: str
    place: Place = 0j
    force: Any = 0j
    moment: Any = 0.0


def efforts(
    machine: Machine,
    solution: Solution,
    masses: Mapping[str, Mass] | None = None,
    loads: Sequence[PointLoad] = (),
    springs: Sequence[AnySpring] = (),
    gravity: complex = 0j,
) -> Forces:
    """Forces in all joints by their names, and the efforts of all drives by the driven links.

    Parameters
    ----------
    machine, solution
        The machine, and its motion over time (..., n), with two rates or more.
    masses
        Link to its mass, kg, centre, mm, and inertia, kg mm²; a link that is not named has none. Numbers may
        be columns (n_designs, 1).
    loads
        On points of links.
    springs
        Rates in N/mm and N mm/rad.
    gravity
        Acceleration of free fall, x + i y, mm/s²: -9806.65i for weight along -Y.

    Returns
    -------
    Forces
        N and N mm, with the conventions of this module. A link with two drives has the second as
        ``"link/on"``. NaN where the machine does not close, and at a dead point.

    Raises
    ------
    KinematicsError
        A load or spring names a link that is not there.

    Examples
    --------
    A crank of 30 mm lifts 2 kg at its end; the shaft gives 0.6 N m, and 20 N.

    >>> from mechwright.mechanics.planar import Turning
    >>> from mechwright.mechanics.planar.machine import Drive
    >>> from mechwright.mechanics.planar.positions import solve
    >>> crank = Machine([Revolute("A0", "ground", "crank", 0, 0)], [Drive("crank")])
    >>> motion, weight = solve(crank, [Turning.of([0.0])]), {"crank": Mass(2.0, 30 + 0j)}
    >>> found = efforts(crank, motion, weight, gravity=-1e4j)
    >>> found.drive.round(9).tolist(), found.joints["A0"].round(9).tolist()
    ([600.0], [20j])
    """
    bodies, given = solution.bodies, masses or {}
    links = [_link(name, solution, given.get(name, Mass(0.0))) for name in machine.links]
    acting = [
        Load(load.link, load.force, bodies[load.link].point(load.place, 0).position, load.moment)
        if load.link in bodies
        else Load(load.link, load.force, np.zeros(1, complex), load.moment)
        for load in loads
    ]
    return forces(
        links, tuple(_joints(machine, solution)), tuple(_drives(machine, solution)), acting, springs, gravity
    )


def _link(name: str, solution: Solution, mass: Mass) -> Link:
    return Link(name, solution.bodies[name], mass.mass * MILLI, mass.centre, mass.inertia * MILLI)


def _joints(machine: Machine, solution: Solution) -> Iterator[Pin | Slide | Gears]:
    for joint in machine.joints:
        if isinstance(joint, Revolute):
            yield Pin(joint.name, joint.one, joint.two, solution.place(joint, 0).position)
        elif isinstance(joint, Prismatic):
            yield Slide(joint.name, joint.guide, joint.block, *_line(joint, solution))
        else:
            yield Gears(joint.name, joint.one, joint.two, joint.carrier, joint.ratio)


def _drives(machine: Machine, solution: Solution) -> Iterator[Actuator]:
    names: set[str] = set()
    for drive in machine.drives:
        joint = machine.driven_joint(drive)
        name = f"{drive.link}/{drive.on}" if drive.link in names else drive.link
        names.add(name)
        if isinstance(joint, Prismatic):
            yield Actuator(joint.block, joint.guide, *_line(joint, solution), name)
        else:
            yield Actuator(drive.link, drive.on, name=name)


def _line(joint: Prismatic, solution: Solution) -> tuple[Any, Any]:
    """Direction of a slide, and where the block's point stands."""
    guide, block = solution.bodies[joint.guide], solution.bodies[joint.block]
    return guide.turning.direction * np.exp(1j * np.asarray(joint.line_angle)), block.point(
        joint.point
    ).position
