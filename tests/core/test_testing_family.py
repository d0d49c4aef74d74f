"""The family contract lets an honest family pass, and names what is wrong with a broken one."""

import dataclasses
import math
from typing import Annotated

import numpy as np
import pytest
from disc_family import Disc, DiscParams
from pydantic import Field

from mechwright.contracts.finding import Finding, Severity
from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import Channel, Motion, Poses, Scalar
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import Bore, Instance, Profile
from mechwright.errors import PluginFaultError
from mechwright.geometry import Arc, Loop, Outline, circle
from mechwright.testing import FamilyContract
from mechwright.units import Millimetres, Unit

EXAMPLE: dict[str, object] = {}


class TestDisc(FamilyContract):
    """The contract itself, on the honest family."""

    family = Disc
    examples = ({}, {"bore": "0.5 in", "diameter": 60, "holes": 0, "material": "brass"})
    refused = (
        ({"diameter": "1 s"}, "diameter"),
        ({"colour": "red"}, "colour"),
        ({"bore": 39}, "bore"),
        ({"holes": 12, "diameter": 24, "bore": 2}, "holes"),
        ({"diameter": 500, "speed": 1000}, "speed"),
    )
    derivatives = (("theta", "omega"), ("y", "speed_y"))
    input_rate = "omega"


def contract(family, **attributes):
    settings = {"derivatives": TestDisc.derivatives, "input_rate": "omega"} | attributes
    return type("Contract", (FamilyContract,), {"family": family, **settings})()


def run(family, test, **attributes):
    """Run one test of the contract on a family; design tests get the defaults."""
    call = getattr(contract(family, **attributes), test)
    if "design" in call.__code__.co_varnames[: call.__code__.co_argcount]:
        return call(EXAMPLE)
    return call()


def assert_refused(family, test, words, **attributes):
    with pytest.raises(AssertionError) as caught:
        run(family, test, **attributes)
    assert words in str(caught.value)


def assert_guarded(family, test, words):
    with pytest.raises(PluginFaultError) as caught:
        run(family, test)
    assert words in str(caught.value)


def with_params(**fields):
    """The family with other fields."""
    namespace = {"__annotations__": {}, "__module__": __name__}
    for name, (annotation, field) in fields.items():
        namespace["__annotations__"][name] = annotation
        namespace[name] = field
    return type("Other", (Disc,), {"Params": type("OtherParams", (DiscParams,), namespace)})


def with_motion(change):
    class Other(Disc):
        def solve(self, params, samples):
            return change(super().solve(params, samples), params)

    return Other


def with_channel(name, values, unit):
    return with_motion(
        lambda motion, _: dataclasses.replace(
            motion, channels={**motion.channels, name: Channel(values(motion.samples), unit)}
        )
    )


def with_part(**changes):
    class Other(Disc):
        def parts(self, params):
            return [dataclasses.replace(part, **changes) for part in super().parts(params)]

    return Other


def with_finding(*arguments, **more):
    class Other(Disc):
        def found(self, params):
            return [*super().found(params), Finding(*arguments, **more)]

    return Other


@pytest.mark.parametrize(
    ("attributes", "words"),
    [
        ({"name": "Disc"}, "name 'Disc'"),
        ({"title": "A disc."}, "full stop"),
        ({"title": ""}, ""),
        ({"summary": "a disc"}, "one sentence"),
        ({"api": 0}, "0"),
    ],
)
def test_names(attributes, words):
    assert_refused(type("Other", (Disc,), attributes), "test_names", words)


def test_a_heavy_import_is_seen():
    other = type("Other", (Disc,), {"__module__": "shapely.geometry"})
    assert_refused(other, "test_import_is_light", "shapely")
    other = type("Other", (Disc,), {"__module__": "no_such_module"})
    assert_refused(other, "test_import_is_light", "import no_such_module fails")


class Nested(Parameters):
    width: Millimetres = Field(1.0, ge=0, description="No greatest value.")


@pytest.mark.parametrize(
    ("annotation", "field", "words"),
    [
        (Millimetres, Field(1.0, ge=0, le=9), "extra has no description"),
        (Millimetres, Field(1.0, ge=0, le=9, description="  "), "extra has no description"),
        (Millimetres, Field(1.0, le=9, description="X."), "extra has no least value"),
        (Millimetres, Field(1.0, ge=0, description="X."), "extra has no greatest value"),
        (Millimetres | None, Field(None, ge=0, description="X."), "extra has no greatest value"),
        (float, Field(1.0, ge=0, le=9, description="X."), "extra has no unit"),
        (int, Field(1, description="X."), "extra has no least value"),
        (
            Annotated[float, Unit("wobble")],
            Field(1.0, ge=0, le=9, description="X."),
            "unit 'wobble' is not known",
        ),
        (tuple[float, ...], Field((), description="X."), "extra has no least value"),
        (dict[str, float], Field({}, description="X."), "extra has no unit"),
        (Nested, Field(Nested(), description="X."), "Nested.width has no greatest value"),
    ],
)
def test_schema(annotation, field, words):
    assert_refused(with_params(extra=(annotation, field)), "test_schema", words)


def test_what_toml_cannot_say_does_not_round_trip():
    # None cannot be written, so a default that is not None can never be taken back.
    other = with_params(bore=(Millimetres | None, Field(20.0, ge=1, le=400, description="Hole.")))
    call = contract(other).test_design_round_trips
    call({})
    with pytest.raises(AssertionError):
        call({"bore": None})


def test_an_example_that_does_not_build():
    with pytest.raises(AssertionError, match=r"disc\.wall"):
        contract(Disc).test_design_builds({"bore": 39})


def test_a_family_without_parts():
    assert_refused(type("Other", (Disc,), {"parts": lambda *_: []}), "test_design_builds", "0 > 0")


@pytest.mark.parametrize(
    ("finding", "words"),
    [
        (("wall", Severity.NOTE, "", "x"), "a code is lower-case words with dots"),
        (("Disc.wall", Severity.NOTE, "", "x"), "a code is"),
        (("disc.wall", Severity.NOTE, "", ""), "the message is one line"),
        (("disc.wall", Severity.NOTE, "", "a\nb"), "the message is one line"),
        (("disc.wall", Severity.WARNING, "bore", "x"), "names a parameter and says what to do"),
        (
            ("disc.wall", Severity.ERROR, "", "x", None, None, "", "y"),
            "names a parameter and says what to do",
        ),
        (("disc.wall", Severity.NOTE, "boer", "x"), "there is no parameter 'boer'"),
        (("disc.wall", Severity.NOTE, "bore.depth", "x"), "there is no parameter 'bore.depth'"),
        (("disc.wall", Severity.NOTE, "cam", "x"), "there is no parameter 'cam'"),
        (("disc.wall", Severity.NOTE, "", "x", 1.0, None, "mmm"), "unit 'mmm' is not known"),
    ],
)
def test_findings(finding, words):
    assert_refused(with_finding(*finding), "test_findings", words)


def test_findings_may_be_about_the_cam_table():
    run(with_finding("disc.cutter", Severity.NOTE, "cam.tools", "x"), "test_findings")


@pytest.mark.parametrize(
    ("name", "values", "unit", "words"),
    [
        ("x", lambda n: np.zeros(n), "mmm", "channel x: unit 'mmm' is not known"),
        ("x", lambda n: np.zeros(n, dtype=int), "mm", "values are int64, not float64"),
        ("x [mm]", lambda n: np.zeros(n), "mm", "a name is letters"),
        (
            "theta",
            lambda n: np.sin(np.linspace(0, 3, n)),
            "rad",
            "input theta: goes there and back, which needs a channel time [s]",
        ),
        ("theta", lambda n: np.sin(np.linspace(0, 6, n)), "rad", "input theta: goes back more than once"),
        (
            "theta",
            lambda n: np.maximum(np.linspace(0, 3, n), 1.0),
            "rad",
            "input theta: neither rising nor falling",
        ),
    ],
)
def test_channels(name, values, unit, words):
    assert_refused(with_channel(name, values, unit), "test_channels", words)


def test_scalars():
    def change(motion, _):
        return dataclasses.replace(motion, scalars={"b": Scalar(1.0, "x!")})

    assert_refused(with_motion(change), "test_channels", "scalar b: unit 'x!' is not known")


def test_what_the_guard_finds_is_found_by_the_kit():
    """The kit calls a family as the program does, through the guard, which tells these mistakes itself."""

    def hollow(motion, _):
        old = motion.channels["y"]
        values = np.where(np.arange(len(old.values)) == 7, np.nan, old.values)
        return dataclasses.replace(motion, channels={**motion.channels, "y": Channel(values, old.unit)})

    def endless(motion, _):
        return dataclasses.replace(motion, scalars={"a": Scalar(math.inf, "mm")})

    assert_guarded(with_motion(hollow), "test_channels", "channel 'y' is nan at sample 7")
    assert_guarded(with_motion(endless), "test_channels", "figure 'a' is inf")
    assert_guarded(
        with_finding("disc.wall", Severity.NOTE, "", "x", math.nan), "test_findings", "not a number"
    )
    assert_guarded(
        with_finding("disc.wall", Severity.NOTE, "", "x", math.inf),
        "test_findings",
        "value of what it gives is inf",
    )
    assert_guarded(
        with_finding("disc.wall", Severity.NOTE, "", "x", np.int64(3)), "test_findings", "a number of Python"
    )
    assert_guarded(
        with_finding("disc.wall", "fatal", "", "x"), "test_findings", "severity of what it gives is 'fatal'"
    )
    assert_guarded(with_part(colour=(0.1, 0.2, 1.2)), "test_parts", "has the colour (0.1, 0.2, 1.2)")
    assert_guarded(
        type("Twins", (Disc,), {"parts": lambda self, params: Disc.parts(self, params) * 2}),
        "test_parts",
        "two parts are called 'disc'",
    )


def test_samples_that_are_not_honoured():
    class Fixed(Disc):
        def solve(self, params, samples):
            return super().solve(params, 91)

    class OneShort(Disc):
        """Leaves the last instant out."""

        def solve(self, params, samples):
            motion = super().solve(params, samples + 1)
            return Motion("theta", {k: Channel(c.values[:-1], c.unit) for k, c in motion.channels.items()})

    assert_guarded(Fixed, "test_samples", "gives 91 samples; 46 are asked for")
    assert_refused(OneShort, "test_samples", "depends on the number of samples")


def test_poses():
    def mirror(motion, _):
        poses = motion.poses["disc"]
        return dataclasses.replace(motion, poses={"disc": Poses(poses.position, -poses.rotation)})

    def stretch(motion, _):
        poses = motion.poses["disc"]
        return dataclasses.replace(motion, poses={"disc": Poses(poses.position, 1.001 * poses.rotation)})

    def lose(motion, _):
        poses = motion.poses["disc"]
        return dataclasses.replace(motion, poses={"disc": Poses(poses.position * np.nan, poses.rotation)})

    def held(one, **how):
        shaft = Joint("revolute", GROUND, "disc", **how)
        return with_motion(lambda motion, _: dataclasses.replace(motion, joints={one: shaft}))

    run(held("shaft", drives=True), "test_poses")
    assert_refused(held("rim", point=(5.0, 0.0, 0.0)), "test_poses", "joint rim: its point comes apart by")
    assert_refused(with_motion(mirror), "test_poses", "body disc: sample 0 is no rotation")
    assert_guarded(with_motion(stretch), "test_poses", "rotations of body 'disc' are no rotations")
    assert_guarded(with_motion(lose), "test_poses", "body 'disc'")
    assert_refused(with_part(instances=(Instance("rim"),)), "test_poses", "no poses of ['rim']")


def test_derivatives():
    wrong_sign = with_channel("speed_y", lambda n: -125 * np.cos(np.linspace(0, math.tau, n)), "mm/s")
    assert_refused(wrong_sign, "test_derivatives", "channel speed_y: ")

    def a_millionth(motion, _):
        old = motion.channels["speed_y"]
        return dataclasses.replace(
            motion, channels={**motion.channels, "speed_y": Channel(old.values * (1 + 1e-6), old.unit)}
        )

    assert_refused(with_motion(a_millionth), "test_derivatives", "channel speed_y: ")

    def unit(motion, _):
        old = motion.channels["speed_y"]
        return dataclasses.replace(motion, channels={**motion.channels, "speed_y": Channel(old.values, "mm")})

    assert_refused(with_motion(unit), "test_derivatives", "speed_y [mm] is no rate of y [mm]")
    with pytest.raises(pytest.skip.Exception):
        run(Disc, "test_derivatives", derivatives=())


RIM = Loop((circle((0, 0), 20),))
HOLE = Loop((circle((0, 0), 10, clockwise=True),))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"material": "wood"}, None),
        ({"outline": Outline(RIM, (HOLE,), deviation=0.01)}, "deviation 0.01 mm, limit 0.001 mm"),
        ({"outline": Outline(RIM, (HOLE.moved(15, 0),))}, None),
    ],
)
def test_parts(changes, words):
    if words is None:
        with pytest.raises((ValueError, PluginFaultError), match=r"wood|cuts itself"):
            run(with_part(**changes), "test_parts")
    else:
        assert_refused(with_part(**changes), "test_parts", words)


OUTSIDE = Profile("rim", RIM, "outside", 0, 5.0)
BORE = Bore("bore", (0, 0), 20.0, 0, 5.0)


@pytest.mark.parametrize(
    ("features", "words"),
    [
        (
            (OUTSIDE, dataclasses.replace(BORE, depth=5.1)),
            "feature bore of part disc is deeper than",
        ),
        ((OUTSIDE, dataclasses.replace(BORE, top=1.0)), "feature bore of part disc is deeper"),
        ((OUTSIDE, dataclasses.replace(BORE, top=-1.0)), "top -1.0 mm"),
        ((OUTSIDE, dataclasses.replace(BORE, depth=0.0)), "depth 0.0 mm"),
        ((OUTSIDE, dataclasses.replace(BORE, diameter=0.0)), "diameter 0.0 mm"),
        ((OUTSIDE, dataclasses.replace(BORE, name="rim")), "feature names"),
        ((OUTSIDE,), "features and outline differ by 314.1 mm²"),
        ((OUTSIDE, dataclasses.replace(BORE, diameter=21.0)), "features and outline differ"),
        ((OUTSIDE, dataclasses.replace(BORE, depth=4.0)), "features and outline differ"),
        ((BORE,), "features and outline differ"),
    ],
)
def test_features(features, words):
    outline = Outline(RIM, (HOLE,))
    run(with_part(outline=outline, machined=(OUTSIDE, BORE)), "test_features")
    assert_refused(with_part(outline=outline, machined=features), "test_features", words)


def test_a_keyway_may_be_cut_as_a_bore_and_a_profile():
    half = math.asin(3 / 10)
    key = [(10 * math.cos(half), 3), (12.0, 3), (12.0, -3), (10 * math.cos(half), -3)]
    lines = Loop.polygon([key[2], key[3], key[0], key[1]]).segments
    loop = Loop((lines[0], Arc((0, 0), 10, -half, -math.tau + 2 * half), lines[2], lines[3]))
    machined = (OUTSIDE, BORE, Profile("keyway", loop, "inside", 0, 5.0))
    run(with_part(outline=Outline(RIM, (loop,)), machined=machined), "test_features")
