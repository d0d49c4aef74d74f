"""Machines of several phases with lengths in steps: what is rounded is held, the rest fitted again."""

import numpy as np
import pytest
from by_night import by_night

from mechwright.contracts.finding import errors
from mechwright.plugins.host import host


@pytest.mark.parametrize(
    ("family", "more", "names"),
    [
        ("four-bar", {}, ("crank", "follower", "ground")),
        pytest.param("four-bar", {"moves": "fixed"}, ("crank", "follower", "coupler"), marks=by_night),
        pytest.param("five-bar", {}, ("crank", "rocker", "arm", "ground"), marks=by_night),
    ],
)
def test_common_lengths_are_multiples_and_the_points_are_met(family, more, names):
    made = host().family(family)
    model = made.requirements["adjustable-path"]
    wanted = model.model_validate({"length_step": 2.5, "designs": 1, "starts": 100, **more})
    result = made.synthesise("adjustable-path", wanted, lambda done, what: None)
    assert len(result.candidates) == len(wanted.phases)
    for one, points in zip(result.candidates, wanted.phases, strict=True):
        assert [getattr(one.params, name) % 2.5 for name in names] == [0] * len(names)
        assert errors(made.check(one.params)) == []
        motion = made.solve(one.params, 3601)
        trace = motion.traces["P"]
        path = motion.poses[trace.body].transform(np.array([trace.point]))[:, 0, :2]
        off = np.linalg.norm(path[:, None] - np.array(points), axis=2).min(axis=0)
        assert off.max() <= one.figures["path_error_max"].value + 0.15, (
            "samples are a third of a millimetre apart"
        )
