"""The page of the elliptic gears says what the code does."""

import re
from pathlib import Path

from family_page import assert_keys

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


def test_keys_of_the_page_are_those_of_the_family() -> None:
    assert_keys(PAGE, EllipticGears.Params)
