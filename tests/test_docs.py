"""The documents say what is there, all of it, and only what may be said."""

import importlib
import inspect
import re
from pathlib import Path

import pytest

from mechwright.plugins import hookspecs
from mechwright_cam.controls.contract import Control

ROOT = Path(__file__).parents[1]
TEMPLATE = ROOT / "examples" / "plugin-template"
CONTROL_TEMPLATE = ROOT / "examples" / "control-template"
PLUGINS = ROOT / "docs" / "plugins.md"

SKIPPED = {"node_modules", "build", "dist", "out", "__pycache__"}
"""Folders that are not the project's text."""

CONTRACTS = (
    "family",
    "output",
    "parameters",
    "findings",
    "motion",
    "part",
    "geometry",
    "program",
    "errors",
    "testing",
)
"""Modules whose classes a plugin may use or has to write."""


def files(*suffixes):
    return sorted(
        path
        for path in ROOT.rglob("*")
        if path.suffix in suffixes
        and path.is_file()
        and not any(part in SKIPPED or part.startswith(".") for part in path.relative_to(ROOT).parts)
    )


def relative(path):
    return str(path.relative_to(ROOT))


DOCUMENTS = files(".md")
QUOTES = re.findall(r'^```\w+ title="([^"]+)"\n(.*?)^```$', PLUGINS.read_text(encoding="utf-8"), re.M | re.S)


def test_every_hook_is_documented():
    hooks = [name for name in vars(hookspecs) if name.startswith("mechwright_register_")]
    assert len(hooks) >= 3
    text = PLUGINS.read_text(encoding="utf-8")
    assert [hook for hook in hooks if f"| `{hook}` |" not in text] == []
    assert set(re.findall(r"mechwright_register_\w+", text)) == set(hooks), "a hook that is not there"


def public_classes():
    for name in CONTRACTS:
        module = importlib.import_module(f"mechwright.{name}")
        exported = getattr(module, "__all__", vars(module))
        for member in exported:
            value = getattr(module, member)
            ours = inspect.isclass(value) and value.__module__.startswith(f"mechwright.{name}")
            if ours and not member.startswith("_") and not getattr(value, "_is_protocol", False):
                yield member


def test_every_public_class_of_the_contracts_is_documented():
    names = sorted(set(public_classes()))
    assert {"Family", "Exporter", "FamilyContract", "Outline", "Finding"} <= set(names)
    text = PLUGINS.read_text(encoding="utf-8")
    assert [name for name in names if not re.search(rf"`{name}\b", text)] == []


@pytest.mark.parametrize(("name", "quote"), QUOTES, ids=[f"{n}-{name}" for n, (name, _) in enumerate(QUOTES)])
def test_quotes_are_the_template_word_for_word(name, quote):
    holds = [template for template in (TEMPLATE, CONTROL_TEMPLATE) if (template / name).is_file()]
    source = "\n".join((template / name).read_text(encoding="utf-8") for template in holds)
    assert f"\n{quote}" in f"\n{source}", f"{name} does not hold these lines:\n{quote}"


def test_the_walk_visits_every_module_of_the_template():
    modules = {path.name for path in (TEMPLATE / "src").rglob("*.py")} - {"__init__.py"}
    assert modules <= {Path(name).name for name, _ in QUOTES}
    assert {"pyproject.toml", "test_scotch_yoke.py"} <= {Path(name).name for name, _ in QUOTES}


def test_every_member_of_a_control_is_documented():
    text = PLUGINS.read_text(encoding="utf-8")
    members = [name for name in {**vars(Control), **Control.__annotations__} if not name.startswith("_")]
    assert len(members) > 15
    assert [name for name in members if f"`{name}`" not in text] == []


def headings(path):
    text = re.sub(r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.M | re.S)
    titles = re.findall(r"^#+ (.+)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


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


@pytest.mark.parametrize("path", files(".md", ".py", ".toml", ".html", ".j2", ".cfg"), ids=relative)
def test_no_text_tells_of_a_machine(path):
    text = path.read_text(encoding="utf-8")
    assert [host for host in HOSTS if host in text] == [], "a registry is the user's own choice"
    assert MACHINE.findall(text) == [], "a path of somebody's machine"


def test_there_are_texts_to_look_at():
    assert {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/plugins.md"} <= set(
        map(relative, DOCUMENTS)
    )


def test_the_tool_library_on_the_page_on_machining_can_be_read(tmp_path):
    from mechwright_cam.shop.library import load_library

    page = (ROOT / "docs" / "machining.md").read_text(encoding="utf-8")
    (library,) = re.findall(r"^```toml\n(# my-tools.*?)^```$", page, re.M | re.S)
    (tmp_path / "my-tools.toml").write_text(library, encoding="utf-8")
    assert load_library(tmp_path / "my-tools.toml").get("mill-quarter-inch").diameter == 6.35
