"""The commands as tools of the Model Context Protocol, asked by the protocol's own client."""

import json
import os
import re
import subprocess
import sys
from contextlib import asynccontextmanager
from pathlib import Path

import pytest
from by_night import in_ci

from mechwright.agent import running
from mechwright.agent.folder import LARGEST, SHOWN, Folder
from mechwright.agent.server import NONSENSE, READ, WRITE, Tools
from mechwright.errors import DesignError, OutputError

ROOT = Path(__file__).parents[2]


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "work").mkdir()
    (tmp_path / "secret.toml").write_text("family = 'plate'\n")
    return Folder(tmp_path / "work")


@pytest.mark.parametrize(
    "name",
    [
        "",
        "../secret.toml",
        "/etc/passwd",
        "~/x.toml",
        "-x",
        "--write",
        "a/../../secret.toml",
        "a\0b",
        "link.toml",
        "up/secret.toml",
    ],
)
def test_no_path_leads_out_of_the_folder(folder, name):
    (folder.root / "link.toml").symlink_to(folder.root.parent / "secret.toml")
    (folder.root / "up").symlink_to(folder.root.parent)
    for ask in (folder.path, folder.text, lambda one: folder.write(one, "a = 1\n", replace=True)):
        with pytest.raises(DesignError, match="folder"):
            ask(name)
    assert (folder.root.parent / "secret.toml").read_text() == "family = 'plate'\n"


@pytest.mark.parametrize("name", READ + WRITE)
def test_every_tool_refuses_a_path_outside(folder, name, monkeypatch):
    monkeypatch.setattr(running.subprocess, "Popen", lambda *_, **__: pytest.fail("a command was run"))
    tool = getattr(Tools(folder), name)
    calls = {
        "new": [("plate", "../x.toml"), ("plate", "x.toml", "", "../s.toml")],
        "read": [("../secret.toml",)],
        "write": [("../x.toml", "")],
        "check": [("../secret.toml",)],
        "fix": [("../secret.toml",)],
        "verify": [(["../a.nc"], "a.toml", "a"), (["a.nc"], "../secret.toml", "a")],
        "synthesize": [("../secret.toml", "out"), ("a.toml", "../out")],
        **{
            command: [("../secret.toml", "out"), ("a.toml", "../out")]
            for command in ("solve", "model", "cam", "build")
        },
    }
    for words in calls.get(name, ()):
        with pytest.raises(DesignError, match="folder"):
            tool(*words)


def test_texts_are_written_once_replaced_on_demand_and_shown_in_pieces(folder):
    assert folder.write("a/b.toml", "x = 1\n", replace=False) if (folder.root / "a").mkdir() is None else None
    with pytest.raises(OutputError, match="there already"):
        folder.write("a/b.toml", "x = 2\n", replace=False)
    folder.write("a/b.toml", "x = 2\n", replace=True)
    assert folder.text("a/b.toml") == "x = 2\n"
    for name, text in (("a.py", "import os\n"), ("a.toml", "x" * (LARGEST + 1))):
        with pytest.raises(DesignError, match=r"only \.toml|the limit is"):
            folder.write(name, text, replace=False)
    folder.write("long.csv", "1\n" * SHOWN, replace=False)
    first = folder.text("long.csv")
    assert first.endswith(f"... {SHOWN} more characters: start = {SHOWN}")
    assert folder.text("long.csv", SHOWN) == "1\n" * (SHOWN // 2)
    assert folder.files() == ["a/b.toml", "long.csv"]


def test_a_command_that_takes_too_long_is_ended(tmp_path):
    found = running.run(tmp_path, ["families"], 0.01)
    assert (found["ok"], found["code"]) == (False, None)
    assert found["said"] == ["families took longer than 0.01 s and was ended"]


def test_a_long_answer_says_how_much_is_left_out():
    found = running.shortened({"ok": True, "code": 0, "answer": ["x" * running.MOST], "said": []})
    assert found["answer"].endswith("... 4 more characters")
    assert running.shortened({"answer": [1]}) == {"answer": [1]}


def test_a_folder_that_is_none_is_refused(tmp_path):
    with pytest.raises(DesignError, match="is no folder"):
        Folder(tmp_path / "none")


@asynccontextmanager
async def session(root):
    mcp = pytest.importorskip("mcp", reason="pip install 'mechwright[mcp]'")
    from mcp.client.stdio import StdioServerParameters, stdio_client

    words = ["-m", "mechwright", "mcp", str(root)]
    path = os.pathsep.join(filter(None, sys.path))
    server = StdioServerParameters(command=sys.executable, args=words, env={**os.environ, "PYTHONPATH": path})
    async with stdio_client(server) as (reading, writing), mcp.ClientSession(reading, writing) as client:
        await client.initialize()
        yield client


async def ask(client, tool, **words):
    """What a tool answers as data, which must not be an error."""
    found = await client.call_tool(tool, words)
    assert not found.is_error, found.content
    return json.loads(found.content[0].text)


async def errors(client, tool, **words):
    found = await client.call_tool(tool, words)
    assert found.is_error
    return found.content[0].text


def run(of, *arguments):
    anyio = pytest.importorskip("anyio", reason="pip install 'mechwright[mcp]'")
    anyio.run(of, *arguments)


def test_a_client_is_offered_the_commands_and_told_what_is_wrong(tmp_path):
    run(_short_session, tmp_path)


async def _short_session(root):
    async with session(root) as client:
        offered = (await client.list_tools()).tools
        assert {tool.name for tool in offered} == {*READ, *WRITE}
        assert all(tool.description for tool in offered)
        reads = {tool.name for tool in offered if tool.annotations.read_only_hint}
        assert reads == set(READ)
        assert "leads out of the folder" in await errors(client, "check", design="../x.toml")
        assert "Input should be" in await errors(client, "check", design="x.toml", to="moon")
        assert "nknown" in await errors(client, "format_disk")
        assert (await ask(client, "check", design="none.toml"))["code"] == 2


def test_lines_that_are_no_messages_are_told_one_by_one(tmp_path):
    pytest.importorskip("mcp", reason="pip install 'mechwright[mcp]'")
    done = subprocess.run(
        [sys.executable, "-m", "mechwright", "mcp", str(tmp_path)],
        input="hello\n{}\n",
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stdout) == (0, "")
    assert done.stderr == 2 * f"mechwright: {NONSENSE}\n"


@in_ci
def test_from_a_requirement_to_a_proven_program(tmp_path):
    run(_whole_session, tmp_path)


async def _whole_session(root):
    """Requirement, candidates, a change that spoils one, its fix, programs, proof."""
    async with session(root) as client:
        families = (await ask(client, "families"))["answer"]
        assert "slider-crank" in {one["name"] for one in families}
        text = (ROOT / "examples" / "slider-crank-stroke-requirement.toml").read_text(encoding="utf-8")
        await client.call_tool("write", {"file": "wish.toml", "text": text})
        found = await ask(client, "synthesize", requirement="wish.toml", output="found")
        assert found["ok"], found
        files = (await client.call_tool("files", {})).structured_content["result"]
        design = next(one for one in files if one.startswith("found/") and one.endswith(".toml"))
        told = (await client.call_tool("read", {"file": design})).content[0].text
        spoilt = re.sub(r"(?m)^# pin = .*$", "pin = 60", told)
        assert spoilt != told
        await client.call_tool("write", {"file": design, "text": spoilt, "replace": True})
        checked = await ask(client, "check", design=design, to="parts")
        assert not checked["ok"]
        assert any(one["severity"] == "error" for one in checked["answer"]["findings"])
        fixed = await ask(client, "fix", design=design, to="parts", write=True)
        assert fixed["ok"], fixed
        await client.call_tool("write", {"file": design, "text": told, "replace": True})
        built = await ask(client, "cam", design=design, output="out")
        assert built["ok"], built
        program = next((root / "out").glob("*.nc"))
        part = program.stem
        proof = await ask(client, "verify", programs=[f"out/{program.name}"], design=design, part=part)
        assert proof["ok"], proof
        program.write_text(program.read_text().replace("G1", "G0"))
        proof = await ask(client, "verify", programs=[f"out/{program.name}"], design=design, part=part)
        assert not proof["ok"]
