"""Whether two designs lead to different results."""

from collections.abc import Callable
from typing import Any

import numpy as np

from mechwright.contracts.family import Family
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import Part
from mechwright.errors import MechwrightError

_SAMPLES = 13
"""Samples of the motions that are compared: a whole turn in steps of 30 degrees shows any change."""


class Results:
    """Results of one design, each computed when it is first asked for, or the words that refuse it."""

    def __init__(self, family: Family[Any], params: Parameters) -> None:
        self.params = params
        self._family = family
        self._found: dict[str, object] = {}

    def get(self, name: str) -> object:
        """One of ``motion``, ``parts`` and ``findings``."""
        if name not in self._found:
            self._found[name] = _ask(_GIVEN[name], self._family, self.params)
        return self._found[name]

    def difference(self, other: "Results") -> str:
        """Name the first result that differs, cheap ones first: motion, parts, findings; empty if none."""
        return next((name for name in _GIVEN if self.get(name) != other.get(name)), "")


def _ask(
    give: Callable[[Family[Any], Parameters], object], family: Family[Any], params: Parameters
) -> object:
    """The result, or the words in which it is refused."""
    try:
        return give(family, params)
    except MechwrightError as error:
        return str(error)


def _motion(family: Family[Any], params: Parameters) -> object:
    motion = family.solve(params, _SAMPLES)
    channels = {name: (item.unit, item.values.tolist()) for name, item in motion.channels.items()}
    scalars = {name: (item.unit, item.value) for name, item in motion.scalars.items()}
    poses = {
        body: np.concatenate((item.position[:, :, None], item.rotation), axis=2).tolist()
        for body, item in motion.poses.items()
    }
    return motion.input_name, channels, scalars, poses, dict(motion.joints)


def _parts(family: Family[Any], params: Parameters) -> object:
    return [_part(part) for part in family.parts(params)]


def _part(part: Part) -> object:
    plain = (
        part.name,
        part.outline,
        part.thickness,
        part.material,
        part.instances,
        part.colour,
        part.machined,
    )
    if part.build is None:
        return plain
    # Two functions that build the same solid are not equal, but their solids measure the same.
    solid = part.build()
    return *plain, solid.Volume(), solid.Area(), solid.Center().toTuple()


_GIVEN: dict[str, Callable[[Family[Any], Parameters], object]] = {
    "motion": _motion,
    "parts": _parts,
    "findings": lambda family, params: [finding.as_dict() for finding in family.check(params)],
}
"""Result to what gives it."""
