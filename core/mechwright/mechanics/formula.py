"""A formula of one variable, as a person writes it, with its exact derivatives.

A formula is read as text, never run as a program: numbers, the variable, pi, + - * / ** (or ^), parentheses
and the functions of :data:`FUNCTIONS`. Each of these is smooth where it is defined, so that a formula has no
corner but where a pole or a root of 0 makes one.

A value with its first three derivatives by one variable, carried through arithmetic exactly.
"""

import ast
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import MechwrightError


@dataclass(frozen=True)
class Jet:
    """A value (...) and its derivatives (...) of first to third order.

    Products follow Leibniz; a function of a jet follows Faà di Bruno,
    (g∘f)''' = g''' f'³ + 3 g'' f' f'' + g' f'''.

    Examples
    --------
    >>> x = Jet.variable(np.array(2.0))
    >>> cube = x * x * x
    >>> [float(one) for one in (cube.value, cube.first, cube.second, cube.third)]
    [8.0, 12.0, 12.0, 6.0]
    """

    value: Array
    first: Array
    second: Array
    third: Array

    @staticmethod
    def variable(at: Array) -> "Jet":
        """The variable itself."""
        zero = np.zeros_like(at)
        return Jet(at, zero + 1, zero, zero)

    @staticmethod
    def constant(value: float, like: "Jet") -> "Jet":
        """A number, in the shape of another jet."""
        zero = np.zeros_like(like.value)
        return Jet(zero + value, zero, zero, zero)

    def through(self, value: Array, first: Array, second: Array, third: Array) -> "Jet":
        """A function of this, of which value and derivatives at :attr:`value` are given."""
        one, two, three = self.first, self.second, self.third
        return Jet(
            value,
            first * one,
            second * one**2 + first * two,
            third * one**3 + 3 * second * one * two + first * three,
        )

    def __neg__(self) -> "Jet":
        return Jet(-self.value, -self.first, -self.second, -self.third)

    def __add__(self, other: "Jet | float") -> "Jet":
        if not isinstance(other, Jet):
            return Jet(self.value + other, self.first, self.second, self.third)
        return Jet(
            self.value + other.value,
            self.first + other.first,
            self.second + other.second,
            self.third + other.third,
        )

    __radd__ = __add__

    def __sub__(self, other: "Jet | float") -> "Jet":
        return self + (-other)

    def __rsub__(self, other: float) -> "Jet":
        return -self + other

    def __mul__(self, other: "Jet | float") -> "Jet":
        if not isinstance(other, Jet):
            return Jet(other * self.value, other * self.first, other * self.second, other * self.third)
        f, f1, f2, f3 = self.value, self.first, self.second, self.third
        g, g1, g2, g3 = other.value, other.first, other.second, other.third
        return Jet(
            f * g,
            f1 * g + f * g1,
            f2 * g + 2 * f1 * g1 + f * g2,
            f3 * g + 3 * f2 * g1 + 3 * f1 * g2 + f * g3,
        )

    __rmul__ = __mul__

    def __truediv__(self, other: "Jet") -> "Jet":
        return self * other**-1.0

    def __pow__(self, other: "Jet | float") -> "Jet":
        if isinstance(other, Jet):
            steady = not (np.any(other.first) or np.any(other.second) or np.any(other.third))
            if not steady or np.ptp(other.value) > 0:
                return (self.log() * other).exp()
            other = float(np.ravel(other.value)[0])
        factors, found = [1.0, other, other * (other - 1), other * (other - 1) * (other - 2)], []
        for order, factor in enumerate(factors):
            # x⁰ at 0 is 1, and a derivative whose factor is 0 is 0 wherever x is.
            found.append(factor * self.value ** (other - order) if factor else np.zeros_like(self.value))
        return self.through(*found)

    def sin(self) -> "Jet":
        """Sine."""
        sin, cos = np.sin(self.value), np.cos(self.value)
        return self.through(sin, cos, -sin, -cos)

    def cos(self) -> "Jet":
        """Cosine."""
        sin, cos = np.sin(self.value), np.cos(self.value)
        return self.through(cos, -sin, -cos, sin)

    def exp(self) -> "Jet":
        """Exponential function."""
        grown = np.exp(self.value)
        return self.through(grown, grown, grown, grown)

    def log(self) -> "Jet":
        """Natural logarithm."""
        x = self.value
        return self.through(np.log(x), 1 / x, -1 / x**2, 2 / x**3)

    def tanh(self) -> "Jet":
        """Hyperbolic tangent, without the overflow of its exponentials."""
        t = np.tanh(self.value)
        return self.through(t, 1 - t * t, -2 * t * (1 - t * t), (1 - t * t) * (6 * t * t - 2))

    def asin(self) -> "Jet":
        """Inverse sine, by the derivative of which the others follow."""
        x = self.value
        q = 1 - x * x
        return self.through(np.arcsin(x), q**-0.5, x * q**-1.5, (1 + 2 * x * x) * q**-2.5)

    def atan(self) -> "Jet":
        """Inverse tangent."""
        x = self.value
        q = 1 + x * x
        return self.through(np.arctan(x), 1 / q, -2 * x / q**2, (6 * x * x - 2) / q**3)


LONGEST = 500
"""Characters of a formula: what is longer is no longer read by people, and is better a table."""


class FormulaError(MechwrightError):
    """A text is no formula of the variable; the message says what in it."""


FUNCTIONS: dict[str, Callable[[Jet], Jet]] = {
    "sin": Jet.sin,
    "cos": Jet.cos,
    "tan": lambda x: x.sin() / x.cos(),
    "asin": Jet.asin,
    "acos": lambda x: np.pi / 2 - x.asin(),
    "atan": Jet.atan,
    "sinh": lambda x: 0.5 * (x.exp() - (-x).exp()),
    "cosh": lambda x: 0.5 * (x.exp() + (-x).exp()),
    "tanh": Jet.tanh,
    "exp": Jet.exp,
    "log": Jet.log,
    "sqrt": lambda x: x**0.5,
}
"""Name to function; log is the natural one, angles are in radians."""

_OPERATORS: dict[type[ast.operator], Callable[[Jet, Jet], Jet]] = {
    ast.Add: lambda one, two: one + two,
    ast.Sub: lambda one, two: one - two,
    ast.Mult: lambda one, two: one * two,
    ast.Div: lambda one, two: one / two,
    ast.Pow: lambda one, two: one**two,
}


@dataclass(frozen=True)
class Formula:
    """A formula of one variable.

    Parameters
    ----------
    text
        As it was written.
    variable
        Name of the variable.

    Raises
    ------
    FormulaError
        With the part of the text that cannot be read.

    Examples
    --------
    >>> value, first, second, third = Formula("1 + 0.3*sin(phi)^2", "phi")(np.array(0.5))
    >>> bool(abs(first - 0.3 * np.sin(1.0)) < 1e-15)
    True
    """

    text: str
    variable: str

    def __post_init__(self) -> None:
        with np.errstate(all="ignore"):
            _made(_tree(self.text), Jet.variable(np.array(0.5)), self)

    def __call__(self, at: Array) -> tuple[Array, Array, Array, Array]:
        """The value and its first three derivatives (...) at values (...) of the variable.

        Where the formula is not defined they are not finite.
        """
        with np.errstate(all="ignore"):
            found = _made(_tree(self.text), Jet.variable(np.asarray(at, dtype=float)), self)
        return found.value, found.first, found.second, found.third


@lru_cache(maxsize=256)
def _tree(text: str) -> ast.expr:
    if len(text) > LONGEST:
        raise FormulaError(
            f"the formula has {len(text)} characters, {LONGEST} are the most; give a table instead"
        )
    try:
        return ast.parse(text.strip().replace("^", "**"), mode="eval").body
    except SyntaxError as error:
        place = (error.text or text)[max((error.offset or 1) - 1, 0) :][:20]
        raise FormulaError(f"{text[:60]!r} is no formula: it cannot be read from {place!r} on") from None
    except (ValueError, RecursionError, MemoryError):
        raise FormulaError(f"{text[:60]!r} is no formula") from None


def _made(node: ast.expr, x: Jet, of: Formula) -> Jet:
    if (
        isinstance(node, ast.Constant)
        and isinstance(node.value, int | float)
        and not isinstance(node.value, bool)
    ):
        return Jet.constant(_number(node.value), x)
    if isinstance(node, ast.Name):
        if node.id == of.variable:
            return x
        if node.id == "pi":
            return Jet.constant(np.pi, x)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.UAdd):
        inner = _made(node.operand, x, of)
        return -inner if isinstance(node.op, ast.USub) else inner
    if isinstance(node, ast.BinOp) and type(node.op) in _OPERATORS:
        return _OPERATORS[type(node.op)](_made(node.left, x, of), _made(node.right, x, of))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS:
        if len(node.args) == 1 and not node.keywords:
            return FUNCTIONS[node.func.id](_made(node.args[0], x, of))
        raise FormulaError(f"{node.func.id} in {of.text[:60]!r} takes one value in parentheses")
    known = ", ".join((of.variable, "pi", *FUNCTIONS))
    raise FormulaError(
        f"{ast.unparse(node)[:40]!r} is no part of a formula; known are {known}, and + - * / ^"
    )


def _number(value: float) -> float:
    try:
        return float(value)
    except OverflowError:
        raise FormulaError("a number of the formula is beyond 1e308") from None
