"""Worker processes that end in the middle of a result: the pool says nothing of them, and nobody waits for ever."""

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from multiprocessing import connection
from pathlib import Path

import pytest

from mechwright.studies import workers
from mechwright.studies.task import Task
from mechwright.studies.workers import Processes

TASKS = [Task(f"part-{number:06d}", number, number) for number in range(4)]
HERE = Path(__file__).parent
STOPPED = """\
import sys, time; sys.path.append({here!r})
from pathlib import Path
from test_sweep_workers import TASKS, Torn
from mechwright.studies.workers import Processes
if __name__ == "__main__":
    for task, _ in Processes(2).done(Torn({folder!r}, "sleep"), TASKS):
        print(task.name, flush=True)
        while not Path({folder!r}, "torn").exists():
            time.sleep(0.02)
        raise SystemExit(3)
"""


@dataclass(frozen=True)
class Torn:
    """A source whose third task, the first time, writes half of its result."""

    folder: str
    then: str
    family: str = "none"

    def told(self, task: Task) -> tuple[bytes, list[object]]:
        torn = Path(self.folder, "torn")
        if task.first == 2 and not torn.exists():

            def half(self_: connection.Connection, content: bytes) -> None:
                os.write(self_.fileno(), (len(content) + 1000).to_bytes(4, "big") + content)
                torn.touch()
                if self.then == "sleep":
                    time.sleep(600)
                os.kill(os.getpid(), signal.SIGKILL)

            connection.Connection._send_bytes = half
        return task.name.encode(), []


@pytest.mark.skipif(sys.platform == "win32", reason="kills as Linux does")
def test_a_worker_that_is_killed_while_it_writes_is_started_again(tmp_path, monkeypatch):
    monkeypatch.setattr(workers, "LOOK", 0.5)
    found = {task.name: content for task, content in Processes(2).done(Torn(str(tmp_path), "die"), TASKS)}
    assert found == {task.name: task.name.encode() for task in TASKS}
    assert (tmp_path / "torn").exists()


@pytest.mark.skipif(sys.platform == "win32", reason="writes as Linux does")
def test_a_sweep_that_is_stopped_while_a_worker_writes_ends(tmp_path):
    script = tmp_path / "stopped.py"
    script.write_text(STOPPED.format(here=str(HERE), folder=str(tmp_path)), encoding="utf-8")
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (3, "")
    assert not multiprocessing.active_children()
