"""JSON schemas of models, made once: pydantic takes a tenth of a second for a large one."""

import json
from functools import cache
from typing import Any

from pydantic import BaseModel


def model_schema(model: type[BaseModel]) -> dict[str, Any]:
    """The schema of a model, for the caller to change.

    >>> from mechwright.contracts.parameters import Parameters
    >>> model_schema(Parameters)["type"]
    'object'
    """
    found: dict[str, Any] = json.loads(_text(model))
    return found


@cache
def _text(model: type[BaseModel]) -> str:
    return json.dumps(model.model_json_schema())
