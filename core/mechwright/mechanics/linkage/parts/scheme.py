"""Which plates each link consists of, and which of them has which eye.

Glossary
--------
eye
    Where a link has a pin, a slot, a pair of guide pins, or a traced point. An eye is named after its axis,
    slide or path.
split
    A link of three or more eyes as two plates on one shared pin, which is pressed into both: what stands
    between the plates may pass over the other eyes of either.
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations

from mechwright.mechanics.planar.dynamics import GROUND

UPPER = "ground-2"
"""Name of the ground plate over the links."""

GROUND_PLATES = (GROUND, UPPER)
"""Names of both."""


@dataclass(frozen=True)
class Split:
    """A link as two plates: the eye that both share, and the others of the second plate."""

    link: str
    shared: str
    others: frozenset[str]

    @property
    def second(self) -> str:
        """Name of the second plate."""
        return f"{self.link}-2"


@dataclass(frozen=True)
class Scheme:
    """One way to make a linkage of plates.

    Parameters
    ----------
    sides
        On how many sides of the links a ground plate stands.
    upper
        The eyes of the ground that are in its upper plate.
    split
        A link of two plates.
    """

    sides: int = 1
    upper: frozenset[str] = frozenset()
    split: Split | None = None

    def plates(self, link: str, eye: str) -> tuple[str, ...]:
        """The plates of a link that have this eye of it."""
        if link == GROUND:
            return (UPPER if eye in self.upper else GROUND,)
        if self.split is None or link != self.split.link:
            return (link,)
        if eye == self.split.shared:
            return (link, self.split.second)
        return (self.split.second if eye in self.split.others else link,)

    def names(self, link: str) -> tuple[str, ...]:
        """All plates of a link."""
        if link == GROUND:
            return GROUND_PLATES[: self.sides]
        if self.split is not None and link == self.split.link:
            return (link, self.split.second)
        return (link,)

    def link(self, plate: str) -> str:
        """The link of a plate."""
        if plate in GROUND_PLATES:
            return GROUND
        return self.split.link if self.split is not None and plate == self.split.second else plate


def uppers(movable: Collection[str]) -> Iterator[frozenset[str]]:
    """Eyes of the ground that its upper plate takes, all of them first, none last."""
    for count in range(len(movable), -1, -1):
        for some in combinations(sorted(movable), count):
            yield frozenset(some)


def splits(pins: Mapping[str, Collection[str]], eyes: Mapping[str, Collection[str]]) -> Iterator[Split]:
    """Ways to make one link of two plates.

    Parameters
    ----------
    pins
        Link to the axes on which it may have both plates.
    eyes
        Link to all its eyes.
    """
    for link, shared in pins.items():
        for axis in shared:
            others = [eye for eye in eyes[link] if eye != axis]
            # The first of the others stays in the first plate: the plates may change places anyway.
            for count in range(1, len(others)):
                for some in combinations(others[1:], count):
                    yield Split(link, axis, frozenset(some))
