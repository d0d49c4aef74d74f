"""What a design begins with: a linkage of the catalogue, or a drawing."""

from typing import Any

from pydantic import ValidationError

from mechwright import DesignError
from mechwright.designs.tables import unknown
from mechwright_linkage.catalogue.entries import ENTRIES
from mechwright_linkage.formats.reading import KNOWN, parameters_from
from mechwright_linkage.parameters import LinkageParams

FIRST = "jansen"
"""The linkage of a design that begins with none."""


def draft_of(source: str, text: str) -> LinkageParams:
    """The design that ``new --from`` writes; raises DesignError for what is no linkage."""
    if text or "?" in source:
        try:
            return LinkageParams.model_validate(parameters_from(text or source, source))
        except ValidationError as error:
            said = error.errors(include_url=False)[0]["msg"]
            raise DesignError(f"--from: {source}: {said}") from error
    name = source or FIRST
    if name not in ENTRIES:
        raise DesignError(f"--from: {unknown(name, tuple(ENTRIES), 'linkage')} (a file can be {KNOWN})")
    entry = ENTRIES[name]
    content: dict[str, Any] = {"linkage": name, name.replace("-", "_"): entry()}
    if entry.swing is not None:
        content |= dict(zip(("swing_from", "swing_to"), entry.swing, strict=True))
    return LinkageParams(**content)
