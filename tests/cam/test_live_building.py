"""A build that a page has asked for: it ends with the server, however that one ends."""

import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from test_live import Page

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="asks Linux which processes there are")
ROOT = Path(__file__).parents[2]


def below(number: int) -> set[int]:
    """The processes that a process has started, and those that these have."""
    found: set[int] = set()
    for one in Path(f"/proc/{number}/task").glob("*/children"):
        for child in map(int, one.read_text().split()):
            found |= {child} | below(child)
    return found


def living(numbers: set[int]) -> set[int]:
    found = set()
    for number in numbers:
        try:
            state = Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            continue
        if state != "Z":
            found.add(number)
    return found


def gone(numbers: set[int]) -> bool:
    end = time.monotonic() + 10
    while living(numbers) and time.monotonic() < end:
        time.sleep(0.05)
    return not living(numbers)


def test_what_a_killed_server_has_started_ends_with_it(tmp_path: Path) -> None:
    path = tmp_path / "pair.toml"
    shutil.copy(ROOT / "examples" / "elliptic-pair.toml", path)
    page = Page(path)
    assert page.ask("build", change={})["state"] == "runs"
    end = time.monotonic() + 60
    while not below(page.process.pid) and time.monotonic() < end:
        time.sleep(0.05)
    started = below(page.process.pid)
    assert started
    page.process.kill()
    page.process.communicate()
    assert gone(started)
    assert not path.with_name("pair-build").exists()


STARTS = """
import os, subprocess, sys
words = "import sys, time; from mechwright.worker_pool import lifeline; {how}; time.sleep(600)"
child = subprocess.Popen([sys.executable, "-c", words, str(os.getpid())])
print(child.pid, flush=True)
sys.stdin.read()
"""
WAYS = {
    "by the system": "lifeline.end_with_parent(int(sys.argv[1]))",
    "by looking": "import threading; threading.Thread(target=lifeline._watch, args=(int(sys.argv[1]),)).start()",
}


@pytest.mark.parametrize("how", WAYS.values(), ids=WAYS)
def test_a_child_ends_with_its_parent(how: str) -> None:
    parent = subprocess.Popen(
        [sys.executable, "-c", STARTS.format(how=how)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert parent.stdout is not None
    child = int(parent.stdout.readline())
    time.sleep(0.5)
    assert living({child})
    parent.kill()
    parent.communicate()
    assert gone({child})


def test_a_child_whose_parent_has_ended_before_ends_at_once() -> None:
    words = "from mechwright.worker_pool.lifeline import end_with_parent; end_with_parent(1); print('lives')"
    done = subprocess.run([sys.executable, "-c", words], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (1, "")
