"""What retains a body of a finished assembly: fits at their worst, rings, shoulders, compound."""

import pytest
from cam.test_assembly_holding import order_of, plate, turned

from mechwright import Instance, Part
from mechwright.contracts.fits import hole_fit, shaft_fit
from mechwright.contracts.part import Bore
from mechwright.contracts.turned import KeySeat, Turned
from mechwright.contracts.turned import Step as Length
from mechwright.standards.dowels import dowel_for
from mechwright_cad.assembly_order.inspections import unretained


def seated(hole, pin, form=None):
    """A plate with a hole, and a pin through it that moves with it."""
    seat = Bore("seat", (0.0, 0.0), hole_fit(8, hole).middle, 0.0, 6.0, hole_fit(8, hole))
    base = plate("base", 0.0, ((0.0, 0.0), seat.diameter), bores=(seat,))
    steps = (Length(8.0, 6.0, shaft_fit(8, pin)),)
    return base, turned("pin", 0.0, form or Turned(steps), body="base")


def said(*parts):
    return [(one.code, one.message.partition(":")[0]) for one in unretained(order_of(*parts))]


@pytest.mark.parametrize(
    ("hole", "pin", "is_loose"),
    [
        ("P7", "h6", False),  # tight at both limits
        ("J7", "h6", True),  # may have play
        ("N7", "h6", True),
        ("H7", "m6", True),
        ("H7", "r6", False),
        ("H7", "h6", False),  # slides, so it is bonded
    ],
)
def test_a_pin_stays_if_its_fit_is_tight_at_both_limits_or_bonded(hole, pin, is_loose):
    found = said(*seated(hole, pin))
    assert found == (
        [("assembly.loose", "pin of base can leave its place along (0, 0, -1)")] if is_loose else []
    )


def test_a_head_stops_a_loose_pin_on_its_side_alone():
    headed = Turned((Length(8.0, 6.0, shaft_fit(8, "h6")), Length(14.0, 3.0)))
    ((_, words),) = said(*seated("J7", "h6", headed))
    assert words.endswith("(0, 0, 1)")
    found = said(*seated("J7", "h6", headed), plate("lid", 9.0, body="base"))
    assert {words.partition(" ")[0] for _, words in found} == {"pin", "lid"}, "the lid is pushed away"


def test_a_dowel_is_bonded_in_its_own_plate_and_slides_in_the_other():
    own, other = hole_fit(4, "H7"), hole_fit(4, "F7")
    plates = [
        plate(name, z, ((0.0, 0.0), fit.middle), bores=(Bore("seat", (0.0, 0.0), fit.middle, 0.0, 6.0, fit),))
        for name, z, fit in (("base", 0.0, own), ("rail", 6.0, other))
    ]
    pin = Part("dowel", None, 0.0, "steel", (Instance("base", 0.0),), bought=dowel_for(4, 12).bought)
    order = order_of(*plates, pin, together=(("base", "rail"),))
    kinds = {order.bodies[one.hole].part.name: order.seats.kind(one) for one in order.seats.matches}
    assert kinds == {"base": "bonded", "rail": "pressed"}
    assert [one.joins for one in order.retention.fastenings] == [frozenset((0, 2))], (
        "a push fit does not last"
    )


def test_a_keyed_hub_without_a_ring_is_bonded():
    keyed = Turned((Length(8.0, 6.0, shaft_fit(8, "h6")),), seats=(KeySeat(0.0, 6.0, 2.0, 2.8),))
    order = order_of(*seated("H7", "h6", keyed))
    assert [order.seats.kind(one) for one in order.seats.matches] == ["bonded"]


@pytest.mark.parametrize(
    ("beside", "stretched", "held"), [((1, 2), True, True), ((1,), True, False), ((1, 2), False, False)]
)
def test_a_spring_is_held_by_its_pull_between_two_bodies_alone(beside, stretched, held):
    from types import SimpleNamespace

    from mechwright_cad.assembly_order.holding import Holding

    bought = SimpleNamespace(stretched=stretched)
    bodies = [SimpleNamespace(part=SimpleNamespace(bought=bought))]
    blocking = SimpleNamespace(bodies=bodies, neighbours={0: beside})
    whole = SimpleNamespace(blocking=blocking)
    whole._is_spring = lambda unit: Holding._is_spring(whole, unit)
    assert Holding._hooked(whole, (0,)) is held
