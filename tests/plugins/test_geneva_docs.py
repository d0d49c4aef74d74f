"""The pages of the Geneva mechanism say what the code does."""

import importlib.util
import re
import sys
from pathlib import Path

from family_page import assert_keys

from mechwright_geneva.family import Geneva
from mechwright_geneva.rules.rule_table import RULES

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "geneva.md").read_text(encoding="utf-8")


def script(path, name):
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def test_every_finding_is_on_the_page_and_no_other():
    sources = (ROOT / "plugins" / "mechwright_geneva").rglob("*.py")
    code = "".join(path.read_text(encoding="utf-8") for path in sources)
    said = set(re.findall(r'"((?:geneva|bore)\.[a-z-]+)"', code))
    said |= {code for code in RULES.codes if code.startswith("bore.")}
    assert said
    assert set(re.findall(r"`((?:geneva|bore)\.[a-z-]+)`", PAGE)) == said


def test_keys_of_the_page_are_those_of_the_family():
    assert_keys(PAGE, Geneva.Params)


def test_every_law_is_on_the_page():
    laws = Geneva.Params.model_json_schema()["properties"]["law"]["enum"]
    assert [law for law in laws if f"`{law}`" not in PAGE] == []


def test_the_page_on_the_source_is_what_the_code_says():
    seed = script(ROOT / "docs" / "seeds" / "geneva.py", "geneva_seed")
    assert seed.PAGE.read_text(encoding="utf-8") == seed.page(), "run: python docs/seeds/geneva.py"


def test_pictures_of_the_page_on_the_source_are_up_to_date():
    import geneva_driver

    page = (ROOT / "docs" / "seeds" / "geneva.md").read_text(encoding="utf-8")
    for name, content in geneva_driver.drawn().items():
        shown = (geneva_driver.IMAGES / name).read_text(encoding="utf-8")
        assert shown == content, "run: python docs/seeds/geneva.py"
        assert f"../images/{name}" in page, name


def test_the_page_on_the_source_has_the_corrected_numbers():
    page = (ROOT / "docs" / "seeds" / "geneva.md").read_text(encoding="utf-8")
    for number in ("13.552958847", "0.0640233873", "6.426627", "20.193217416", "13.808", "2.4373", "3.9408"):
        assert number in page, number
