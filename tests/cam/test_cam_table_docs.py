"""The page on the table [cam] says what it takes, and what is found."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import get_args, get_origin

from pydantic import BaseModel

from mechwright_cam.shop.settings import CamSettings

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "cam-table.md").read_text(encoding="utf-8")


NAMED = {"more": "OFFSET"}
"""What the keys of a table are named by, where that is no tool."""


def fields(model: type[BaseModel], prefix: str = "") -> Iterator[tuple[str, object, str]]:
    for key, field in model.model_fields.items():
        default = field.get_default(call_default_factory=True)
        inner = [kind for kind in get_args(field.annotation) if isinstance(kind, type)]
        for kind in inner:  # a table that may be left out
            if issubclass(kind, BaseModel):
                by_name = f"{NAMED.get(key, 'TOOL')}." if get_origin(field.annotation) is dict else ""
                yield from fields(kind, f"{prefix}{key}.{by_name}")
        if isinstance(default, BaseModel):
            yield from fields(type(default), f"{prefix}{key}.")
        else:
            yield prefix + key, default, field.description or ""


def test_every_key_is_on_the_page_with_its_default_and_meaning() -> None:
    rows = {cells[1].strip(" `"): cells for line in PAGE.splitlines() if len(cells := line.split("|")) == 7}
    known = list(fields(CamSettings))
    assert set(rows) - {"key", "---"} == {key for key, _, _ in known}
    for key, default, meaning in known:
        shown = str(default).lower() if isinstance(default, bool) else str(default)
        if default not in (None, "", ()):
            assert rows[key][2].strip() == shown
        assert rows[key][5].strip() == meaning


def test_every_finding_is_on_the_page_and_no_other() -> None:
    sources = (ROOT / "cam" / "mechwright_cam").rglob("*.py")
    code = "".join(path.read_text(encoding="utf-8") for path in sources)
    said = set(re.findall(r'(?:Finding(?:\.\w+)?\(\s*|(?:[A-Z]+|code: str) = )"(cam\.[a-z-]+)"', code))
    assert said
    assert set(re.findall(r"^\| `(cam\.[a-z-]+)`", PAGE, re.MULTILINE)) == said
