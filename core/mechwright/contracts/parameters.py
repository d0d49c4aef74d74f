"""Base of all tables of a design file, and what is kept of the designs that were asked for last."""

from collections.abc import Callable
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeVar, get_args

from pydantic import BaseModel, ConfigDict, ValidationInfo, field_validator

if TYPE_CHECKING:
    from functools import _lru_cache_wrapper

T = TypeVar("T")

KEPT = 32
"""Designs of which a function's result is kept: checks, motion and parts ask for the same one."""


def kept(function: Callable[..., T]) -> "_lru_cache_wrapper[T]":
    """Compute what a function says of a design once."""
    return lru_cache(KEPT)(function)


class Parameters(BaseModel):
    """A table of a design file: frozen, and no key that it does not know.

    Every field has a default or is required, a unit (see :mod:`mechwright.units`), bounds, and one
    line of text as its description. The contract tests of :mod:`mechwright.testing` hold a family to that.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, validate_default=True)

    @field_validator("*", mode="before")
    @classmethod
    def _true_is_no_number(cls, value: Any, info: ValidationInfo) -> Any:
        if isinstance(value, bool) and info.field_name is not None:
            annotation = cls.model_fields[info.field_name].annotation
            if annotation is not bool and bool not in get_args(annotation):
                raise ValueError("true and false are no numbers")
        return value
