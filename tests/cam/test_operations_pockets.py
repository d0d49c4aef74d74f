"""Nothing reachable stays in random pockets; ``benchmarks/random_pockets.py`` runs hundreds more."""

import re

import pytest
from by_night import examples
from random_pockets import case


@pytest.mark.parametrize("seed", range(examples(16, 40)))
def test_a_random_pocket_is_cut_to_the_last_corner_or_refused(seed):
    found = case(seed)
    if isinstance(found, str):
        assert re.fullmatch(r"cam\.tools: .*|part plate: pocket takes nothing .*", found)
        return
    assert found.ok, [check.message for check in found.failures]
    assert found.leftover_reachable_max_mm <= 0.010
    assert found.cutting_length_mm > 0
