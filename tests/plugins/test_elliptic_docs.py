"""The page of the elliptic gears says what the code does."""

import re
from pathlib import Path

from mechwright.mechanics import opening_rules
from mechwright_elliptic_gears.family import EllipticGears

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "elliptic-gears.md").read_text(encoding="utf-8")


def test_every_finding_is_on_the_page_and_no_other() -> None:
    gearing = ROOT / "core" / "mechwright" / "mechanics" / "gearing"
    own = ROOT / "plugins" / "mechwright_elliptic_gears"
    sources = [*own.rglob("*.py"), *gearing.glob("*.py"), Path(opening_rules.__file__)]
    code = "".join(path.read_text(encoding="utf-8") for path in sources)
    said = set(re.findall(r'"((?:gear|bore|point|train|synthesis)\.[a-z-]+)"', code))
    assert said
    assert set(re.findall(r"`((?:gear|bore|point|train|synthesis)\.[a-z-]+)`", PAGE)) == said


def test_every_parameter_is_on_the_page_with_its_default() -> None:
    table = PAGE.split("## Parameters")[1].split("## Motion")[0]
    rows = {
        key: [cell.strip() for cell in row.split("|")]
        for row in table.splitlines()
        for key in re.findall(r"`([a-z_]+)`", row.split("|")[1] if row.startswith("|") else "")
    }
    assert set(rows) == set(EllipticGears.Params.model_fields)
    for key, field in EllipticGears.Params.model_fields.items():
        if isinstance(field.default, (int, float)):
            assert f"{field.default:g}" in rows[key][2], key
