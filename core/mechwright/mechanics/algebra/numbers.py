"""Between design numbers and exact ones."""

from fractions import Fraction

from flint import fmpq

from mechwright.errors import DesignError


def exact(number: float | int | str | Fraction) -> Fraction:
    """The number as it is written: 0.1 is one tenth, not the nearest binary fraction.

    Raises DesignError for what is no finite number.

    >>> exact(0.1), exact("5/2"), exact(3)
    (Fraction(1, 10), Fraction(5, 2), Fraction(3, 1))
    """
    try:
        return Fraction(repr(number) if isinstance(number, float) else number)
    except (ValueError, ZeroDivisionError) as error:
        raise DesignError(f"{number!r} is no finite number; write it as 2.5 or 5/2") from error


def rational(number: Fraction) -> fmpq:
    """The fraction as flint's own.

    >>> rational(Fraction(5, 2))
    5/2
    """
    return fmpq(number.numerator, number.denominator)


def fraction(number: fmpq) -> Fraction:
    """Flint's fraction as Python's."""
    return Fraction(int(number.p), int(number.q))
