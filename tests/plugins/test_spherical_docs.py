import importlib.util
import re
import sys
from pathlib import Path

from family_page import assert_keys

from mechwright_spherical.parameters import FiveBarTable, FourBarTable, SphericalParams

ROOT = Path(__file__).parents[2]
DOCS = (ROOT / "docs" / "spherical.md").read_text(encoding="utf-8")


def script(path):
    spec = importlib.util.spec_from_file_location(f"script_{path.stem}", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


SEED = script(ROOT / "docs" / "seeds" / "spherical.py")


def test_every_finding_is_documented():
    sources = (ROOT / "plugins" / "mechwright_spherical").rglob("*.py")
    codes = {
        code
        for file in sources
        for code in re.findall(r'"(spherical\.[a-z-]+)"', file.read_text(encoding="utf-8"))
    }
    assert len(codes) >= 18
    listed = set(re.findall(r"`(spherical\.[a-z-]+)`", DOCS))
    assert listed == codes


def test_keys_of_the_page_are_those_of_the_family():
    assert_keys(DOCS, SphericalParams)
    for model in (FourBarTable, FiveBarTable):
        assert [key for key, field in model.model_fields.items() if not field.description] == []


def test_the_page_of_the_source_is_what_the_code_says():
    assert SEED.PAGE.read_text(encoding="utf-8") == SEED.page(), "run: python docs/seeds/spherical.py"
    for name, draw in SEED.PICTURES.items():
        kept = (SEED.IMAGES / name).read_text(encoding="utf-8")
        assert kept == draw(), "run: python docs/seeds/spherical.py"


def test_the_page_counts_as_the_facts_do():
    page = SEED.PAGE.read_text(encoding="utf-8")
    assert "**12 of 14**" in page
    assert "**41 of 42**" in page
    assert "| 5 | 3.941e-03 | 5.285e-05 | 75 | below 1e-12 |" in page
    assert len(re.findall(r"^\d+\. ", page, re.M)) == 14
