"""The page on the table [cam] says what it takes; the page of findings, what is found."""

import re
from pathlib import Path

import cam_keys
import control_words

ROOT = Path(__file__).parents[2]
FINDINGS = (ROOT / "docs" / "machining" / "findings.md").read_text(encoding="utf-8")


def test_every_key_is_on_the_page_with_its_default_and_meaning() -> None:
    assert cam_keys.PAGE.read_text(encoding="utf-8") == cam_keys.page(), (
        "python docs/cam_keys.py writes it anew"
    )


def test_the_tables_of_words_are_those_that_the_readers_go_by() -> None:
    assert control_words.PAGE.read_text(encoding="utf-8") == control_words.page(), (
        "python docs/control_words.py writes them anew"
    )


def test_the_tables_have_every_key() -> None:
    names = {key.name for key in cam_keys.keys(cam_keys.CamSettings)}
    assert {"control", "nest.gap", "cutting.TOOL.plunge", "measured.more.OFFSET.z", "hold.grip"} <= names
    rows = re.findall(r"^\| (`.*?`) \|", cam_keys.tables(), re.MULTILINE)
    assert sum(row.count(",") + 1 for row in rows) == len(names)


def test_every_finding_is_on_the_page_and_no_other() -> None:
    sources = (ROOT / "cam" / "mechwright_cam").rglob("*.py")
    code = "".join(path.read_text(encoding="utf-8") for path in sources)
    said = set(re.findall(r'(?:Finding(?:\.\w+)?\(\s*|(?:[A-Z]+|code: str) = )"(cam\.[a-z-]+)"', code))
    assert said
    listed = re.findall(r"^\| (`cam\..*?) \|", FINDINGS, re.MULTILINE)
    assert set(re.findall(r"`(cam\.[a-z-]+)`", " ".join(listed))) == said
