"""The JSON schema of study files: that of design files, and the table ``[study]``."""

from typing import Any

from pydantic import BaseModel, ValidationError

from mechwright.contracts.family import Family
from mechwright.designs.schema import QUANTITY, file_schema, placed_schema
from mechwright.errors import MechwrightError
from mechwright.plugins.host import Host
from mechwright.studies.axis import Range
from mechwright.studies.study import BOUNDS, TABLE, Asked

_WAYS = {"enum": ["least", "greatest"]}


def study_schema(host: Host, family: str = "") -> dict[str, Any]:
    """The schema of study files of one family, with its parameters and columns, or of all that are installed.

    Raises PluginError where the family is not installed.
    """
    found = file_schema(host, family)
    defs, one = found["$defs"], host.family(family) if family else None
    asked = placed_schema(Asked, TABLE, defs)
    ways = placed_schema(Range, f"{TABLE}.range", defs)
    bounds = {
        "type": "object",
        "properties": {name: {"anyOf": [{"type": "number"}, QUANTITY]} for name in sorted(BOUNDS)},
        "additionalProperties": False,
    }
    own = asked["properties"]
    own["ranges"] |= _each("ranges", ways, _parameters(one), defs)
    for name, what in (("constraints", bounds), ("objectives", _WAYS)):
        own[name] |= _each(name, what, _columns(one), defs)
    found["title"] = f"mechwright {TABLE}" + (f", {family}" if family else "")
    found["properties"][TABLE] = asked
    found["properties"].pop("stage", None)  # of chains there are no studies
    found.pop("anyOf", None)
    found["required"] = ["family", TABLE]
    for table in [found["properties"]["parameters"], *_cases(found)]:
        table.pop("required", None)  # what has a range is left out
    return found


def _each(what: str, schema: dict[str, Any], names: list[str], defs: dict[str, Any]) -> dict[str, Any]:
    """A table of any keys that all hold the same; ``names`` are those that an editor offers.

    A name with a dot may stand without quotes, which TOML reads as a table.
    """
    inner = f"{TABLE}.inner.{what}"
    defs[inner] = {
        "type": "object",
        "additionalProperties": {"anyOf": [schema, {"$ref": f"#/$defs/{inner}"}]},
    }
    return {"properties": dict.fromkeys(names, schema), **defs[inner]}


def _cases(found: dict[str, Any]) -> list[dict[str, Any]]:
    return [case["then"]["properties"]["parameters"] for case in found.get("allOf", ())]


def _parameters(family: Family[Any] | None) -> list[str]:
    """The parameters that are no table."""
    fields = family.Params.model_fields.items() if family else ()
    kinds = [(name, field.annotation) for name, field in fields]
    return [name for name, kind in kinds if not (isinstance(kind, type) and issubclass(kind, BaseModel))]


def _columns(family: Family[Any] | None) -> list[str]:
    """Columns of a family's designs, as its defaults have them; others may have more."""
    if family is None:
        return []
    try:
        return sorted(family.measures(family.Params()))
    except (ValidationError, MechwrightError):
        return []
