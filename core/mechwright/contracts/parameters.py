"""Base of all tables of a design file, and what is kept of the designs that were asked for last."""

from collections.abc import Callable, Collection, Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar, TypeGuard, TypeVar, get_args, get_origin

from pydantic import BaseModel, ConfigDict, GetJsonSchemaHandler, ValidationInfo, field_validator
from pydantic.config import JsonDict
from pydantic.fields import FieldInfo
from pydantic_core import CoreSchema

if TYPE_CHECKING:
    from functools import _lru_cache_wrapper

T = TypeVar("T")

FIRST: JsonDict = {"first": True}
"""``json_schema_extra`` of a field that one sets first: without ``--all``, ``new`` writes these."""

GIVEN: JsonDict = {"given": True}
"""``json_schema_extra`` of a field that says what is at hand, such as a mill's travel, or how good a thing
has to be: no remedy changes it."""

FITTED: JsonDict = {"fitted": True}
"""``json_schema_extra`` of a field that :meth:`Parameters.fitted` sets where a file leaves it out: its
default is the usual value, and files that are written show it as a comment."""


def is_fitted(field: FieldInfo | None) -> bool:
    """Whether a field is marked with :data:`FITTED`; none is not."""
    marks = None if field is None else field.json_schema_extra
    return isinstance(marks, dict) and bool(marks.get("fitted"))


KEPT = 32
"""Designs of which a function's result is kept: checks, motion and parts ask for the same one."""


def kept(function: Callable[..., T]) -> "_lru_cache_wrapper[T]":
    """Compute what a function says of a design once."""
    return lru_cache(KEPT)(function)


def value_at(params: Any, name: str) -> Any:
    """The value of a dotted parameter, through tables and through tables by name.

    >>> value_at({"points": {"A": {"x": 30.0}}}, "points.A.x")
    30.0

    Raises AttributeError or KeyError where there is none.
    """
    for step in name.split("."):
        params = params[step] if isinstance(params, Mapping) else getattr(params, step)
    return params


def named_table(annotation: object) -> type[BaseModel] | None:
    """The model of the tables that a field has by names, ``dict[str, Model]``; None for other fields."""
    kinds = get_args(annotation)
    if get_origin(annotation) is dict and _is_table(kinds[1]):
        model: type[BaseModel] = kinds[1]
        return model
    return None


SHORT = 10
"""Fields that ``new`` writes of a table in which none is marked."""


def first_fields(model: type[BaseModel]) -> tuple[str, ...]:
    """Names of the fields of a model, tables included, that one sets first.

    They are those that are marked with :data:`FIRST` and the tables that hold such; where none is marked, the
    first ten that have a value and are no table.
    """
    marked = _marked(model)
    if marked:
        return marked
    plain = [
        name
        for name, field in model.model_fields.items()
        if not _is_table(field.annotation) and field.get_default(call_default_factory=True) is not None
    ]
    return tuple(plain[:SHORT])


def _marked(model: type[BaseModel]) -> tuple[str, ...]:
    found = []
    for name, field in model.model_fields.items():
        extra = field.json_schema_extra
        table = field.annotation
        if (isinstance(extra, dict) and extra.get("first")) or (_is_table(table) and _marked(table)):
            found.append(name)
    return tuple(found)


_BOUNDS = {"ge": "minimum", "gt": "exclusiveMinimum", "le": "maximum", "lt": "exclusiveMaximum"}
"""What pydantic calls the bounds of a type that has a unit already."""


def _bounds_named(node: Any) -> Any:
    if isinstance(node, list):
        return [_bounds_named(item) for item in node]
    if not isinstance(node, dict) or "$ref" in node:
        return node
    return {
        _BOUNDS.get(key, key): value if key == "default" else _bounds_named(value)
        for key, value in node.items()
    }


def _is_table(annotation: object) -> TypeGuard[type[BaseModel]]:
    return isinstance(annotation, type) and issubclass(annotation, BaseModel)


class Parameters(BaseModel):
    """A table of a design file: frozen, and no key that it does not know.

    Every field has a default or is required, a unit (see :mod:`mechwright.units`), bounds, and one
    line of text as its description. The contract tests of :mod:`mechwright.testing` hold a family to that.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, validate_default=True)

    also: ClassVar[Mapping[str, str]] = {}
    """What people look for under another name, and what to say of it: ``{"conrod": "it is called rod"}``."""

    def fitted(self) -> Mapping[str, Any]:
        """Values of the fields that were left out and follow from others, where the default would not do.

        Such fields are marked with :data:`FITTED`. A family's ``evaluate`` has to know it too.
        """
        return {}

    def unused_fields(self) -> Collection[str]:
        """Names of fields that mean nothing with the values of the others, such as tables of another choice.

        New files and pages omit them, and remedies do not change them. The default names none.
        """
        return ()

    def model_post_init(self, context: Any, /) -> None:  # noqa: ARG002 - pydantic's
        """Take what :meth:`fitted` says; it still counts as left out."""
        self.__dict__.update(self.fitted())

    @classmethod
    def __get_pydantic_json_schema__(
        cls, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """The JSON schema of the table, its bounds under the names that JSON schemas have for them."""
        found = handler.resolve_ref_schema(handler(schema))
        fields = found.get("properties", {})
        fields.update({name: _bounds_named(field) for name, field in fields.items()})
        return found

    @field_validator("*", mode="before")
    @classmethod
    def _true_is_no_number(cls, value: Any, info: ValidationInfo) -> Any:
        if isinstance(value, bool) and info.field_name is not None:
            annotation = cls.model_fields[info.field_name].annotation
            if annotation is not bool and bool not in get_args(annotation):
                raise ValueError("is no number")
        return value
