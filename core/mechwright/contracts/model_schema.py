"""JSON schemas of models, made once: pydantic takes a tenth of a second for a large one."""

import json
from functools import cache
from typing import Any

from pydantic import BaseModel


def model_schema(model: type[BaseModel]) -> dict[str, Any]:
    """The schema of a model, for the caller to change.

    A table that another schema describes has that reference alone: readers of draft 7 skip all beside it.

    >>> from mechwright.contracts.parameters import Parameters
    >>> model_schema(Parameters)["type"]
    'object'
    """
    found: dict[str, Any] = json.loads(_text(model))
    return found


@cache
def _text(model: type[BaseModel]) -> str:
    found = model.model_json_schema()
    for table in (found, *found.get("$defs", {}).values()):
        if "properties" in table:
            table["properties"] = {name: _alone(field) for name, field in table["properties"].items()}
    return json.dumps(found)


def _alone(field: dict[str, Any]) -> dict[str, Any]:
    return {"$ref": field["$ref"]} if "$ref" in field else field
