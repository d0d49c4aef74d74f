"""Files that a design names: what they hold is part of its parameters, so that families touch no files."""

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from pydantic import BaseModel, GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from mechwright.errors import DesignError, MechwrightError
from mechwright.reading import read_bytes


def beside(path: Path, name: str, key: str) -> Path:
    """A file in or below the folder of the design file ``path``; raises DesignError if it leads out of it."""
    folder = path.resolve().parent
    try:
        found = (folder / name).resolve()
    except (OSError, ValueError, RuntimeError) as error:  # a loop of links, or a null byte
        raise DesignError(f"{path}: {key}: {name!r} is no file: {error}") from error
    if not found.is_relative_to(folder):
        raise DesignError(
            f"{path}: {key}: {name!r} leads out of the folder of the design file; put the file beside it"
        )
    return found


@dataclass(frozen=True)
class InputFile:
    r"""A file beside a design file, as the type of a field of the parameters.

    The design file says its name; whoever reads the table reads the file as well, so that a family gets what
    it holds, and two designs are equal only where their files are. The manifest of a build has its hash.
    Nothing is read for an empty name: the family says what that stands for.

    Examples
    --------
    >>> InputFile("plate.dxf", b"0\nEOF\n").name
    'plate.dxf'
    """

    name: str = ""
    data: bytes = field(default=b"", repr=False)

    @cached_property
    def digest(self) -> str:
        """SHA-256 of what it holds."""
        return hashlib.sha256(self.data).hexdigest()

    def __str__(self) -> str:
        return self.name

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(
            cls._read, serialization=core_schema.plain_serializer_function_ser_schema(str, when_used="json")
        )

    @classmethod
    def __get_pydantic_json_schema__(
        cls, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return {"type": "string"}

    @classmethod
    def _read(cls, value: object, info: ValidationInfo) -> "InputFile":
        if isinstance(value, InputFile):
            return value
        if not isinstance(value, str):
            raise PydanticCustomError("file", "should be the name of a file")
        if not value:
            return cls()
        path = (info.context or {}).get("path", Path("design.toml"))
        key = info.field_name or "file"
        try:
            found = beside(path, value, key)
            return cls(value, read_bytes(found))
        except MechwrightError as error:
            # Whoever tells it names the design file and the key; the file is named as the design names it.
            said = str(error).removeprefix(f"{path}: {key}: ")
            if said == str(error):
                said = f"{value!r} {said.partition(': ')[2]}"
            raise PydanticCustomError("file", "{said}", {"said": said}) from error


def input_files(table: BaseModel, within: str = "") -> Mapping[str, InputFile]:
    """The files that a table and those in it name, by their dotted keys."""
    return dict(_files(table, within))


def _files(table: BaseModel, within: str) -> Iterator[tuple[str, InputFile]]:
    for key in type(table).model_fields:
        value = getattr(table, key)
        if isinstance(value, InputFile) and value.name:
            yield f"{within}{key}", value
        elif isinstance(value, BaseModel):
            yield from _files(value, f"{within}{key}.")
