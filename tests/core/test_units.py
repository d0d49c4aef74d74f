import math
import subprocess
import sys
from decimal import Decimal
from typing import Annotated

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import Field, ValidationError

from mechwright.contracts.parameters import Parameters
from mechwright.units import (
    Degrees,
    Millimetres,
    MillimetresPerMin,
    Newtons,
    Ratio,
    RevPerMin,
    Unit,
    convert,
    kind,
)

patient = settings(deadline=None)  # imports and a busy machine are no faults
UNITS = {
    "mm": ["m", "in", "ft", "µm", "cm"],
    "deg": ["rad", "turn", "arcmin", "°"],
    "rpm": ["rad/s", "deg/s", "turn/min", "revolution / hour"],
    "mm/min": ["m/s", "in/min", "mm s^-1"],
    "s": ["ms", "min", "hour"],
    "N": ["kN", "lbf", "kg m/s^2"],
}


class Table(Parameters):
    length: Millimetres = Field(1.0, ge=-1e6, le=1e6, description="A length.")
    angle: Degrees = Field(1.0, ge=-1e6, le=1e6, description="An angle.")
    speed: RevPerMin = Field(1.0, ge=-1e6, le=1e6, description="A speed.")
    feed: MillimetresPerMin = Field(1.0, ge=-1e6, le=1e6, description="A feed.")
    force: Newtons = Field(1.0, ge=-1e6, le=1e6, description="A force.")
    ratio: Ratio = Field(1.0, ge=-1e6, le=1e6, description="A ratio.")


@pytest.mark.parametrize(("wanted", "other"), [(a, b) for a, others in UNITS.items() for b in others])
@patient
@given(value=st.floats(-1e6, 1e6).filter(lambda x: abs(x) > 1e-6))
def test_a_conversion_there_and_back_gives_the_number(wanted, other, value):
    there = convert(f"{value!r} {wanted}", other)
    # Each way keeps 15 digits: a part in 2e14 at worst.
    assert convert(f"{there!r} {other}", wanted) == pytest.approx(value, rel=1.1e-14, abs=0)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("1 in", "mm", 25.4),
        ("180 deg", "rad", math.pi),
        ("0.25 turn", "deg", 90.0),
        ("1 ft/min", "mm/min", 304.8),
        ("90 rpm", "rpm", 90.0),
        ("90 rev/min", "rpm", 90.0),
        ("1e3 µm", "mm", 1.0),
        ("-1.5in", "mm", -38.1),
        ("3 1/2 in", "mm", 88.9),
        ("-1 1/4in", "mm", -31.75),
        ("5 Nm", "N*m", 5.0),
        ("250 Nmm", "N*m", 0.25),
        ("100 gon", "deg", 90.0),
        ("45°", "deg", 45.0),
        ("25 %", "", 0.25),
        ("1 kN", "N", 1000.0),
        ("5 mm^2/mm", "mm", 5.0),
    ],
)
def test_known_values(text, unit, value):
    assert convert(text, unit) == pytest.approx(value, rel=1e-15)


@patient
@given(st.integers(-999_999, 999_999), st.integers(0, 4))
def test_decimal_inches_become_the_exact_decimal_of_millimetres(digits, places):
    inches = Decimal(digits).scaleb(-places)
    assert convert(f"{inches:f} in", "mm") == float(inches * Decimal("25.4"))


@patient
@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_number_alone_is_in_the_unit_of_the_field(value):
    assert convert(repr(value), "mm") == value
    assert convert(f" {value!r} ", "") == value


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("2 kg", "mm"),
        ("2 mm", ""),
        ("2 mm", "deg"),
        ("20 degC", "mm"),
        ("1 Hz", "rpm"),  # a turn is not a number: 1 Hz would be read as 9.55 rpm
        ("5 %", "deg"),  # a slope is not an angle
        ("30 deg", ""),
        ("1 rad", "mm"),
        ("1 mm + 1 mm", "mm"),
        ("9**9**9 mm", "mm"),  # would be computed for ever
        ("2 mm**99", "mm"),
        ("(2 mm)", "mm"),
        ("2 wobble", "mm"),
        ("mm", "mm"),
        ("", "mm"),
        ("two mm", "mm"),
        ("1/0 in", "mm"),
        ("3 1/0 in", "mm"),
        ("3 1 in", "mm"),
        ("30 grad", "deg"),  # a degree to one reader, a hundredth of a right angle to the other
        ("30 Grad", "deg"),
        ("5 N m m", "N*m"),
        ("1,5 mm", "mm"),
        ("nan", "mm"),
        ("inf mm", "mm"),
        ("-inf", "mm"),
        ("1e999 mm", "mm"),
        ("2 __class__", "mm"),
    ],
)
def test_what_cannot_be_read_is_refused_by_name(text, unit):
    with pytest.raises(ValueError, match="cannot be read in") as caught:
        convert(text, unit)
    assert repr(text) in str(caught.value)


@patient
@given(st.text(max_size=30), st.sampled_from([*UNITS, ""]))
def test_any_text_is_a_finite_number_or_a_value_error(text, unit):
    try:
        value = convert(text, unit)
    except ValueError:
        return
    assert math.isfinite(value)


def test_kinds():
    assert kind("mm/min") == kind("in/s") != kind("mm")
    assert kind("") == kind("%") == "dimensionless" != kind("rad")
    with pytest.raises(ValueError, match="'mmm' is no unit"):
        kind("mmm")


def test_fields_take_numbers_and_strings_and_hold_their_own_unit():
    table = Table(length="1 in", angle="0.5 turn", speed="6.283185307179586 rad/s", feed=3, force="1 kN")
    assert (table.length, table.angle, table.feed, table.force) == (25.4, 180.0, 3.0, 1000.0)
    assert table.speed == pytest.approx(60, rel=1e-14)


def test_the_schema_says_bounds_under_one_name_wherever_they_were_said():
    class Bounded(Parameters):
        around: Annotated[Millimetres, Field(ge=0, lt=5)] = 1.0
        within: Annotated[float, Field(ge=0, lt=5), Unit("mm")] = 1.0
        beside: Millimetres = Field(1.0, ge=0, lt=5)
        left_out: Annotated[Millimetres, Field(ge=0, lt=5)] | None = None
        le: Annotated[tuple[Millimetres, ...], Field(min_length=1)] = (1.0,)

    fields = Bounded.model_json_schema()["properties"]
    assert set(fields) == {"around", "within", "beside", "left_out", "le"}
    for number in (fields["around"], fields["within"], fields["beside"], fields["left_out"]["anyOf"][0]):
        assert (number["minimum"], number["exclusiveMaximum"]) == (0, 5)
        assert not {"ge", "gt", "le", "lt"} & number.keys()


def test_the_schema_says_the_unit():
    fields = Table.model_json_schema()["properties"]
    assert {name: field["unit"] for name, field in fields.items()} == {
        "length": "mm",
        "angle": "deg",
        "speed": "rpm",
        "feed": "mm/min",
        "force": "N",
        "ratio": "",
    }


@pytest.mark.parametrize("wrong", ["2 kg", True, [1.0], None, math.nan, "1e9 mm"])
def test_a_wrong_value_names_its_field(wrong):
    with pytest.raises(ValidationError) as caught:
        Table(length=wrong)
    (detail,) = caught.value.errors()
    assert detail["loc"] == ("length",)


def test_the_message_shows_how_to_write_it():
    with pytest.raises(ValidationError, match=r"'2 kg' cannot be read in mm; write a number, .*'12 mm'"):
        Table(length="2 kg")


def test_bounds_hold_after_conversion():
    class Short(Parameters):
        length: Millimetres = Field(1.0, ge=0, le=30, description="A length.")

    assert Short(length="1 in").length == 25.4
    with pytest.raises(ValidationError, match="less than or equal to 30"):
        Short(length="2 in")


def test_pint_is_not_imported_without_unit_strings():
    code = (
        "import sys; from mechwright_cam.shop.settings import Stock; Stock(margin=4.0); Stock(margin='4');"
        "assert 'pint' not in sys.modules; Stock(margin='4 mm'); assert 'pint' in sys.modules"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    "text", ["1" * 1_000_000 + " mm", "1e" + "9" * 1_000_000 + " mm", "1," + "1" * 1_000_000]
)
def test_a_long_text_is_refused_before_it_is_read(text):
    """The patterns would read it for hours."""
    with pytest.raises(
        ValidationError, match=r"'1.{19}'\.\.\. has 1,0.* characters, and a quantity at most 200"
    ) as told:
        Table(length=text)
    assert len(told.value.errors()[0]["msg"]) < 200
    assert Table(length=f"{'0' * 190}12 mm").length == 12
