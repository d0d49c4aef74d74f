"""Random chains of two to four mechanisms, each from a seed of its own.

``likely``: families that can stand where they do, and a tenth of their keys drawn. ``whole``: any families
that can be stages, and half of their keys, evenly from all of their bounds.
"""

from collections.abc import Iterator
from itertools import count
from pathlib import Path

import numpy as np
from random_designs import WAYS, drawn, without

from mechwright import Design, DesignError, Family, Host
from mechwright.designs.change import changed
from mechwright.designs.design import design_of
from mechwright.remedies.keys import keys_of

MIDDLE = ("noncircular-gears", "elliptic-gears", "spur-gears", "geneva", "four-bar", "cam-follower")
"""Families that are driven and drive."""

LAST = (*MIDDLE, "slider-crank", "five-bar")

_AGAIN = 3
"""Tables that are drawn anew, before keys that are refused are left out."""


def chains(host: Host, seed: int, numbers: range, way: str) -> Iterator[Design]:
    """The chains with these numbers; the same seed and number give the same one.

    A table that validation refuses is drawn anew some times, and then what the refusals speak of is left out.
    """
    every = sorted(one.name for one in host.all(Family))
    path = Path("random.toml")
    for number in numbers:
        rng = np.random.default_rng([seed, number, WAYS.index(way)])
        while True:
            several = int(rng.integers(2, 5))
            rooms = [every] * several if way == "whole" else [MIDDLE] * (several - 1) + [LAST]
            bare = {
                "format": 1,
                "name": "random",
                "stage": [{"family": str(rng.choice(one))} for one in rooms],
            }
            try:
                start = design_of(bare, path, "", host)
            except DesignError:  # a family that is no stage
                continue
            break
        keys = [
            key for key in keys_of(start).values() if key.path.startswith("stage.") and key.kind != "other"
        ]
        share = 0.5 if way == "whole" else 0.1
        for tried in count():
            content = changed(bare, {key.path: drawn(key, rng, way) for key in keys if rng.random() < share})
            try:
                yield design_of(content, path, "", host)
            except DesignError as error:
                fewer = without(keys, content, str(error), rng, host) if tried >= _AGAIN else None
                if fewer is None:
                    continue
                yield fewer
            break
