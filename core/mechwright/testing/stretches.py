"""What the family contract asks of long motions: stretches are the whole motion, cut."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
import pytest

from mechwright.arrays import Array
from mechwright.contracts import stretch
from mechwright.contracts.family import Family
from mechwright.contracts.motion import NOTHING, Motion
from mechwright.contracts.parameters import Parameters

FINER = 4
"""Times the samples that a motion under test has: one stretch has as many as that, and so has a lead."""

SAME = 1e-9
"""Part of a channel's greatest size by which it may differ: sums of other lengths round otherwise."""


class StretchTests:
    """Tests of :meth:`Family.stretches`."""

    family: ClassVar[type[Family[Any]]]
    samples: ClassVar[int] = 361
    """Samples of the motions under test; more where the motion has sharp turns."""

    def params(self, table: Mapping[str, Any]) -> Parameters:
        """The parameters of a table."""
        params: Parameters = self.family.Params.model_validate(dict(table))
        return params

    def test_stretches(self, design: Mapping[str, Any]) -> None:
        """Put together, the stretches of a motion are the motion, and each has its figures."""
        family, params, samples = self.family(), self.params(design), FINER * self.samples
        whole = family.solve(params, samples)
        with pytest.MonkeyPatch.context() as patched:
            patched.setattr(stretch, "TOGETHER", self.samples)
            patched.setattr(stretch, "LEAD", self.samples)
            parts = list(family.stretches(params, samples))
        assert_put_together(parts, whole)


def assert_put_together(parts: Sequence[Motion], whole: Motion) -> None:
    """Assert that motions that follow each other are one motion, but for rounding.

    >>> from mechwright.contracts.motion import Channel
    >>> still = [Motion("t", {"t": Channel(np.arange(count), "s")}) for count in (2, 3)]
    >>> assert_put_together(still[:1], still[0])
    """
    for one in parts:
        for name in ("scalars", "traces", "joints", "loads", "input_name"):
            assert getattr(one, name) == getattr(whole, name), f"a stretch has other {name}"
        assert one.curves.keys() == whole.curves.keys(), "a stretch has other curves"
        assert one.channels.keys() == whole.channels.keys(), "a stretch has other channels"
        assert one.poses.keys() == whole.poses.keys(), "a stretch has other bodies"
    for name, channel in whole.channels.items():
        assert {one.channels[name].unit for one in parts} == {channel.unit}
        _assert_same([one.channels[name].values for one in parts], channel.values, f"channel {name}")
    for body, poses in whole.poses.items():
        _assert_same([one.poses[body].frames for one in parts], poses.frames, f"poses of body {body}")
        if (rates := poses.rates) is not None:
            own = [one.poses[body].rates for one in parts]
            for which in ("first", "second"):
                pieces = [getattr(one, which) for one in own]
                _assert_same(pieces, getattr(rates, which), f"{which} rates of body {body}")


def _assert_same(pieces: Sequence[Array], whole: Array, what: str) -> None:
    size = np.abs(whole[np.isfinite(whole)]).max(initial=0.0)
    np.testing.assert_allclose(
        np.concatenate(pieces), whole, rtol=0, atol=SAME * size + NOTHING, err_msg=f"{what} in stretches"
    )
