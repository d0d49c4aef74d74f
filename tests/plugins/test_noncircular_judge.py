"""What the judge of non-circular gears finds: the errors of the check, without advice, and what designs share."""

import pytest

from mechwright import Stage
from mechwright.contracts.finding import errors
from mechwright_noncircular_gears.family import NoncircularGears
from mechwright_noncircular_gears.kinematics.law import law_of
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.table import table_of

FAMILY = NoncircularGears()

REFUSED = (
    {"sines": [60.0]},
    {"law": "limacon", "lobes": 2, "mate_lobes": 2, "cutter": "rack", "eccentricity": 0.3},
    {"sines": [24.0], "teeth": 20, "bore": 6},
    {"teeth": 12, "bore": 4, "pressure_angle": 15},
    {"addendum": 1.4, "dedendum": 1.55, "tip_radius": 0.05, "pressure_angle": 25},
    {"law": "ratio", "ratio": "1 + 1.1*cos(phi)"},
    {"law": "slider", "teeth": 51, "rod_ratio": 3.03, "stroke_start": 46.0, "stroke_end": 139.0, "bore": 4},
)
"""Tables whose errors have advice that has to be sought."""


def params_of(table: dict[str, object]) -> SizedParams:
    return SizedParams.model_validate(table)


@pytest.mark.parametrize("table", REFUSED)
def test_the_judge_finds_what_check_finds_and_seeks_no_advice(table: dict[str, object]) -> None:
    told, plain = errors(FAMILY.check(params_of(table))), errors(FAMILY.judge(params_of(table)))
    assert told
    assert [(one.code, one.stage, one.parameter, one.message) for one in told] == [
        (one.code, one.stage, one.parameter, one.message) for one in plain
    ]
    assert any(one.proposed or "use" in one.remedy or "make" in one.remedy for one in told)
    if told[0].code in {"gear.undercut", "gear.tip-fillet", "gear.tip-cusp"}:
        assert told[0].proposed
        assert not plain[0].proposed


def test_advice_is_no_part_of_what_is_kept_for_the_judge() -> None:
    """Asked in either order, each gets its own."""
    for table in ({"teeth": 13, "bore": 4}, {"teeth": 12, "bore": 4}):
        asked = ("judge", "check") if table["teeth"] == 13 else ("check", "judge")
        answers = {one: errors(getattr(FAMILY, one)(params_of(table)), Stage.PARTS)[0] for one in asked}
        assert answers["check"].code == answers["judge"].code == "gear.undercut"
        assert answers["check"].proposed
        assert not answers["judge"].proposed


def test_designs_that_differ_in_bores_and_loads_share_law_and_teeth() -> None:
    one = params_of({"sines": [8.0], "teeth": 30})
    for other in ({"bore": 9.0}, {"load_torque": 3.0}, {"thickness": 7.0}, {"speed": 12.0}):
        same = one.model_copy(update=other)
        assert law_of(one) is law_of(same)
        assert all(a is b for a, b in zip(table_of(one).teeth, table_of(same).teeth, strict=True))
    assert law_of(one) is not law_of(one.model_copy(update={"sines": (9.0,)}))
    farther = one.model_copy(update={"centre_distance": 120.0, "module": None})
    assert law_of(farther) is law_of(one)
    assert table_of(farther).pair.distance == 120.0
    for other in ({"teeth": 31}, {"addendum": 0.9}, {"backlash": 0.2}, {"tooth_offset": 0.3}):
        assert table_of(one.model_copy(update=other)).teeth[0] is not table_of(one).teeth[0], other


def test_equal_designs_keep_what_each_leaves_out() -> None:
    given = params_of({"module": 1.0, "teeth": 30})
    every = SizedParams.model_validate(given.model_dump())
    assert given == every
    for one in (every, given, every):
        assert table_of(one).given.model_fields_set == one.model_fields_set
    assert table_of(given).teeth[0] is table_of(every).teeth[0]
