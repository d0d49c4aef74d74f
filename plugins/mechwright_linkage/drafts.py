"""What a design begins with: a linkage of the catalogue, or a drawing."""

from typing import Any

from pydantic import ValidationError

from mechwright import DesignError
from mechwright.designs.tables import unknown
from mechwright_linkage.formats.reading import KNOWN, parameters_from
from mechwright_linkage.parameters import LinkageParams


def draft_of(source: str, text: str, kind: type[LinkageParams] = LinkageParams) -> LinkageParams:
    """The design that ``new --from`` writes; raises DesignError for what is no linkage.

    Parameters
    ----------
    source, text
        A name, a file or an address, and the content of a file.
    kind
        The table of parameters, which says what linkages there are.
    """
    entries = kind.entries()
    known = ", ".join(entries)
    drawn = "links" in kind.model_fields
    if (text or "?" in source) and not drawn:
        raise DesignError(f"--from: {source}: this family reads no drawings; give one of {known}")
    if text or "?" in source:
        try:
            return kind.model_validate(parameters_from(text or source, source))
        except ValidationError as error:
            said = error.errors(include_url=False)[0]["msg"]
            raise DesignError(f"--from: {source}: {said}") from error
    name = source or kind.model_fields["linkage"].default
    if name not in entries:
        files = f" (a file can be {KNOWN})" if drawn else ""
        raise DesignError(f"--from: {unknown(name, tuple(entries), 'linkage')}{files}")
    entry = entries[name]
    content: dict[str, Any] = {"linkage": name, name.replace("-", "_"): entry()}
    if entry.swing is not None:
        content |= dict(zip(("swing_from", "swing_to"), entry.swing, strict=True))
    return kind(**content)
