"""A formula of one variable, as a person writes it, with its exact derivatives.

A formula is read as text, never run as a program: numbers, the variable, pi, + - * / ** (or ^), parentheses
and the functions of :data:`FUNCTIONS`. Each of these is smooth where it is defined, so that a formula has no
corner but where a pole or a root of 0 makes one.
"""

import ast
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import MechwrightError
from mechwright.mechanics.jet import Jet

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
