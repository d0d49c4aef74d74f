"""Coordinates that no plate has: too far, or no numbers; and tables of a drawing that are broken."""

import io
import warnings

import ezdxf
import pytest

from mechwright.drawings.asked import Asked
from mechwright.drawings.reading import read

FAR = (2e6, 1e15, 1e155, 1e300)
"""Squares of the last two are no doubles."""

DRAWN = {
    "line": lambda space, far: space.add_line((0, 0), (far, 5)),
    "circle": lambda space, far: space.add_circle((3, 4), far),
    "far circle": lambda space, far: space.add_circle((3, -far), 5),
    "arc": lambda space, far: space.add_arc((3, 4), far, 10, 200),
    "polyline": lambda space, far: space.add_lwpolyline([(0, 0), (far, 0), (5, 5)], close=True),
    "bulge": lambda space, far: space.add_lwpolyline([(0, 0, far), (9, 0, 0)], format="xyb", close=True),
    "old polyline": lambda space, far: space.add_polyline2d([(0, 0), (9, far), (5, 5)], close=True),
    "height": lambda space, far: space.add_line((0, 0, far), (9, 0, far)),
    "ellipse": lambda space, far: space.add_ellipse((0, 0), (far, 0), 0.5),
    "far ellipse": lambda space, far: space.add_ellipse((0, far), (9, 0), 0.5),
    "spline": lambda space, far: space.add_open_spline([(0, 0), (5, far), (9, 0), (12, 5)]),
    "rational spline": lambda space, far: space.add_rational_spline(
        [(0, 0), (5, 5), (9, far), (12, 5)], [1, 2, 1, 1]
    ),
}


def text(draw, far):
    document = ezdxf.new("R2010", units=4)
    draw(document.modelspace(), far)
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue()


@pytest.mark.parametrize("far", FAR)
@pytest.mark.parametrize("drawn", DRAWN)
def test_what_stands_too_far_is_refused_with_its_distance(drawn, far):
    """Points of a circle of a million kilometres filled the memory of the machine."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = read(text(DRAWN[drawn], far).encode(), Asked())
    (fault,) = found.told.faults
    if far > 1e100 and "no numbers" in fault.message:  # what follows from it is none
        return
    if drawn == "bulge" and far > 1e9:
        assert "has a bulge that no arc has" in fault.message
        return
    assert "mm from the drawing's origin; the limit is 1e+06 mm" in fault.message
    assert fault.remedy == "move the part to the origin, or say other units"


@pytest.mark.parametrize("drawn", DRAWN)
def test_what_is_no_number_is_refused(drawn):
    far = text(DRAWN[drawn], 123456.0)
    for value in ("1e400", "-1e400", "nan"):
        broken = far.replace("123456.0", value).replace("-" + value, value)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            found = read(broken.encode(), Asked())
        assert found.told.faults, value
        assert found.told.faults[0].remedy


@pytest.mark.parametrize("weight", [1e-12, 1e12, 1e300])
def test_weights_that_make_corners_are_refused(weight):
    def draw(space, _):
        space.add_rational_spline([(0, 0), (5, 5), (9, 0), (12, 5)], [1, weight, 1, 1])

    found = read(text(draw, 0.0).encode(), Asked())
    assert [fault.message.partition(" on layer")[2] for fault in found.told.faults] == [
        " 0 has knots or weights that are none"
    ]


def test_a_distant_unit_is_told_with_the_units():
    found = read(text(DRAWN["line"], 5e4).encode(), Asked(scale=1e3))
    assert [fault.key for fault in found.told.faults] == ["units"]
