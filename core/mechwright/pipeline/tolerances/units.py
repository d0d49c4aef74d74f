"""Numbers of a tolerance analysis as people read them."""

import math

_SHOWN = {"rad": ("mrad", 1e3), "mm": ("µm", 1e3)}
"""Unit of an error to the one it is shown in: both are small."""


def shown_unit(unit: str) -> str:
    """Unit in which errors are shown."""
    return _SHOWN[unit][0]


def shown(value: float, unit: str) -> str:
    """An error, four digits, in the unit in which it is shown.

    >>> shown(0.0019796, "rad"), shown(float("nan"), "mm")
    ('1.980', '-')
    """
    if not math.isfinite(value):
        return "-"
    scaled = value * _SHOWN[unit][1]
    digits = 0 if not scaled else max(0, min(6, 3 - math.floor(math.log10(abs(scaled)))))
    text = f"{scaled:.{digits}f}"
    return text if float(text) else "0"


def degrees(value: float) -> str:
    """An input position.

    >>> degrees(math.pi / 8)
    '22.5'
    """
    return f"{math.degrees(value):.2f}".rstrip("0").rstrip(".")


def input_position(value: float, unit: str) -> str:
    """An input position with its unit.

    >>> input_position(math.pi / 8, "rad"), input_position(12.5, "mm")
    ('22.5 deg', '12.5 mm')
    """
    return f"{degrees(value)} deg" if unit == "rad" else f"{value:.2f}".rstrip("0").rstrip(".") + " mm"


def nominal(value: float, unit: str) -> str:
    """A dimension with its unit; angles in degrees.

    >>> nominal(math.pi / 2, "rad"), nominal(29.98649, "mm")
    ('90 deg', '29.9865 mm')
    """
    if unit == "rad":
        return f"{math.degrees(value):.5g} deg"
    return f"{value:.6g} mm"


def limits(lower: float, upper: float, unit: str) -> str:
    """A tolerance zone.

    >>> limits(-0.015, 0.015, "mm"), limits(0.005, 0.029, "mm")
    ('±0.015', '0.005..0.029')
    """
    scale = math.degrees(1) if unit == "rad" else 1.0
    low, high = lower * scale, upper * scale
    if abs(low + high) < 1e-9 * max(abs(high), 1.0):
        return f"±{high:.4g}"
    return f"{_plain(low)}..{_plain(high)}"


def _plain(value: float) -> str:
    return f"{round(value, 6):.4g}"


def percent(value: float, digits: int = 1) -> str:
    """A share.

    >>> percent(0.13579)
    '13.6 %'
    """
    return f"{100 * value:.{digits}f} %"
