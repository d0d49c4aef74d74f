"""The documents say what is there, all of it, and only what may be said."""

import importlib
import inspect
import re
from pathlib import Path

import pytest
import rule_page
from imported import sources

import mechwright
from mechwright.contracts.plugin import HOOK_API
from mechwright.plugins import hookspecs
from mechwright.plugins.host import COMMANDS, GROUP
from mechwright_cam.controls.contract import Control

ROOT = Path(__file__).parents[1]
TEMPLATES = sorted((ROOT / "examples").glob("*-template"))
TEMPLATE = ROOT / "examples" / "plugin-template"
PLUGIN_PAGES = [ROOT / "docs" / "plugins.md", *sorted((ROOT / "docs" / "plugins").glob("*.md"))]
PLUGINS = "\n".join(page.read_text(encoding="utf-8") for page in PLUGIN_PAGES)
"""What the pages on plugins say."""
REFERENCE = set(
    re.findall(
        r"^::: mechwright\.(\w+)$",
        "\n".join(
            (ROOT / "docs" / "reference" / f"{name}.md").read_text(encoding="utf-8")
            for name in ("contracts", "scripts")
        ),
        re.M,
    )
)
"""Public names whose docstrings the pages of reference print."""

SKIPPED = {"node_modules", "dist", "out", "__pycache__"}
"""Folders that are not the project's text."""
BUILT = ROOT / "build"
"""What a packager leaves."""

CONTRACTS = (
    "mechwright.pipeline",
    "mechwright.cli.command",
    "mechwright.contracts.exporter",
    "mechwright.contracts.family",
    "mechwright.contracts.finding",
    "mechwright.contracts.joint",
    "mechwright.contracts.motion",
    "mechwright.contracts.parameters",
    "mechwright.contracts.part",
    "mechwright.contracts.plugin",
    "mechwright.contracts.synthesis",
    "mechwright.contracts.table",
    "mechwright.contracts.tolerances",
    "mechwright.errors",
    "mechwright.geometry",
    "mechwright.testing",
    "mechwright_cam.controls.contract",
    "mechwright_cam.program.moves",
    "mechwright_cam.testing",
)
"""Modules whose classes a plugin may use or has to write."""

GROUPS = {"mechwright.commands"}
"""Entry-point groups, which have the form of modules."""


def files(*suffixes):
    return sorted(
        path
        for path in ROOT.rglob("*")
        if path.suffix in suffixes
        and path.is_file()
        and not path.is_relative_to(BUILT)
        and not any(part in SKIPPED or part.startswith(".") for part in path.relative_to(ROOT).parts)
    )


def relative(path):
    return str(path.relative_to(ROOT))


DOCUMENTS = files(".md")
QUOTES = re.findall(r'^```\w+ title="([^"]+)"\n(.*?)^```$', PLUGINS, re.M | re.S)


def test_every_hook_is_documented():
    hooks = [name for name in vars(hookspecs) if name.startswith("mechwright_register")]
    assert hooks == ["mechwright_register"]
    assert [hook for hook in hooks if f"| `{hook}` |" not in PLUGINS] == []
    assert set(re.findall(r"mechwright_register\w*", PLUGINS)) == set(hooks), "a hook that is not there"


def test_the_groups_of_entry_points_and_the_version_of_the_contracts_are_documented():
    assert {GROUP, COMMANDS} <= set(re.findall(r"^\| `([\w.]+)` \| .* \| .* \|$", PLUGINS, re.M))
    assert f"`HOOK_API` is the version of the contracts, {HOOK_API} in this release" in PLUGINS


def public_classes():
    for name in CONTRACTS:
        module = importlib.import_module(name)
        for member in getattr(module, "__all__", vars(module)):
            value = getattr(module, member)
            ours = inspect.isclass(value) and value.__module__.startswith(name)
            if ours and not member.startswith("_") and not getattr(value, "_is_protocol", False):
                yield member


def test_every_public_class_of_the_contracts_is_documented():
    names = sorted(set(public_classes()))
    assert {"Family", "Control", "Exporter", "Page", "FamilyContract", "Outline", "Finding"} <= set(names)
    assert [name for name in names if name not in REFERENCE and not re.search(rf"`{name}\b", PLUGINS)] == []


def test_the_page_of_rules_is_what_families_declare():
    assert rule_page.PAGE.read_text(encoding="utf-8") == rule_page.page(), (
        "python docs/rule_page.py writes it anew"
    )


@pytest.mark.parametrize(
    ("title", "name", "besides"),
    [
        ("Geneva mechanism", "geneva", {"as-made", "as-made-lock", "requirement"}),
        ("Cam and follower", "cam-follower", set()),
    ],
)
def test_the_page_of_a_family_lists_its_rules(title, name, besides):
    section = rule_page.page().partition(f"## {title}\n")[2].partition("\n## ")[0]
    codes = rf"`((?:bore|{name.removeprefix('cam-')})\.[\w-]+)`"
    declared = set(re.findall(codes, section))
    listed = set(re.findall(codes, (ROOT / "docs" / f"{name}.md").read_text("utf-8")))
    assert declared - listed == set()
    assert listed - declared == {f"{name}.{one}" for one in besides}


def test_every_public_name_is_documented_and_can_be_imported():
    names = mechwright.__all__
    assert len(names) == len(set(names)) > 50
    assert [name for name in names if not hasattr(mechwright, name)] == []
    assert [name for name in names if inspect.ismodule(getattr(mechwright, name))] == [], "it hides a name"
    assert [name for name in names if name not in REFERENCE] == ["__version__"]
    assert "`mechwright.__version__`" in PLUGINS
    assert "(reference/contracts.md)" in PLUGINS
    assert "(reference/scripts.md)" in PLUGINS
    assert [
        name
        for name in names
        if (inspect.isclass(value := getattr(mechwright, name)) or inspect.isfunction(value))
        and not inspect.getdoc(value)
    ] == []


@pytest.mark.parametrize("path", [path for path in DOCUMENTS if path.name != "CHANGELOG.md"], ids=relative)
def test_every_dotted_name_leads_somewhere(path):
    packages = {name.split(".")[0] for name in sources()}
    named = set(re.findall(r"\b(mechwright\w*(?:\.\w+)+)", path.read_text(encoding="utf-8")))
    assert [
        name for name in sorted(named - GROUPS) if name.split(".")[0] in packages and not leads(name)
    ] == []


def leads(name):
    """Whether a dotted name is a module, or an attribute of one."""
    module, _, attribute = name.rpartition(".")
    try:
        importlib.import_module(name)
    except ModuleNotFoundError:
        return bool(module) and leads(module) and hasattr(importlib.import_module(module), attribute)
    return True


def test_names_that_lead_nowhere_are_found():
    assert leads("mechwright.contracts.family.Family")
    assert leads("mechwright.units")
    assert not leads("mechwright.contracts.family.Post")
    assert not leads("mechwright.post")


@pytest.mark.parametrize(("name", "quote"), QUOTES, ids=[f"{n}-{name}" for n, (name, _) in enumerate(QUOTES)])
def test_quotes_are_the_template_word_for_word(name, quote):
    holds = [template / name for template in TEMPLATES if (template / name).is_file()]
    source = "\n".join(path.read_text(encoding="utf-8") for path in holds)
    assert f"\n{quote}" in f"\n{source}", f"{name} does not hold these lines:\n{quote}"


def test_the_walk_visits_every_module_of_the_template():
    modules = {path.name for path in (TEMPLATE / "src").rglob("*.py")} - {"__init__.py"}
    assert modules <= {Path(name).name for name, _ in QUOTES}
    assert {"pyproject.toml", "test_scotch_yoke.py"} <= {Path(name).name for name, _ in QUOTES}


def headings(path):
    text = re.sub(r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.M | re.S)
    titles = re.findall(r"^#+ (.+)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def test_every_member_of_a_control_is_documented():
    members = [name for name in {**vars(Control), **Control.__annotations__} if not name.startswith("_")]
    assert len(members) > 15
    assert [name for name in members if f"`{name}`" not in PLUGINS] == []


@pytest.mark.parametrize("path", DOCUMENTS, ids=relative)
def test_links_lead_somewhere(path):
    text = re.sub(r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.M | re.S)
    for target in re.findall(r"\]\(([^)\s]+)[^)]*\)", text):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, anchor = target.partition("#")
        to = (path.parent / file).resolve() if file else path
        assert to.exists(), f"{relative(path)} links to {target}"
        assert to.is_relative_to(ROOT), f"{relative(path)} links out of the project to {target}"
        if anchor and to.suffix == ".md":
            assert anchor in headings(to), f"{relative(path)} links to {target}"


# Written apart, so that this file does not hold what it looks for.
HOSTS = ["py" + "pi.org", "python" + "hosted.org", "index-" + "url", "extra-" + "index"]
MACHINE = re.compile(
    r"(?<![\w.~$}])/(?:" + "|".join(("ho" + "me", "ro" + "ot", "wo" + "rk", "Us" + "ers")) + r")/\w|C:\\\\?\w"
)


def test_no_text_tells_of_a_machine():
    """A registry is the user's own choice, and a path of a machine is somebody's own."""
    found = {}
    for path in files(".md", ".py", ".toml", ".html", ".j2", ".cfg"):
        text = path.read_text(encoding="utf-8")
        if told := [host for host in HOSTS if host in text] + MACHINE.findall(text):
            found[relative(path)] = told
    assert found == {}


def test_there_are_texts_to_look_at():
    assert {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/plugins.md"} <= set(
        map(relative, DOCUMENTS)
    )


def test_the_tool_library_on_the_page_on_cutters_can_be_read(tmp_path):
    from mechwright_cam.shop.library import load_library

    page = (ROOT / "docs" / "machining" / "cutters.md").read_text(encoding="utf-8")
    (library,) = re.findall(r"^```toml\n(# my-tools.*?)^```$", page, re.M | re.S)
    (tmp_path / "my-tools.toml").write_text(library, encoding="utf-8")
    assert load_library(tmp_path / "my-tools.toml").get("mill-quarter-inch").diameter == 6.35
