"""What the family contract asks of the places that a requirement names."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from mechwright.contracts.family import Family
from mechwright.contracts.parameters import Parameters

DRAGGED = 0.01
"""How far a target is dragged, as a part of its distance from the origin."""

ROUNDING = 1e-6
"""Part of that distance by which rounding may take a target the other way."""


class TargetTests:
    """Tests of :meth:`Family.targets`."""

    family: ClassVar[type[Family[Any]]]
    requirements: ClassVar[Mapping[str, Sequence[Mapping[str, Any]]]]

    def test_targets(self) -> None:
        """What can be dragged goes the way it is dragged, and what it writes is a requirement."""
        for kind, model in self.family.requirements.items():
            for table in self.requirements.get(kind, ({},)):
                self._dragged(kind, model.model_validate(dict(table)))

    def _dragged(self, kind: str, requirement: Parameters) -> None:
        family = self.family()
        targets = family.targets(kind, requirement)
        names = [one.name for one in targets]
        assert len(set(names)) == len(names), f"{kind}: two targets have one name: {names}"
        plain = requirement.model_dump(mode="json", exclude_none=True)
        for number, target in enumerate(targets):
            place = np.array(target.place)
            assert place.shape in {(2,), (3,)}, f"{kind}: {target.name} is at {target.place}"
            for way in np.eye(len(place)) * DRAGGED * np.linalg.norm(place):
                for aim in (place + way, place - way):
                    if len(aim) == 3:
                        aim *= np.linalg.norm(place) / np.linalg.norm(aim)
                    written = target.moved(tuple(aim.tolist()))
                    changed = type(requirement).model_validate({**plain, **written})
                    gone = np.array(family.targets(kind, changed)[number].place) - place
                    nothing = ROUNDING * float(place @ place)
                    assert gone @ (aim - place) >= -nothing, f"{kind}: {target.name} goes against the drag"
