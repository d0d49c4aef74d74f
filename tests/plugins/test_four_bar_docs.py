"""The page of the four-bar says what the code does."""

import re
from pathlib import Path

from mechwright_four_bar.family import FourBars

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "four-bar.md").read_text(encoding="utf-8")
CODE = r"((?:four-bar|path|poles)\.(?!html)[a-z-]+)"


def test_every_finding_is_on_the_page_and_no_other() -> None:
    shared = ROOT / "core" / "mechwright" / "mechanics" / "adjustable" / "machine.py"
    sources = [shared, *(ROOT / "plugins" / "mechwright_four_bar").glob("*.py")]
    code = "".join(path.read_text(encoding="utf-8") for path in sources)
    said = set(re.findall(rf'"{CODE}"', code))
    assert len(said) > 15
    assert set(re.findall(rf"`{CODE}`", PAGE)) == said


def test_every_parameter_is_on_the_page_with_its_default() -> None:
    table = PAGE.split("## Parameters")[1].split("## Motion")[0]
    rows = {}
    for row in table.splitlines():
        cells = [cell.strip() for cell in row.split("|")]
        if row.startswith("| `"):
            for key in re.findall(r"`([a-z_]+)`", cells[1]):
                rows[key] = cells
    assert set(rows) == set(FourBars.Params.model_fields)
    for key, field in FourBars.Params.model_fields.items():
        if isinstance(field.default, (int, float)):
            assert f"{field.default:g}" in rows[key][2], key
        elif isinstance(field.default, str):
            assert field.default in rows[key][2], key


def test_the_requirements_are_described() -> None:
    for kind, model in FourBars.requirements.items():
        assert f"Kind `{kind}`" in PAGE
        for key in set(model.model_fields) - {"designs", "sense"}:
            assert f"`{key}`" in PAGE, key
