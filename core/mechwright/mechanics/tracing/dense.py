"""Paths of very many points: searched with a part of them, and what is found is fitted to all."""

from collections.abc import Sequence
from dataclasses import Field, replace
from typing import Any, ClassVar, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.mechanics.tracing.points import all_angles
from mechwright.mechanics.tracing.search import Room, Trace, followed


class PointRoom(Room, Protocol):
    """A room that says its points."""

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]

    @property
    def targets(self) -> Any:
        """(n, ...) of them."""

    @property
    def turns(self) -> Array | None:
        """(n,) crank angles from that at the first point, rad; None where they are free."""

    @property
    def closed(self) -> bool:
        """Whether the first point follows on the last."""


R = TypeVar("R", bound=PointRoom)


def only(rooms: Sequence[R], chosen: NDArray[np.intp]) -> list[R]:
    """The rooms with a part of their points."""
    return [
        replace(
            room,
            targets=room.targets[chosen],
            turns=None if room.turns is None else room.turns[chosen],
        )
        for room in rooms
    ]


def on_all(
    traces: Sequence[Trace], rooms: Sequence[PointRoom], chosen: NDArray[np.intp], most: int
) -> list[Trace]:
    """What a search with the ``chosen`` points has found; at most so many fitted to all, if it saw a part."""
    count = len(rooms[0].targets)
    if len(chosen) == count:
        return list(traces)
    found = []
    for one in traces[:most]:
        room = rooms[one.room]
        theta = all_angles(chosen, one.theta, count, room.closed)
        found += [again for again in followed(room, one.room, one.x[None], theta[None]) if again.kept]
    return sorted(found, key=lambda one: one.mean)
