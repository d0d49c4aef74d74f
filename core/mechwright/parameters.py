"""Base of all tables of a design file."""

from pydantic import BaseModel, ConfigDict


class Parameters(BaseModel):
    """A table of a design file: frozen, and no key that it does not know.

    Every field has a default or is required, a unit (see :mod:`mechwright.units`), bounds, and one line of
    text as its description. The contract tests of :mod:`mechwright.testing` hold a family to that.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, validate_default=True)
