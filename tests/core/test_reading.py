"""Files that somebody names: only regular ones are read, and what is said of them is never long."""

import ast
import os
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from mechwright import reading
from mechwright.contracts.finding import Finding
from mechwright.designs.change import rewritten
from mechwright.designs.files import SIZE_LIMIT, read_toml
from mechwright.errors import LONGEST, MOST_LINES, DesignError, MechwrightError, OutputError, shortened
from mechwright.output.folder import Output, write_folder, write_new

ROOT = Path(__file__).parents[2]
READS_ITSELF = {
    "core/mechwright/reading.py",
    # Files of the program itself, or of what is installed.
    "core/mechwright/cli/demo.py",
    "core/mechwright/extras.py",
    "core/mechwright/plugins/host.py",
    "core/mechwright/standards/table.py",
    "core/mechwright/studies/checks.py",
    "core/mechwright/studies/fingerprint.py",
    "core/mechwright/worker_pool/store.py",
    "cam/mechwright_cad/live/server.py",
    "cam/mechwright_cut/settings/services.py",
    "cam/mechwright_cut/settings/figures.py",
}
APART = {"addon", "mechwright_check", "testing"}
"""Folders of what runs in another program or is a distribution of its own, and of the kit for tests."""


@pytest.fixture
def no_file(request, tmp_path):
    """Something of a kind, under a name."""
    place = tmp_path / "thing"
    match request.param:
        case "a pipe":
            os.mkfifo(place)
        case "a folder":
            place.mkdir()
        case "a device":
            place.symlink_to("/dev/zero")
        case "a socket":
            with socket.socket(socket.AF_UNIX) as listening:
                listening.bind(str(place))
                yield place, request.param
            return
    yield place, request.param


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no pipes with names")
@pytest.mark.parametrize("no_file", ["a pipe", "a folder", "a device", "a socket"], indirect=True)
def test_what_is_no_regular_file_is_named_and_neither_read_nor_waited_for(no_file, tmp_path):
    place, kind = no_file
    link = tmp_path / "link"
    link.symlink_to(place)
    for path in (place, link):
        assert not reading.regular(path)
        with pytest.raises(OutputError, match=f"cannot be read: it is {kind}; name a regular file"):
            reading.read_bytes(path)
    with pytest.raises(OutputError, match=f"is {kind}, which is not replaced"):
        write_new(place, "text", replace=True)


def test_a_file_is_read_up_to_its_limit(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"12345")
    assert reading.read_bytes(path, 5) == b"12345"
    with pytest.raises(DesignError, match="larger than 4 bytes"):
        reading.read_bytes(path, 4)


@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="the system has no such file")
def test_a_file_that_has_no_size_before_it_is_read_is_limited_all_the_same():
    assert reading.read_bytes(Path("/proc/self/maps"))
    with pytest.raises(DesignError, match="larger than 10 bytes"):
        reading.read_bytes(Path("/proc/self/maps"), 10)


def test_a_file_that_takes_too_long_is_given_up(tmp_path, monkeypatch):
    path = tmp_path / "file"
    path.write_bytes(b"12345")
    monkeypatch.setattr(reading, "SECONDS", -1.0)
    with pytest.raises(OutputError, match="takes more than"):
        reading.read_bytes(path)


@pytest.mark.parametrize("no_file", ["a pipe", "a device"], indirect=True)
def test_a_manifest_that_is_no_file_is_somebody_elses(no_file, tmp_path):
    place, _ = no_file
    folder = tmp_path / "out"
    folder.mkdir()
    place.rename(folder / "manifest.json")
    with pytest.raises(OutputError, match="this program has not written"):
        write_folder(folder, Output({"a": b""}), "solve", {})


@pytest.mark.parametrize(
    "value", ["9" * 5000, "-9223372036854775809", "0x" + "f" * 5000, "[[9223372036854775808]]"]
)
def test_an_integer_of_more_than_64_bits_is_no_toml(value, tmp_path):
    path = tmp_path / "a.toml"
    path.write_text(f"[table]\nkey = {value}\n")
    with pytest.raises(DesignError, match="at most 19 digits") as caught:
        read_toml(path)
    assert len(str(caught.value).removeprefix(str(path))) < 100
    path.write_text("key = [9223372036854775807, -9223372036854775808]\n")
    assert read_toml(path)[0]["key"][0] == 2**63 - 1


@pytest.mark.parametrize(
    "text",
    [
        "a." * 450_000 + "b = 1\n",
        "[" + "a." * 450_000 + "b]\nc = 1\n",
        "x = {" + "a . 'b' .\t\"c\"." * 30 + "d = 1}\n",
        "[" + ".".join("a" * 65) + "]\n",
        r'"\"".' * 100_000 + "b = 1\n",
        r'"a\\".' * 100_000 + "b = 1\n",
        "''." * 200_000 + "b = 1\n",
        "[[" + "a." * 450_000 + "b]]\n",
    ],
    ids=["key", "table", "inline", "just", "escaped", "backslashes", "empty", "tables"],
)
def test_a_key_of_many_parts_is_refused_at_once(text, tmp_path):
    """Who reads it takes the square of their number: 300,000 took minutes."""
    path = tmp_path / "a.toml"
    path.write_text(text)
    began = time.process_time()
    with pytest.raises(DesignError, match="a key with more than 64 parts"):
        read_toml(path)
    assert time.process_time() - began < 1


def test_a_key_of_sixty_four_parts_and_a_text_of_more_are_read(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text('s = "' + "a." * 100 + '"\n[' + ".".join("a" * 64) + "]\n")
    assert read_toml(path)[0]["s"] == "a." * 100


def filled(line, before=""):
    """A text of nearly as many bytes as a file may have, whose lines have their numbers in them."""
    count = (SIZE_LIMIT - len(before)) // len(line.format(100_000))
    return before + "".join(line.format(number) for number in range(count))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            filled("a." * 60 + "b{} = 1\n", "[" + "h." * 60 + "h]\n"),
            "a key with more than 8 parts in more than",
        ),
        (filled("a{} = 1\n", "[" + "h." * 60 + "h]\n"), "a key with more than 8 parts in more than"),
        (filled("[" + "h." * 60 + "b{}]\n"), "a key with more than 8 parts in more than"),
        ("x = {" + filled("a." * 60 + "b{} = 1, ") + "c = 1}", "a key with more than 8 parts in more than"),
        (filled("a{} = 1\n", "[" + "h" * 500_000 + "]\n"), "has 500,000 characters; write at most 255"),
        ("a = " + "[" * 100_000 + "]" * 100_000, "nested too deep"),
        ("a = " + "{a = " * 100_000 + "1" + "}" * 100_000, "nested too deep"),
        ("a = " + "9" * 900_000, "at most 19 digits"),
        ("a = 0x" + "f" * 900_000, "at most 19 digits"),
    ],
    ids=["keys", "table", "tables", "inline", "name", "lists", "inline-tables", "digits", "hexadecimal"],
)
def test_what_would_take_long_or_much_memory_is_refused_at_once(text, said, tmp_path):
    path = tmp_path / "a.toml"
    path.write_text(text)
    began = time.process_time()
    with pytest.raises(DesignError, match=said) as caught:
        read_toml(path)
    assert time.process_time() - began < 2
    assert len(str(caught.value)) < 500


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a = 1\n" + "# more\n" * 30_000, "has 210,006 characters; at most 200,000 are rewritten"),
        ("a." * 9 + "b = 1\n", "has a key with more than 8 parts"),
    ],
)
def test_what_would_take_long_to_rewrite_is_refused_at_once(text, said):
    began = time.process_time()
    with pytest.raises(DesignError, match=said):
        rewritten(text, {"a": 2})
    with pytest.raises(DesignError, match="has 200,0"):
        rewritten("a = 1\n", {"a": "x" * 200_000})
    assert time.process_time() - began < 2


def test_a_table_with_long_names_is_read(tmp_path):
    """Layers of drawings have up to 255 characters."""
    path = tmp_path / "a.toml"
    path.write_text(f'[parameters.layers]\n"{"x" * 255}" = "outline"\n')
    assert len(read_toml(path)[0]["parameters"]["layers"]) == 1


def test_every_message_has_a_length():
    long = f"a.toml: key: {'9' * 100_000!r} is too long; write less"
    for said in (str(DesignError(long)), Finding.error("a.b", "key", long).message):
        assert said.startswith("a.toml: key: '999")
        assert said.endswith("999' is too long; write less")
        assert "characters more" in said
        assert len(said) < LONGEST
    many = str(DesignError("\n".join(f"line {k}" for k in range(30_000)))).splitlines()
    assert (len(many), many[-1]) == (MOST_LINES, "and 29,951 lines more")
    within = str(DesignError("\n".join(f"b.toml: {line}" for line in many)))
    assert within.splitlines()[-1] == "b.toml: and 29,951 lines more"
    assert shortened("x" * LONGEST) == "x" * LONGEST


def test_thirty_thousand_unknown_keys_are_told_in_a_second(tmp_path):
    path = tmp_path / "a.toml"
    keys = "".join(f"key{k} = 1\n" for k in range(30_000))
    path.write_text(f'family = "elliptic-gears"\n[parameters]\n{keys}')
    from mechwright import load

    begun = time.process_time()
    with pytest.raises(MechwrightError, match=r"line 3: parameters: unknown key 'key0'") as caught:
        load(path)
    assert time.process_time() - begun < 5.0
    said = str(caught.value)
    assert len(said) < 100_000
    assert said.endswith("and 29,951 lines more")


def test_the_command_line_refuses_a_pipe(tmp_path):
    os.mkfifo(tmp_path / "a.toml")
    words = [sys.executable, "-m", "mechwright", "check", "a.toml"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False)
    said = "mechwright: a.toml: cannot be read: it is a pipe; name a regular file\n"
    assert (done.returncode, done.stderr) == (2, said)


def test_one_place_opens_what_is_read():
    """Whoever reads a file asks for its content there; a file that is written is opened elsewhere."""
    found = set()
    for folder in ("core", "cam", "plugins"):
        for file in sorted((ROOT / folder).rglob("*.py")):
            if APART & set(file.parts):
                continue
            for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Call) and _reads(node):
                    found.add(str(file.relative_to(ROOT)))
    assert found <= READS_ITSELF


def _reads(call: ast.Call) -> bool:
    """Whether a call opens a file to read it: pathlib's words, or open without a mode that writes."""
    name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
    if name in {"read_text", "read_bytes"}:
        # Ours are functions that take the path; pathlib's are methods that take none.
        return isinstance(call.func, ast.Attribute) and not (
            call.args and isinstance(call.func.value, ast.Name)
        )
    of = call.func.value if isinstance(call.func, ast.Attribute) else None
    if name != "open" or (isinstance(of, ast.Name) and of.id in {"os", "webbrowser", "archive"}):
        return False
    modes = [one.value for one in call.args if isinstance(one, ast.Constant) and isinstance(one.value, str)]
    return not any(letter in mode for mode in modes for letter in "wax")
