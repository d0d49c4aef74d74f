"""Parts of free form: their bores, the faces that these are in an assembly, and their fits."""

import math
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright import Instance, Part, Step, Turned
from mechwright.contracts.bodies import Placed, placed
from mechwright.contracts.fit_settings import Fits
from mechwright.contracts.fits import hole_fit
from mechwright.contracts.free_form import AngleSize, FormBore, FreeForm
from mechwright.contracts.holes import joined
from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.errors import GeometryError
from mechwright.mechanics.mating.fitted import with_fits
from mechwright.mechanics.mating.rounds import rounds_of

ASKEW = (0.6, 0.0, 0.8)


def block():
    import cadquery as cq

    return cq.Workplane("XY").box(60, 60, 60).val()


def form(*bores, **more):
    return FreeForm(partial(block), "casting", bores, **more)


def askew(diameter=6.05, fit=None):
    """A bore along (0.6, 0, 0.8) that starts 20 mm from the origin."""
    return FormBore("seat", tuple(20 * a for a in ASKEW), ASKEW, 9.0, diameter, fit)


def test_a_bore_takes_its_cylinder_from_the_body():
    free = FormBore("eye", (-30.0, 0.0, 0.0), (1.0, 0.0, 0.0), 60.0, 10.0)
    assert form(free)().Volume() == pytest.approx(60**3 - math.pi / 4 * 10**2 * 60, rel=1e-9)
    assert free.end == (30.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (
            lambda: FormBore("eye", (0, 0, 0), (1.0, 1.0, 0.0), 5.0, 3.0),
            "its axis .* has a length other than 1",
        ),
        (lambda: FormBore("eye", (0, 0, 0), (1.0, 0.0, 0.0), 0.0, 3.0), "both are above 0"),
        (lambda: form(askew(), askew()), "two bores seat"),
        (lambda: FreeForm(block, ""), "states its process"),
        (lambda: form(askew()).with_fits({"other": hole_fit(6, "H7")}), "no bore other; bores: seat"),
        (
            lambda: Part("arm", None, 0.0, "steel", turned=Turned((Step(4.0, 4.0),)), free_form=form()),
            "turned, bought or of free form, one of them alone",
        ),
    ],
)
def test_what_is_no_form_is_refused(wrong, message):
    with pytest.raises(GeometryError, match=message):
        wrong()


def test_equal_forms_make_equal_parts_and_other_bores_others():
    body = partial(block)
    one, two, wide = (
        Part("arm", None, 0.0, "steel", free_form=FreeForm(body, "casting", (askew(d),))) for d in (6, 6, 7)
    )
    assert one == two
    assert hash(one) == hash(two)
    assert one != wide
    assert one.kind == "solid"


@given(st.floats(0.01, 3.13))
def test_an_angle_is_that_between_its_directions(turn):
    size = AngleSize((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (math.cos(turn), 0.0, math.sin(turn)))
    assert size.degrees == pytest.approx(math.degrees(turn), rel=1e-9)


def test_the_face_of_a_bore_turns_with_its_body():
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    poses = Poses(np.array([[1.0, 2.0, 3.0]]), quarter[None])
    (face,) = rounds_of(
        Placed(Part("arm", None, 0.0, "steel", free_form=form(askew())), Instance(""), poses), 0
    )
    np.testing.assert_allclose(face.axis, (0.0, 0.6, 0.8), atol=1e-12)
    np.testing.assert_allclose(
        face.at, np.array((1.0, 2.0, 3.0)) + 20 * np.array((0.0, 0.6, 0.8)), atol=1e-12
    )
    assert (face.low, face.high, face.diameter, face.inside) == (0.0, 9.0, 6.05, True)


def fitted(turns):
    """An arm with an inclined bore, and the pin in it, which is fixed to the arm or turns in it."""
    frame = np.array([[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]])
    still = Poses.planar(0.0, 0.0, np.zeros(2))
    leaning = Poses(np.zeros((2, 3)), np.tile(frame, (2, 1, 1)))
    joints = {"base": Joint("fixed", GROUND, "arm")}
    joints["pin"] = (
        Joint("revolute", "arm", "pin", (0.0, 0.0, 0.0), ASKEW) if turns else Joint("fixed", "arm", "pin")
    )
    motion = Motion("t", {"t": Channel(np.zeros(2), "rad")}, {"arm": still, "pin": leaning}, joints=joints)
    arm = Part("arm", None, 0.0, "aluminium", (Instance("arm"),), free_form=form(askew()))
    pin = Part("pin", None, 0.0, "steel", (Instance("pin", 15.0),), turned=Turned((Step(6.0, 20.0),)))
    placed([arm, pin], motion)
    return with_fits([arm, pin], motion, Fits())


def test_a_pin_in_an_inclined_bore_gets_its_fit():
    arm, pin = fitted(turns=False)
    assert arm.free_form.bore("seat").fit.short == "6 P7"
    assert arm.free_form.bore("seat").diameter == pytest.approx(5.986)
    assert pin.turned.steps[0].fit.short == "6 h6"
    arm, _ = fitted(turns=True)
    assert arm.free_form.bore("seat").fit.limits == pytest.approx((6.04, 6.052))


def test_a_pressed_pin_stands_in_its_bore_by_design():
    arm, _ = fitted(turns=False)
    assert joined(arm).free_form.bore("seat").diameter == 6.0
    loose, _ = fitted(turns=True)
    assert joined(loose).free_form.bore("seat").diameter == pytest.approx(6.046)
