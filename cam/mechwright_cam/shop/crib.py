"""Tools from a library of another program: names of ours, checked shapes, and what is told of the rest."""

import unicodedata
from dataclasses import dataclass
from pathlib import Path

from pydantic import ValidationError

from mechwright.errors import DesignError
from mechwright_cam.shop.formats.contract import LONGEST, Format, ToolRecord, slug
from mechwright_cam.shop.tool import Tool


@dataclass(frozen=True)
class Crib:
    """What is taken over from a file."""

    tools: tuple[Tool, ...]
    told: tuple[str, ...]
    """A line for each tool that is left out, and for each thing that is completed or not taken over of some:
    which ones, what, what to do."""


def read_crib(path: Path, form: Format) -> Crib:
    """The tools of a file.

    Raises OutputError or DesignError, with a line for each tool if none can be used.
    """
    tools: dict[str, Tool] = {}
    left: list[str] = []
    same: dict[str, list[str]] = {}
    for said in form.read(path):
        tool = None if said.fault else _made(said, form, tools)
        if said.fault or tool is None:
            left.append(f"{said.called} is left out: {said.fault}")
            continue
        tools[tool.name] = tool
        if said.taken:
            what = f"taken with {', '.join(said.taken)}, which the file does not say"
            same.setdefault(what, []).append(said.called)
        for one in said.dropped:
            same.setdefault(f"not taken over: {one}", []).append(said.called)
    if not tools and not left:
        raise DesignError(f"{path}: holds no tool; is it the right file?")
    if not tools:
        raise DesignError("\n".join(f"{path}: {line}" for line in left))
    told = (f"{', '.join(called)}: {what}" for what, called in same.items())
    return Crib(tuple(tools.values()), (*left, *told))


def _made(said: ToolRecord, form: Format, known: dict[str, Tool]) -> Tool | None:
    """The tool; None, with the fault noted, where its sizes are none."""
    try:
        return Tool.model_validate({**said.keys, "name": _name(said, known)})
    except ValidationError as error:
        faults = [_fault(item["loc"], str(item["msg"]), form) for item in error.errors(include_url=False)]
        said.fault = f"{'; '.join(faults)}; mend it there"
        return None


def _fault(place: tuple[int | str, ...], message: str, form: Format) -> str:
    """What is wrong with a key, with what the file calls it."""
    said = message.removeprefix("Value error, ").removeprefix("Input ")
    key = str(place[0]) if place else ""
    theirs = form.fields.get(key)
    if message == "Field required":
        return f"the file does not say its {key}" + (f" ({theirs})" if theirs else "")
    return f"{key} ({theirs}) {said}" if theirs else " ".join(filter(None, (key, said)))


def _name(said: ToolRecord, known: dict[str, Tool]) -> str:
    """A name of ours from what the file calls it, with the T number where it is taken."""
    plain = unicodedata.normalize("NFKD", said.label).encode("ascii", "ignore").decode()
    number = f"t{said.keys['number']}"
    name = slug(plain) or number
    while name in known:  # a name may end so by itself
        name = f"{name[: LONGEST - len(number) - 1].rstrip('-_.')}-{number}"
        number += "x"
    return name
