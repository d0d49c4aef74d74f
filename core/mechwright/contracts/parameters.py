"""Base of all tables of a design file."""

from typing import Any, get_args

from pydantic import BaseModel, ConfigDict, ValidationInfo, field_validator


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
