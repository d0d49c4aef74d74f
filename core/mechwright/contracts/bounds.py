"""The kind of a field's values, and which of many numbers its bounds refuse."""

from collections.abc import Callable, Mapping
from types import NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin

import numpy as np
from annotated_types import Ge, Gt, Le, Lt
from numpy.typing import NDArray
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from mechwright.units import Unit

Bools = NDArray[np.bool_]


class UnknownRefusalError(Exception):
    """Arrays do not tell what a table says: the slow way has to be gone."""


def kind_of(info: FieldInfo) -> tuple[Any, list[Any]]:
    """The kind of a field's values, None of tables and lists, and its bounds."""
    kind, metadata = info.annotation, list(info.metadata)
    while True:
        origin, arguments = get_origin(kind), get_args(kind)
        if origin is Annotated:
            kind, metadata = arguments[0], metadata + list(arguments[1:])
        elif origin in (Union, UnionType):
            real = [one for one in arguments if one is not NoneType]
            if len(real) != 1:
                return None, metadata
            kind = real[0]
        else:
            break
    table = isinstance(kind, type) and issubclass(kind, (BaseModel, tuple, list, dict, set, frozenset))
    return None if table or origin in (tuple, list, dict, set, frozenset) else kind, metadata


_BOUNDS: Mapping[type, tuple[str, Callable[[Any, Any], Any]]] = {
    Ge: ("ge", np.less),
    Gt: ("gt", np.less_equal),
    Le: ("le", np.greater),
    Lt: ("lt", np.greater_equal),
}


def beyond(metadata: list[Any], given: NDArray[Any]) -> Bools:
    """Which numbers bounds refuse; raises UnknownRefusalError where more than bounds are asked for."""
    refused = np.asarray(~np.isfinite(given))
    for one in metadata:
        if isinstance(one, FieldInfo):
            refused |= beyond(one.metadata, given)
        elif type(one) in _BOUNDS:
            key, outside = _BOUNDS[type(one)]
            refused |= outside(given, getattr(one, key))
        elif not isinstance(one, Unit):
            raise UnknownRefusalError
    return refused
