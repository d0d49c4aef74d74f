"""What the pages of a family in docs have to say of its code: findings, parameters, requirements."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from mechwright import Family, Rules

ROOT = Path(__file__).parents[1]
SHARED = ("adjustable/machine.py", "adjustable/designs.py")
"""Of the core, in mechanics: findings of every synthesis with phases."""


def assert_keys(page: str, model: type[BaseModel]) -> None:
    """The section "Keys" of a page has keys of the model alone, with their defaults, its first keys among them.

    The others are those that ``mechwright new FAMILY --all`` prints, by their descriptions.
    """
    table = page.split("\n## Keys\n")[1].split("\n## ")[0]
    rows = {}
    for row in table.splitlines():
        cells = [cell.strip() for cell in row.split("|")]
        if row.startswith("| `"):
            for key in re.findall(r"`([a-z_]+)`", cells[1]):
                rows[key] = cells
    assert len(rows) > 5
    assert set(rows) <= set(model.model_fields)
    for key in rows:
        default = model.model_fields[key].default
        if isinstance(default, bool):
            assert str(default).lower() in rows[key][2], key
        elif isinstance(default, (int, float)):
            assert f"{default:g}" in rows[key][2], key
        elif isinstance(default, str):
            assert default in rows[key][2], key
    assert [key for key, field in model.model_fields.items() if not field.description] == []


class FamilyPage:
    """The page ``docs/<name>.md`` of a family, and the sources of its plugin and of what it shares.

    ``shared`` are more sources of the core, in mechanics, ``composed`` codes that no source has as one word,
    ``further`` more pages of the family.
    """

    def __init__(
        self,
        family: type[Family],
        package: str,
        prefixes: Sequence[str],
        shared: Sequence[str] = (),
        composed: Sequence[str] = (),
        further: Sequence[str] = (),
    ) -> None:
        self.family = family
        pages = [(ROOT / "docs" / f"{name}.md").read_text("utf-8") for name in (family.name, *further)]
        self.first, self.text = pages[0], "".join(pages)
        self.code = rf"((?:{'|'.join(prefixes)})\.(?!html)[a-z-]+)"
        mechanics = ROOT / "core" / "mechwright" / "mechanics"
        sources = [
            *(mechanics / name for name in (*SHARED, *shared)),
            *(ROOT / "plugins" / package).rglob("*.py"),
        ]
        self.composed = {*composed, *_codes(family().rules())}
        self.source = "".join(path.read_text(encoding="utf-8") for path in sources)

    def assert_findings(self) -> None:
        """Every code of a finding in the sources is on the page, and no other."""
        said = set(re.findall(rf'"{self.code}"', self.source)) | self.composed
        assert len(said) > 15
        assert set(re.findall(rf"`{self.code}`", self.text)) == said

    def assert_parameters(self) -> None:
        """The keys of the page are those of the family, with their defaults."""
        assert_keys(self.first, self.family.Params)

    def assert_requirements(self) -> None:
        """Every kind of requirement is described, and each of its keys describes itself."""
        for kind, model in self.family.requirements.items():
            assert f"Kind `{kind}`" in self.text
            assert [key for key, field in model.model_fields.items() if not field.description] == []


def _codes(rules: Rules[Any]) -> Iterator[str]:
    """The codes of a list of rules, in order."""
    for one in rules.every:
        yield from _codes(one) if isinstance(one, Rules) else one.codes
