"""Commands that pages show are commands; those of the tutorial and the how-to print what the pages say."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
import typer.main
from by_night import in_ci

from mechwright.cli.app import make_app

ROOT = Path(__file__).parents[1]
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "examples").rglob("*.md")])
BLOCK = re.compile(r'^```(\w+)(?: title="([^"]+)")?\n(.*?)^```$', re.M | re.S)
SHOWN = re.compile(r"^(?:    |\$ )(?:\.venv/bin/)?mechwright ([a-z].*)$", re.M)
PLACES = {"[", "|", "..."}
"""Signs of a synopsis, which nobody types."""


def arguments(page):
    """The words after ``mechwright`` of every command that a page shows on a line of its own."""
    found = SHOWN.findall(page.read_text(encoding="utf-8"))
    return [shlex.split(line, comments=True) for line in found if not any(sign in line for sign in PLACES)]


@pytest.mark.parametrize("page", [page for page in PAGES if arguments(page)], ids=lambda page: page.name)
def test_commands_that_are_shown_can_be_called_so(page):
    group = typer.main.get_command(make_app())
    for words in arguments(page):
        command = group.commands[words[0]]
        context = command.context_class(command, info_name=words[0], resilient_parsing=True)
        command.make_parser(context).parse_args(list(words[1:]))


def session(page):
    """Files and commands of a page in their order: ("file", name, text) and ("run", line, lines it prints)."""
    for language, title, text in BLOCK.findall(page.read_text(encoding="utf-8")):
        if title:
            yield "file", title, text
        elif language == "console":
            for piece in text.split("\n$ "):
                line, *printed = piece.removeprefix("$ ").strip("\n").split("\n")
                yield "run", line, printed


def printed(shown, output):
    """Whether a line of a page, with … for what is left out, is one that was printed."""
    pattern = re.compile(".*".join(re.escape(piece) for piece in shown.strip().split("…")))
    return any(pattern.fullmatch(line.strip()) for line in output.splitlines())


def test_lines_are_compared():
    assert printed("a … c", "x\na b c\n")
    assert not printed("a … c", "a b d")
    assert not printed("a", "ab")


def test_sessions_have_commands():
    for name, least in (("tutorial", 8), ("how-to", 12)):
        kinds = [kind for kind, *_ in session(ROOT / "docs" / f"{name}.md")]
        assert kinds.count("run") >= least
        assert "file" in kinds


@in_ci
@pytest.mark.parametrize("name", ["tutorial", "how-to"])
def test_what_a_page_shows_is_what_is_printed(name, tmp_path):
    paths = {**os.environ, "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    for kind, what, shown in session(ROOT / "docs" / f"{name}.md"):
        if kind == "file":
            (tmp_path / what).write_text(shown, encoding="utf-8")
            continue
        done = subprocess.run(  # noqa: S602 - our own pages
            what,
            shell=True,
            cwd=tmp_path,
            env=paths,
            capture_output=True,
            text=True,
            check=False,
            timeout=600,
        )
        output = done.stdout + done.stderr
        assert "Traceback" not in output
        assert [line for line in shown if not printed(line, output)] == [], f"{what}\n{output}"
        failed = any(" cannot be built" in line or " does not " in line for line in shown)
        assert done.returncode == int(failed), f"{what}\n{output}"
