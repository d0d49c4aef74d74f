"""Layers: what shares a height stays apart at every instant, and no stack is higher than it must be."""

import math

import numpy as np
import pytest
import shapely

from mechwright.contracts.motion import Poses
from mechwright.errors import GeometryError
from mechwright.mechanics.linkage import Boss, Closeness, Plate, Spindle, disc, hull_link, rectangle, stack

ANGLES = np.linspace(0, math.tau, 181)
STILL = Poses.planar(0.0, 0.0, np.zeros(181))


def crank(radius=20.0, angle=ANGLES):
    return Poses.planar(0.0, 0.0, angle)


GROUND = Plate("base", "ground", rectangle(-80 - 80j, 80 + 80j, 5.0), 8.0, (0,))
ARM = Plate("arm", "crank", hull_link([Boss(0j, 6, 4), Boss(20 + 0j, 6, 4)]), 5.0)
SHAFT = Spindle("shaft", "crank", 0j, 2.0, ("base", "arm"))


def stop(x, size=4.0):
    return Plate("stop", "ground", disc(size, (), complex(x, 0)), 6.0)


def test_what_stays_clear_shares_a_layer():
    found = stack([GROUND, ARM, stop(40.0)], [SHAFT], {"ground": STILL, "crank": crank()}, 0.5, 0.3)
    assert found.layer == {"base": 0, "arm": 1, "stop": 1}
    assert [layer.bottom for layer in found.layers] == pytest.approx([0, 8.3])
    assert found.layers[1].thickness == 6.0  # the thickest of the layer
    assert found.spans["shaft"] == pytest.approx((0.0, 13.3))
    assert found.bottom("arm") == pytest.approx(8.3)


def test_what_is_swept_goes_to_another_layer():
    found = stack([GROUND, ARM, stop(24.0)], [SHAFT], {"ground": STILL, "crank": crank()}, 0.5, 0.3)
    # The arm stays low, since its shaft is then the shorter.
    assert found.layer == {"base": 0, "arm": 1, "stop": 2}


def test_the_clearance_counts():
    """The arm reaches to 26 mm, the stop begins at 27.5 mm."""
    poses = {"ground": STILL, "crank": crank()}
    assert stack([GROUND, ARM, stop(31.5)], [SHAFT], poses, 0.2, 0.3).layer["stop"] == 1
    assert stack([GROUND, ARM, stop(31.5)], [SHAFT], poses, 2.0, 0.3).layer["stop"] == 2


def test_what_happens_between_samples_counts():
    """Four samples never see the arm near the stop at 45 degrees."""
    angle = np.linspace(0, math.tau, 5)
    poses = {"ground": Poses.planar(0.0, 0.0, np.zeros(5)), "crank": crank(angle=angle)}
    corner = Plate("stop", "ground", disc(4.0, (), 17 + 17j), 6.0)
    placed = [hull_link([Boss(0j, 6), Boss(20 + 0j, 6)]).moved(0, 0, a).polygon() for a in angle]
    assert min(shapely.distance(p, corner.outline.polygon()) for p in placed) > 2
    assert stack([GROUND, ARM, corner], [SHAFT], poses, 0.2, 0.3).layer["stop"] == 2


def test_a_spindle_needs_its_way():
    """A lid over the arm must not stand on the shaft that ends under it, and a third plate not in its way."""
    lid = Plate("lid", "ground", rectangle(-10 - 10j, 10 + 10j, 2.0), 3.0)
    found = stack([GROUND, ARM, lid], [SHAFT], {"ground": STILL, "crank": crank()}, 0.5, 0.3)
    assert found.layer == {"base": 0, "arm": 1, "lid": 2}
    long = Spindle("shaft", "crank", 0j, 2.0, ("base", "arm"), head=4.0)
    with pytest.raises(GeometryError, match="the shaft hits lid"):
        stack([GROUND, ARM, lid], [long], {"ground": STILL, "crank": crank()}, 0.5, 0.3)


def test_neighbours_may_touch():
    rail = Plate("rail", "ground", rectangle(-50 + 10j, 50 + 20j, 1.0), 6.0)
    block = Plate("block", "slider", rectangle(-8 - 9.95j, 8 + 9.95j, 1.0), 6.0)
    slide = Poses.planar(20 * np.cos(ANGLES), 0.0, np.zeros(181))
    poses = {"ground": STILL, "slider": slide}
    base = [GROUND, rail, block]
    assert stack(base, [], poses, 0.5, 0.3, [("block", "rail")]).layer == {"base": 0, "rail": 1, "block": 1}
    assert max(stack(base, [], poses, 0.5, 0.3).layer.values()) == 2


def test_nothing_comes_near_outside_of_what_is_swept():
    """Twelve samples see the arm's end at 26 mm only in some directions; the bounds hold it everywhere."""
    angle = np.linspace(0.1, 0.1 + math.tau, 13)
    poses = {"crank": crank(angle=angle)}
    bounds = Closeness([ARM], [], poses, 0.5).swept(["arm"])
    assert all(26.5 < abs(edge) < 26.5 + 8.0 for edge in bounds)
    fine = Closeness([ARM], [], {"crank": crank(angle=np.linspace(0, math.tau, 3601))}, 0.5).swept(["arm"])
    assert np.abs(fine) == pytest.approx(26.5, abs=0.2)


def test_no_way_names_the_pairs():
    fixed = Plate("stop", "ground", disc(4.0, (), 20 + 0j), 6.0, (1,))
    arm = Plate("arm", "crank", ARM.outline, 5.0, (1,))
    with pytest.raises(GeometryError, match="arm and stop meet in plan"):
        stack([GROUND, arm, fixed], [SHAFT], {"ground": STILL, "crank": crank()}, 0.5, 0.3)


def test_a_missing_body_is_named():
    with pytest.raises(GeometryError, match="no poses of crank"):
        stack([GROUND, ARM], [SHAFT], {"ground": STILL}, 0.5, 0.3)


@pytest.mark.parametrize(("gap", "meets"), [(0.2, True), (5.0, False)])
def test_a_spindle_that_comes_by_for_a_moment_is_met_at_any_instant(gap, meets):
    """A pin at 20 mm of the crank passes a small disc, at one of its samples or between two of them."""
    pin = Spindle("pin", "crank", 20 + 0j, 1.0, ("arm",))
    for at in np.linspace(0.0, math.tau, 38)[:-1]:
        middle = (20 + 1 + gap + 2) * complex(math.cos(at), math.sin(at))
        plate = Plate("plate", "ground", disc(2.0, (), middle), 3.0)
        close = Closeness([ARM, plate], [pin], {"ground": STILL, "crank": crank()}, 0.5)
        assert close.spindle(pin, plate, 1.0) is meets
