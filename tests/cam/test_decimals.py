"""Numbers in DXF and STEP files have no more decimals than they are good for."""

import pytest

from mechwright_cad.exporters.decimals import of_dxf, of_step


@pytest.mark.parametrize(
    ("code", "value", "wanted"),
    [
        (10, "73.8344519346483", "73.83445193"),
        (20, "-1e-17", "0.0"),
        (40, "0.33333333333333331", "0.333333333333"),
        (42, "-0.123456789012345", "-0.123456789012"),
        (50, "128.84479451778446", "128.84479452"),
        (70, "7", "7"),
        (1, "a text of 1.23456789012345", "a text of 1.23456789012345"),
        (2, "1.23456789012345", "1.23456789012345"),
    ],
)
def test_of_a_drawing(code: int, value: str, wanted: str) -> None:
    assert of_dxf(f"{code:>3}\n{value}\n  0\nEOF\n") == f"{code:>3}\n{wanted}\n  0\nEOF\n"


@pytest.mark.parametrize(
    ("statement", "wanted"),
    [
        (
            "CARTESIAN_POINT('',(64.828640838681,-6.637912511121,1.E-14))",
            "CARTESIAN_POINT('',(64.82864084,-6.63791251,0.))",
        ),
        ("DIRECTION('',(0.123456789012345,0.,1.))", "DIRECTION('',(0.123456789012,0.,1.))"),
        ("CIRCLE('',#1,20.)", "CIRCLE('',#1,20.)"),
        ("PRODUCT('a 1.234567890123456','',(#2))", "PRODUCT('a 1.234567890123456','',(#2))"),
        ("CARTESIAN_POINT('',(1.0000000000001,\n  2.,3.))", "CARTESIAN_POINT('',(1.,\n  2.,3.))"),
    ],
)
def test_of_a_solid(statement: str, wanted: str) -> None:
    assert of_step(f"#7 = {statement};\n".encode()) == f"#7 = {wanted};\n".encode()
