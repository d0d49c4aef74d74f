"""The order in which the links of a planar machine are found: Assur groups, the smallest first.

A group is a set of links with as many joint equations as it has coordinates, once what it is joined to
stands. Its joints decide its kind: two links with three joints are a dyad, which has a closed form; larger
groups are solved together.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from mechwright.errors import KinematicsError
from mechwright.mechanics.planar.free_bodies import GROUND
from mechwright.mechanics.planar.machine import Drive, GearPair, Joint, Machine, Prismatic, Revolute


@dataclass(frozen=True)
class Driven:
    """A link that a drive moves on one that stands already."""

    drive: int
    link: str
    on: str
    joint: Revolute | Prismatic


@dataclass(frozen=True)
class Geared:
    """A link that a gear pair turns, on the pin of one that stands already."""

    link: str
    pin: Revolute
    gears: GearPair


@dataclass(frozen=True)
class Dyad:
    """Two links with three joints: ``outer`` joins each to what stands already, ``inner`` one to the other.

    A slide is the second of the outer joints, if there is one.
    """

    links: tuple[str, str]
    outer: tuple[Revolute | Prismatic, Revolute | Prismatic]
    inner: Revolute | Prismatic

    @property
    def kind(self) -> str:
        """``"RRR"``, ``"RRP"``, ``"RPR"``, ``"RPP"`` or ``"PRP"``: outer, inner, outer joint."""
        first, last = self.outer
        return "".join("R" if isinstance(one, Revolute) else "P" for one in (first, self.inner, last))


@dataclass(frozen=True)
class Cluster:
    """Links that are found together, with their joints, and the drives by number."""

    links: tuple[str, ...]
    joints: tuple[Joint, ...]
    drives: tuple[int, ...]


Group = Driven | Geared | Dyad | Cluster


def assembly_order(machine: Machine) -> tuple[Group, ...]:
    """The groups of a machine in an order in which each stands on those before it.

    Raises
    ------
    KinematicsError
        The machine has not as many degrees of freedom as drives; or some links are joined too much, so that
        others are left over: these are named.

    Examples
    --------
    >>> joints = [
    ...     Revolute("A0", "ground", "crank", 0, 0), Revolute("A", "crank", "coupler", 30, 0),
    ...     Revolute("B", "coupler", "rocker", 80, 70), Revolute("B0", "ground", "rocker", 90, 0),
    ... ]
    >>> [type(one).__name__ for one in assembly_order(Machine(joints, [Drive("crank")]))]
    ['Driven', 'Dyad']
    """
    _count(machine)
    standing, left = {GROUND}, list(machine.links)
    order: list[Group] = []
    while left:
        group = next(_ready(machine, standing, left), None)
        if group is None:
            raise KinematicsError(
                f"{_and(left)} cannot be put together: some of them have a joint too many, others one too few"
            )
        order.append(group)
        found = group.links if isinstance(group, Dyad | Cluster) else (group.link,)
        standing |= set(found)
        left = [link for link in left if link not in standing]
    return tuple(order)


def _count(machine: Machine) -> None:
    if machine.freedom != len(machine.drives):
        pins = sum(isinstance(joint, Revolute) for joint in machine.joints)
        slides = sum(isinstance(joint, Prismatic) for joint in machine.joints)
        over = machine.freedom - len(machine.drives)
        drives = "the drive needs 1" if len(machine.drives) == 1 else f"the drives need {len(machine.drives)}"
        amends = "links to one another by more pins or slides" if over > 0 else "fewer links to one another"
        raise KinematicsError(
            f"{len(machine.links)} moving links with {pins} pins, {slides} slides and "
            f"{len(machine.joints) - pins - slides} gear pairs have {machine.freedom} degrees of freedom, "
            f"and {drives}; join {amends}"
        )


def _ready(machine: Machine, standing: set[str], left: Sequence[str]) -> Iterator[Group]:
    """The groups that can be found now, the simplest first."""
    yield from _driven(machine, standing)
    yield from _geared(machine, standing)
    yield from _dyads(machine, standing, left)
    yield from _clusters(machine, standing, left)


def _driven(machine: Machine, standing: set[str]) -> Iterator[Driven]:
    for number, drive in enumerate(machine.drives):
        for link, on in ((drive.link, drive.on), (drive.on, drive.link)):
            if on in standing and link not in standing:
                yield Driven(number, link, on, machine.driven_joint(drive))


def _geared(machine: Machine, standing: set[str]) -> Iterator[Geared]:
    for gears in machine.joints:
        if not isinstance(gears, GearPair) or gears.carrier not in standing:
            continue
        loose = [link for link in (gears.one, gears.two) if link not in standing]
        if len(loose) == 1:
            for joint in machine.joints:
                if isinstance(joint, Revolute) and _other(joint, loose[0]) in standing:
                    yield Geared(loose[0], joint, gears)
                    break


def _other(joint: Joint, link: str) -> str:
    """The other link of a pin or slide of a link; nothing where it has none."""
    return next((one for one in joint.links if one != link), "") if link in joint.links else ""


def _dyads(machine: Machine, standing: set[str], left: Sequence[str]) -> Iterator[Dyad]:
    for inner in machine.joints:
        if isinstance(inner, GearPair) or not set(inner.links) <= set(left):
            continue
        outer = [_outer(machine, standing, link) for link in inner.links]
        if any(len(own) != 1 for own in outer) or _tied(machine, standing, inner.links, (inner, *outer[0])):
            continue
        links, (first, last) = inner.links, (outer[0][0], outer[1][0])
        if isinstance(first, Prismatic) and isinstance(last, Revolute):
            links, first, last = (links[1], links[0]), last, first
        yield Dyad((links[0], links[1]), (first, last), inner)


def _outer(machine: Machine, standing: set[str], link: str) -> list[Revolute | Prismatic]:
    """The pins and slides that join a link to what stands."""
    return [
        joint
        for joint in machine.joints
        if not isinstance(joint, GearPair) and _other(joint, link) in standing
    ]


def _tied(machine: Machine, standing: set[str], links: Sequence[str], known: Sequence[Joint]) -> bool:
    """Whether more than a dyad's three joints ties two links: a gear, a second joint, a drive."""
    joints, drives = _ties(machine, standing, links)
    names = {joint.name for joint in joints}
    return len(joints) != 3 or bool(drives) or not {joint.name for joint in known} <= names


def _ties(
    machine: Machine, standing: set[str], links: Sequence[str]
) -> tuple[tuple[Joint, ...], tuple[int, ...]]:
    """The joints and drives that tie some links to each other and to what stands."""
    own, known = set(links), standing | set(links)

    def ties(one: Joint | Drive) -> bool:
        return bool(own & set(one.links)) and set(one.links) <= known

    joints = tuple(joint for joint in machine.joints if ties(joint))
    return joints, tuple(number for number, drive in enumerate(machine.drives) if ties(drive))


def _clusters(machine: Machine, standing: set[str], left: Sequence[str]) -> Iterator[Cluster]:
    for size in range(1, len(left) + 1):
        for links in combinations(left, size):
            joints, drives = _ties(machine, standing, links)
            if sum(joint.equations for joint in joints) + len(drives) == 3 * size:
                yield Cluster(links, joints, drives)


def _and(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
