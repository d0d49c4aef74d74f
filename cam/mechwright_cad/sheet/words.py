"""Numbers and sentences that every drawing has."""

PLAIN = "Ra 3.2"
"""Roughness of surfaces that have none of their own, µm."""

FINE, FAIR = "Ra 0.8", "Ra 1.6"
"""Of turned seats of bearings, and of what fits, slides or rolls, µm."""

GENERAL = (
    "Dimensions in mm, tolerances ISO 2768-m, principle ISO 8015",
    f"Surfaces {PLAIN} (ISO 21920), edges -0.2, inside +0.2 (ISO 13715)",
)
"""What holds for a whole part."""


def number(value: float) -> str:
    """A length, mm, to a thousandth.

    >>> number(12.0), number(9.7999999)
    ('12', '9.8')
    """
    return f"{round(value, 3) + 0.0:g}" if abs(value) < 1000 else f"{round(value, 3)}".removesuffix(".0")
