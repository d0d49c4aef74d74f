"""What a release is made of: dependencies, locks, licences, changelog, workflows."""

import re
import runpy
import tomllib
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.version import Version

import mechwright

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
DEPENDENCIES = [Requirement(text) for text in PROJECT["dependencies"]]
LOCK = (ROOT / "requirements.lock").read_text("utf-8")
LOCKED = {
    (match[1].lower().replace("_", "-"), match[3] or ""): Version(match[2])
    for match in re.finditer(r"^([A-Za-z0-9_.-]+)==(\S+?)(?: ; (.+?))? \\$", LOCK, re.MULTILINE)
}
WORKFLOWS = sorted((ROOT / ".github").rglob("*.yml"))
components = runpy.run_path(str(ROOT / ".ci" / "components.py"))
new_version = runpy.run_path(str(ROOT / ".ci" / "new_version.py"))


@pytest.mark.parametrize("wanted", DEPENDENCIES, ids=lambda wanted: wanted.name)
def test_the_lock_has_what_the_project_asks_for(wanted):
    versions = [version for (name, _), version in LOCKED.items() if name == wanted.name]
    assert versions
    assert all(version in wanted.specifier for version in versions)


def test_every_locked_package_has_hashes_and_no_address():
    assert "://" not in LOCK
    for block in re.split(r"\n(?=\S)", LOCK.strip()):
        assert re.search(r"--hash=sha256:[0-9a-f]{64}", block), block.splitlines()[0]


@pytest.mark.parametrize("wanted", DEPENDENCIES, ids=lambda wanted: wanted.name)
def test_every_dependency_has_one_lowest_version_and_no_highest(wanted):
    assert [each.operator for each in wanted.specifier] == [">="]


def test_the_page_of_components_names_every_locked_package():
    page = (ROOT / "docs" / "components.md").read_text("utf-8")
    named = {name.lower().replace("_", "-") for name in re.findall(r"^\| (\S+) \|", page, re.MULTILINE)}
    everywhere = {name for name, marker in LOCKED if not marker or "python_full_version" in marker}
    assert everywhere == named - {"package", "---"}


@pytest.mark.parametrize(
    ("component", "expected"),
    [
        ({"name": "a", "licenses": [{"license": {"id": "MIT"}}]}, []),
        ({"name": "a", "licenses": [{"expression": "MIT AND LGPL-3.0-or-later"}]}, []),
        ({"name": "a", "licenses": [{"license": {"name": "License :: OSI Approved :: BSD License"}}]}, []),
        ({"name": "casadi", "licenses": []}, []),
        ({"name": "a", "licenses": []}, ["no licence"]),
        ({"name": "a", "licenses": [{"expression": "MIT AND GPL-3.0-only"}]}, ["GPL-3.0-only"]),
        ({"name": "a", "licenses": [{"license": {"name": "Proprietary"}}]}, ["Proprietary"]),
    ],
)
def test_licences_are_brought_to_one_spelling_and_judged(component, expected):
    assert components["unknown"](components["licence"](component)) == expected


def test_the_changelog_has_a_part_for_every_version_newest_first():
    parts = re.findall(r"^## (.+)$", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    before_the_first = parts == ["Unreleased"]
    releases = [] if before_the_first else parts
    released = [re.fullmatch(r"(\d+\.\d+\.\d+) - \d{4}-\d{2}-\d{2}", part) for part in releases]
    assert before_the_first or released
    assert all(released), parts
    versions = [Version(match[1]) for match in released]
    assert versions == sorted(versions, reverse=True)
    assert all(version <= Version(mechwright.__version__) for version in versions)


def test_the_citation_names_this_version_and_licence():
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert (cited["cff-version"], cited["type"]) == ("1.2.0", "software")
    assert cited["version"] == mechwright.__version__
    assert cited["license"] == PROJECT["license"]
    assert all(author.keys() == {"name"} for author in cited["authors"])


def test_every_package_says_that_it_is_typed():
    packages = {
        path.parent for where in ("core", "cam", "plugins") for path in (ROOT / where).glob("*/__init__.py")
    }
    assert len(packages) > 10
    untyped = sorted(one.name for one in packages if not (one / "py.typed").exists())
    assert untyped == []


def test_fragments_of_the_changelog_are_what_towncrier_takes():
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["towncrier"]
    news = (ROOT / settings["filename"]).read_text("utf-8")
    assert news.partition(settings["start_string"])[2].startswith("\n## ")
    kinds = "|".join(kind["directory"] for kind in settings["type"])
    page = (ROOT / "CONTRIBUTING.md").read_text("utf-8").partition("\n### Changelog\n")[2]
    assert re.findall(r"^\| `(\w+)` \|", page, re.MULTILINE) == kinds.split("|")
    shown = re.findall(r"changelog\.d/(\S+)", page)
    fragments = [path for path in (ROOT / settings["directory"]).iterdir() if path.name != "README.md"]
    names = [*shown, *(path.name for path in fragments)]
    assert [name for name in names if not re.fullmatch(rf"\+[\w-]+\.(?:{kinds})\.md", name)] == []
    assert [path.name for path in fragments if not path.read_text("utf-8").strip()] == []


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.name)
def test_files_for_the_project_page_are_read(path):
    content = yaml.safe_load(path.read_text("utf-8"))
    if path.parent.name != "workflows":
        assert "body" in content or "blank_issues_enabled" in content
        return
    assert content["permissions"] == {"contents": "read"}
    for job in content["jobs"].values():
        assert job["runs-on"]
        for step in job["steps"]:
            assert ("run" in step) != ("uses" in step)
            for script in re.findall(r"\.ci/\w+", step.get("run", "")):
                assert (ROOT / script).is_file()


def test_a_release_is_published_without_a_password():
    content = (ROOT / ".github" / "workflows" / "release.yml").read_text("utf-8")
    publish = yaml.safe_load(content)["jobs"]["publish"]
    assert publish["permissions"]["id-token"] == "write"
    assert publish["needs"] == "build"
    assert "secrets." not in content


def test_what_runs_before_a_commit_is_there():
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text("utf-8"))["repos"][0]["hooks"]
    for hook in hooks:
        for name in re.findall(r"tests/\S+", hook["entry"]):
            assert (ROOT / name).is_file()


@pytest.mark.parametrize("path", new_version["PLACES"])
def test_a_new_version_is_set_where_the_version_is_said(path):
    text = (ROOT / path).read_text("utf-8")
    changed = new_version["with_version"](path, text, "123.4.5")
    assert changed.count("123.4.5") == 1
    assert changed.replace("123.4.5", mechwright.__version__) == text
    with pytest.raises(SystemExit, match="says a version 0 times"):
        new_version["with_version"](path, "", "123.4.5")


def test_what_was_unreleased_comes_into_the_first_part_ahead_of_fragments():
    before = "# Changelog\n\n## 1.2.3 - 2026-01-31\n\n### Added\n\n- A rack.\n\n\n## Unreleased\n\n{}### Gears\n\n- Pairs.\n"
    after = "# Changelog\n\n## 1.2.3 - 2026-01-31\n\n### Gears\n\n- Pairs.\n\n### Added\n\n- A rack.\n"
    for first in ("", "The first version, 0.1.0.\n\n"):
        assert new_version["joined"](before.format(first)) == after
    assert new_version["joined"](after) == after
    with pytest.raises(SystemExit, match="run towncrier build"):
        new_version["joined"]("# Changelog\n\n## Unreleased\n\n### Gears\n")


@pytest.mark.parametrize("version", ["1.2", "v1.2.3", "1.2.3rc1"])
def test_what_is_no_version_is_refused(version):
    with pytest.raises(SystemExit, match=f"{version}: is no version; write one such as 1.2.3"):
        new_version["main"]([version])
