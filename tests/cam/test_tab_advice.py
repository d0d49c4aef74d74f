"""What is advised where an outside has no room for tabs is a change that ``check`` and ``fix`` can try."""

from pathlib import Path
from types import SimpleNamespace

import pytest

import mechwright as mw
from mechwright import DesignError, host
from mechwright.contracts.finding import errors
from mechwright.designs.design import design_of
from mechwright.remedies.advice import advised
from mechwright.remedies.keys import keys_of
from mechwright_cam.inspection import Machinable
from mechwright_cam.planning.remarks import refusal
from mechwright_cam.setup.tab_places import LEAST_TAB_WIDTH, tab_width

TAPE = {"cam.hold.method": "none", "cam.hold.bed": "tape"}
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


def test_a_part_too_small_for_tabs_and_clamp_is_taped_down():
    """A film's Geneva wheel: its horns are too thin for tabs, its bore is too small for a clamp."""
    error = DesignError("cam.hold.tabs: outside has room for 0 tabs of at least 0.5 mm, not for 4; use bore")
    found = refusal(error, part="wheel")
    assert found.message.startswith("wheel: outside has room")
    assert found.proposed == (BORE, TAPE)
    sizes = {"law": "straight", "entry_radius": 15, "thickness": 4, "speed": 960, "load_inertia": 1e-6}
    for hold, codes in (({}, ["cam.cannot-cut"]), ({"method": "none", "bed": "tape"}, [])):
        film = mw.design("geneva", cam={"hold": hold}, **sizes)
        assert [one.code for one in errors(Machinable().findings(film))] == codes
