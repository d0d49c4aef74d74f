"""What is advised where an outside has no room for tabs is a change that ``check`` and ``fix`` can try."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from mechwright import DesignError, host
from mechwright.designs.design import design_of
from mechwright.remedies.advice import advised
from mechwright.remedies.keys import keys_of
from mechwright_cam.setup.tab_places import LEAST_TAB_WIDTH, tab_width

BORE = {"cam.hold.method": "bore"}


@pytest.mark.parametrize(
    ("slopes", "changes"), [(0.0, [BORE]), (3.0, [{"cam.hold.tab_shape": "rectangular"}, BORE])]
)
def test_no_room_for_tabs_advises_another_hold_by_its_key(slopes, changes):
    narrow = SimpleNamespace(name="outside", tab_sites=[(0.0, LEAST_TAB_WIDTH / 2)] * 4)
    with pytest.raises(DesignError, match=r"room for 0 tabs of at least .* not for 4; use ") as caught:
        tab_width(narrow, 4, slopes)
    design = design_of({"format": 1, "family": "elliptic-gears", "name": "a"}, Path("a.toml"), "", host())
    assert list(advised(str(caught.value), None, keys_of(design))) == changes
