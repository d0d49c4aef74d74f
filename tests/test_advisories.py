"""No version that a release asks for is affected by a known advisory."""

import importlib.util
import tomllib
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[1] / ".ci" / "advisories.py"


@pytest.fixture(scope="module")
def advisories():
    spec = importlib.util.spec_from_file_location("advisories", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_what_is_pinned_and_declared_is_affected_by_no_advisory_of_the_list(advisories):
    assert advisories.affected(tomllib.loads(advisories.LIST.read_text("utf-8"))["package"]) == []


def test_pins_and_lowest_versions_that_are_affected_are_named(advisories):
    pinned = next(iter(advisories.wanted()["aiohttp"]))
    known = {
        "aiohttp": [{"versions": f"<={pinned}", "ids": ["CVE-1"]}],
        "jinja2": [{"versions": ">3.1.5,<=3.1.6", "ids": ["CVE-2"]}],
        "starlette": [{"versions": "<1.3", "ids": ["CVE-3"]}],
    }
    assert [line.split(":")[0] for line in advisories.affected(known)] == [
        f"aiohttp {pinned}",
        *(f"jinja2 {version}" for version in sorted(advisories.wanted()["jinja2"])),
    ]


def test_a_checkout_of_the_database_adds_to_the_list(advisories, tmp_path):
    folder = tmp_path / "vulns" / "rich"
    folder.mkdir(parents=True)
    events = "[{introduced: '0'}, {fixed: '1.2'}, {introduced: '2.0'}, {fixed: '2.1'}]"
    (folder / "PYSEC-1.yaml").write_text(
        "id: PYSEC-1\naliases: [GHSA-1, CVE-7]\naffected:\n"
        f"- ranges:\n  - type: ECOSYSTEM\n    events: {events}\n  - type: GIT\n    events: []\n"
    )
    (folder / "PYSEC-2.yaml").write_text("id: PYSEC-2\nwithdrawn: 2026-01-01\naffected: []\n")
    known = {}
    advisories.read(tmp_path, known)
    assert known == {
        "rich": [{"versions": "<1.2", "ids": ["CVE-7"]}, {"versions": ">=2.0,<2.1", "ids": ["CVE-7"]}]
    }
