"""The family as a plugin: contracts, parts, cuts, and random designs."""

import math
import subprocess
import sys
from functools import cache

import numpy as np
import pytest
import scipy.special
import shapely
from by_night import examples
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from mechwright.contracts.finding import Severity, Stage, errors
from mechwright.contracts.part import Bore, Profile
from mechwright.errors import DesignError, GeometryError
from mechwright.plugins.host import Host
from mechwright_elliptic_gears import plugin
from mechwright_elliptic_gears.family import EllipticGears

FAMILY = EllipticGears()
Params = EllipticGears.Params
REFERENCE = {"eccentricity": 0.4, "teeth": 39, "module": 2.0, "bore": 10.0, "backlash": 0.0}
KEYED = {"bore": 20.0, "keyway_width": 6.0, "keyway_relief": 3.0}


def test_the_plugin_registers_the_family():
    host = Host()
    host.add(plugin, "mechwright", "elliptic-gears")
    assert host.broken == []
    assert isinstance(host.family("elliptic-gears"), EllipticGears)


@given(st.floats(0, 0.8), st.integers(15, 99), st.floats(0.3, 3), st.booleans())
def test_a_bore_that_is_left_out_is_the_largest_that_leaves_the_rim(e, teeth, module, by_axis):
    a = module * math.pi * teeth / (4 * float(scipy.special.ellipe(e * e)))
    params = Params(eccentricity=e, teeth=teeth, **({"semi_major": a} if by_axis else {"module": module}))
    # From the near vertex to the roots, then 1.2 heights of a tooth; a module adds 1 and 1.25 of them.
    room = 2 * (a * (1 - e) - (1.25 + 1.2 * 2.25) * module)
    sold = (10.0, 8.0, 6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0)
    assume(min(abs(room - one) for one in sold) > 1e-3 * a)
    assert params.bore == next((one for one in sold if one < room), 10.0)


def test_nothing_heavy_is_imported_with_the_plugin_or_by_a_check():
    heavy = "('scipy', 'shapely', 'cadquery', 'ezdxf', 'pint')"
    script = (
        "import sys\n"
        "import mechwright_elliptic_gears.plugin\n"
        f"print([name for name in ('numpy', *{heavy}) if name in sys.modules])\n"
        "from mechwright_elliptic_gears.family import EllipticGears\n"
        "family = EllipticGears()\n"
        "family.check(family.Params()); family.solve(family.Params(), 5)\n"
        f"print([name for name in {heavy} if name in sys.modules])\n"
        "family.parts(family.Params())\n"  # whose outlines are looked over
        f"print([name for name in {heavy} if name in sys.modules])\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == ["[]", "[]", "['shapely']"]


def test_fields_have_bounds_units_and_text():
    schema = Params.model_json_schema()["properties"]
    for name, field in schema.items():
        assert field["description"], name
        kinds = field.get("anyOf", [field])
        if any(kind["type"] == "number" for kind in kinds):
            bounded = next(kind for kind in kinds if kind["type"] == "number")
            assert {"minimum", "exclusiveMinimum"} & set(bounded), name
            assert {"maximum", "exclusiveMaximum"} & set(bounded), name


def test_tables_go_round():
    for table in ({}, REFERENCE, KEYED, {"backlash": 0.1, "tooth_offset": 0.5}):
        params = Params(**table)
        assert Params.model_validate(params.model_dump()) == params
        assert Params.model_validate_json(params.model_dump_json()) == params


def test_one_part_stands_in_the_mechanism_twice():
    (part,) = FAMILY.parts(Params(**REFERENCE))
    motion = FAMILY.solve(Params(**REFERENCE), 3)
    assert part.name == "gear"
    assert [instance.body for instance in part.instances] == ["gear-2", "gear-4"]
    assert {instance.body for instance in part.instances} <= set(motion.poses)
    assert (part.thickness, part.material) == (10.0, "aluminium")
    assert [feature.name for feature in part.features] == ["bore", "outside"]
    bore, outside = part.features
    assert isinstance(bore, Bore)
    assert bore.diameter == 10.0
    assert isinstance(outside, Profile)
    assert outside.depth == 10.0
    polygon = part.outline.polygon()
    assert len(polygon.interiors) == 1


def test_instances_stand_in_mesh():
    params = Params(**REFERENCE)
    (part,) = FAMILY.parts(params)
    motion = FAMILY.solve(params, 7)
    ring = np.column_stack((part.outline.outer.flatten(), np.zeros(len(part.outline.outer.flatten()))))
    for i in range(7):
        one, two = (
            shapely.Polygon(motion.poses[body].transform(ring)[i, :, :2]) for body in ("gear-2", "gear-4")
        )
        assert one.distance(two) < 5e-4
        assert one.intersection(two).area < 1e-3


def test_features_of_a_keyed_hub():
    (part,) = FAMILY.parts(Params(**KEYED))
    bore, keyway, outside = part.features
    assert (bore.name, bore.diameter, bore.depth) == ("bore", 20.0, 10.0)
    assert (keyway.name, keyway.side, keyway.loop) == ("keyway", "inside", part.outline.inner[0])
    assert (outside.name, outside.side) == ("outside", "outside")
    assert part.outline.polygon().is_valid
    # The keyway's floor: half the bore and the standard hub depth, towards the far vertex.
    assert max(s.end[0] for s in keyway.loop.segments if s.tag == "keyway") == pytest.approx(12.8)
    (blind,) = FAMILY.parts(Params(bore=0.0))
    assert [feature.name for feature in blind.features] == ["outside"]
    assert blind.outline.inner == ()


def test_tabs_may_stand_on_every_tip():
    (part,) = FAMILY.parts(Params(**REFERENCE))
    sites = part.features[-1].tab_sites
    ring = shapely.LinearRing(part.outline.outer.flatten())
    assert len(sites) == 39
    for site, width in sites:
        assert ring.distance(shapely.Point(site)) < 1e-3
        assert 0.2 * 2.0 < width < 2.0
        # A mark as wide as the site says stays clear of the space beside the tip.
        middle = np.array(site)
        assert shapely.Point(middle * (1 - 0.2 / np.hypot(*middle))).within(part.outline.polygon())


PERTURBED = {
    "eccentricity": 0.3,
    "teeth": 27,
    "semi_major": 51.0,
    "tooth_offset": 0.5,
    "pressure_angle": 21.0,
    "addendum": 0.95,
    "dedendum": 1.2,
    "tip_radius": 0.3,
    "backlash": 0.05,
    "thickness": 11.0,
    "material": "steel",
    "bore": 19.0,
    "keyway_width": 5.0,
    "keyway_depth": 3.1,
    "keyway_relief": 2.0,
    "speed": 61.0,
    "point_along": 0.4,
    "point_across": 3.0,
    "band": 7.0,
}

TRAIN = {"stages": 2, "teeth": 25, "bore": 12.0}
TRAIN_PERTURBED = {
    "phase": 91.0,
    "gap": 3.0,
    "pin_diameter": 8.0,
    "coupler_thickness": 5.0,
    "tracer_diameter": 4.0,
    "base_thickness": 12.0,
    "dowel_diameter": 3.0,
    "dowel_circle": 26.0,
}


def results(params):
    motion = FAMILY.solve(params, 5)
    return (
        [
            (part.name, part.outline, part.thickness, part.material, part.instances)
            for part in FAMILY.parts(params)
        ],
        [part.build().Volume() for part in FAMILY.parts(params) if part.build],
        motion.scalars,
        [channel.values.tolist() for channel in motion.channels.values()],
    )


@cache
def start_of_a_pair():
    return results(Params(**KEYED))


@cache
def start_of_a_train():
    return results(Params(**TRAIN))


@pytest.mark.parametrize("name", [*PERTURBED, "module"])
def test_every_parameter_changes_a_result(name):
    base = start_of_a_pair()
    other = KEYED | ({"module": 3.0} if name == "module" else {name: PERTURBED[name]})
    assert base != results(Params(**other))
    assert base == results(Params(**KEYED))


@pytest.mark.parametrize("name", TRAIN_PERTURBED)
def test_every_parameter_of_a_train_changes_a_result(name):
    base = start_of_a_train()
    assert base != results(Params(**TRAIN | {name: TRAIN_PERTURBED[name]}))
    with pytest.raises(ValidationError, match=f"{name} belongs to a train"):
        Params(**{name: TRAIN_PERTURBED[name]})


def test_a_train_is_no_pair():
    assert results(Params(**TRAIN)) != results(Params(**TRAIN | {"stages": 1}))


def test_all_fields_are_perturbed():
    joint = {"phase_joint", "phases", "clamp_screw", "clamp_screws"}  # see the tests of phase joints
    loads = {"load_torque"}  # see the tests of strength
    # See the tests of frames and of bushes.
    frame = {"bushes", "screw_hole", "screw_offset", "stub_diameter", "stub_length"}
    known = {*PERTURBED, *TRAIN_PERTURBED, *joint, *loads, *frame, "module", "stages"}
    assert known == set(Params.model_fields)


def cut(params, radius):
    """The part with every corner filled that a round cutter of this radius cannot enter."""
    (part,) = FAMILY.parts(params)
    target = part.outline.polygon(1e-4)
    return {"gear": target.buffer(radius, quad_segs=64).buffer(-radius, quad_segs=64)}


def test_cuts_of_the_reference_gear():
    params = Params(**REFERENCE)
    (note,) = FAMILY.check_cut(params, cut(params, 1.0))
    assert note.severity is Severity.NOTE
    (error,) = FAMILY.check_cut(params, cut(params, 1.25))
    assert (error.severity, error.parameter) == (Severity.ERROR, "cam.tools")
    assert error.value > error.limit
    assert FAMILY.check_cut(params, {}) == ()


def test_a_key_must_go_into_the_keyway_as_cut():
    def blamed(relief, radius):
        params = Params(**KEYED | {"keyway_relief": relief, "teeth": 25})
        return [(f.code, f.parameter) for f in errors(FAMILY.check_cut(params, cut(params, radius)))]

    assert blamed(3.0, 1.5) == []
    assert blamed(0.0, 1.5) == [("gear.cut-key", "keyway_relief")]
    # A corner radius of 0.25 mm is inside the key's own chamfer.
    assert blamed(0.0, 0.25) == []


def test_a_bore_that_no_cutter_enters():
    params = Params(bore=2.0)
    found = errors(FAMILY.check_cut(params, cut(params, 1.2)))
    assert [(f.code, f.parameter) for f in found] == [("gear.cut-bore", "cam.tools")]


def maybe(strategy):
    return st.one_of(st.none(), strategy)


designs = st.fixed_dictionaries(
    {
        "eccentricity": st.floats(0, 0.9),
        "teeth": st.one_of(st.integers(6, 45), st.integers(6, 80)),
        "bore": st.one_of(st.just(0.0), st.floats(0, 40)),
    },
    optional={
        "module": st.floats(0.1, 25),
        "semi_major": st.floats(2, 1000),
        "tooth_offset": maybe(st.one_of(st.sampled_from([0.0, 0.25, 0.5, 0.75]), st.floats(0, 0.999))),
        "pressure_angle": st.floats(10, 30),
        "addendum": st.floats(0.3, 1.5),
        "dedendum": st.floats(0.4, 2),
        "tip_radius": st.floats(0, 0.6),
        "backlash": st.one_of(st.floats(0, 0.2), st.floats(0, 2)),
        "keyway_width": st.one_of(st.sampled_from([2.0, 5.0, 6.0, 8.0]), st.floats(0, 60)),
        "keyway_depth": maybe(st.floats(0.01, 30)),
        "keyway_relief": st.floats(0, 20),
    },
)


@settings(
    max_examples=examples(20, 60),
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
)
@given(designs)
def test_random_designs_are_built_or_refused(table):
    try:
        params = Params(**table)
    except ValidationError:
        return
    found = FAMILY.check(params)
    for finding in found:
        assert finding.severity is Severity.NOTE or finding.remedy
        assert finding.severity is Severity.NOTE or finding.parameter in Params.model_fields
    if errors(found, Stage.PARTS):
        with pytest.raises((DesignError, GeometryError)):
            FAMILY.parts(params)
        return
    (part,) = FAMILY.parts(params)
    polygon = part.outline.polygon()
    assert polygon.is_valid
    assert polygon.area == pytest.approx(part.outline.area, rel=1e-3)
    assert part.outline.deviation <= 1e-3
    motion = FAMILY.solve(params, 9)
    assert all(np.isfinite(channel.values).all() for channel in motion.channels.values())
    assert all(np.isfinite(scalar.value) for scalar in motion.scalars.values())
