"""Worker processes that end in the middle of a result: the task is done again, and nobody waits for ever."""

import os
import pickle
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import pytest
from listed_tasks import ListedTasks

from mechwright.errors import PluginError
from mechwright.studies.task import Task
from mechwright.studies.workers import Processes
from mechwright.worker_pool import serving

TASKS = [Task(f"part-{number:06d}", number, number) for number in range(4)]
HERE = Path(__file__).parent
STOPPED = """\
import sys, time; sys.path.append({here!r})
from pathlib import Path
from listed_tasks import ListedTasks
from test_sweep_workers import TASKS, Torn
from mechwright.studies.workers import Processes
if __name__ == "__main__":
    for task, _ in Processes(2).done(Torn({folder!r}, "sleep"), ListedTasks(TASKS)):
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

    def done(self, task: Task) -> bytes:
        torn = Path(self.folder, "torn")
        if task.first == 2 and not torn.exists():

            def half(message: object, known: object) -> None:
                serving._answers[0].write(pickle.dumps(message)[:-9])
                serving._answers[0].flush()
                torn.touch()
                if self.then == "sleep":
                    time.sleep(600)
                os.kill(os.getpid(), signal.SIGKILL)

            serving._send = half
        return task.name.encode()


@pytest.mark.skipif(sys.platform == "win32", reason="kills as Linux does")
def test_a_worker_that_is_killed_while_it_writes_is_started_again(tmp_path):
    found = {
        task.name: content
        for task, content in Processes(2).done(Torn(str(tmp_path), "die"), ListedTasks(TASKS))
    }
    assert found == {task.name: task.name.encode() for task in TASKS}
    assert (tmp_path / "torn").exists()


@pytest.mark.skipif(sys.platform == "win32", reason="writes as Linux does")
def test_a_sweep_that_is_stopped_while_a_worker_writes_ends(tmp_path):
    script = tmp_path / "stopped.py"
    script.write_text(STOPPED.format(here=str(HERE), folder=str(tmp_path)), encoding="utf-8")
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (3, "")


@dataclass(frozen=True)
class Deadly:
    """A source whose every task but the first kills its process."""

    folder: str
    family: str = "none"

    def done(self, task: Task) -> bytes:
        if task.first:
            with Path(self.folder, "killed").open("a") as file:
                file.write("x")
            os.kill(os.getpid(), signal.SIGKILL)
        return b""


@pytest.mark.skipif(sys.platform == "win32", reason="kills as Linux does")
def test_three_processes_that_are_killed_in_a_row_end_the_sweep(tmp_path):
    with pytest.raises(PluginError, match="killed again and again"):
        list(Processes(1).done(Deadly(str(tmp_path)), ListedTasks(TASKS)))
    assert (tmp_path / "killed").read_text() == "xxx"
