"""What a family's page in docs has to say of its code: findings, parameters, requirements."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from mechwright import Family, Rules

ROOT = Path(__file__).parents[1]
SHARED = ("adjustable/machine.py", "adjustable/designs.py")
"""Of the core, in mechanics: findings of every synthesis with phases."""


class FamilyPage:
    """The page ``docs/<name>.md`` of a family, and the sources of its plugin and of what it shares.

    ``shared`` are more sources of the core, in mechanics, ``composed`` codes that no source has as one word.
    """

    def __init__(
        self,
        family: type[Family],
        package: str,
        prefixes: Sequence[str],
        shared: Sequence[str] = (),
        composed: Sequence[str] = (),
    ) -> None:
        self.family = family
        self.text = (ROOT / "docs" / f"{family.name}.md").read_text(encoding="utf-8")
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
        """Every parameter is in the table of the page, with its default."""
        table = self.text.split("## Parameters")[1].split("## Motion")[0]
        rows = {}
        for row in table.splitlines():
            cells = [cell.strip() for cell in row.split("|")]
            if row.startswith("| `"):
                for key in re.findall(r"`([a-z_]+)`", cells[1]):
                    rows[key] = cells
        assert set(rows) == set(self.family.Params.model_fields)
        for key, field in self.family.Params.model_fields.items():
            if isinstance(field.default, (int, float)):
                assert f"{field.default:g}" in rows[key][2], key
            elif isinstance(field.default, str):
                assert field.default in rows[key][2], key

    def assert_requirements(self, plain: Sequence[str]) -> None:
        """Every kind of requirement is described, with its keys but for those that say themselves."""
        for kind, model in self.family.requirements.items():
            assert f"Kind `{kind}`" in self.text
            for key in set(model.model_fields) - set(plain):
                assert f"`{key}`" in self.text, key


def _codes(rules: Rules[Any]) -> Iterator[str]:
    """The codes of a list of rules, in order."""
    for one in rules.every:
        yield from _codes(one) if isinstance(one, Rules) else one.codes
