"""Sweeps by several processes or a cluster: tables that are the same whoever makes them."""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from threading import Thread

import pytest
import strokes
import sweep_in_slices
from by_night import in_ci
from listed_tasks import ListedTasks
from strokes import bytes_of, swept

import mechwright
from mechwright.errors import PluginError
from mechwright.plugins.host import host
from mechwright.studies import cluster as studies_cluster
from mechwright.studies import workers
from mechwright.studies.run import evaluate
from mechwright.studies.study import load_study
from mechwright.studies.task import Source, Task
from mechwright.worker_pool.pool import WorkerPool


@in_ci
def test_processes_make_the_same_bytes_as_one(tmp_path):
    assert swept(tmp_path / "one", "--workers", "1").exit_code == 0
    assert swept(tmp_path / "two", "--workers", "2").exit_code == 0
    assert bytes_of(tmp_path / "one") == bytes_of(tmp_path / "two")


@pytest.fixture
def cluster(tmp_path):
    pytest.importorskip("distributed", reason="pip install 'mechwright[scale]'")
    started = []

    def start(*words, more=None):
        command = [sys.executable, "-m", f"distributed.cli.{words[0]}", *words[1:]]
        with (tmp_path / f"log-{len(started)}").open("wb") as out:
            started.append(
                subprocess.Popen(
                    command, stdout=out, stderr=out, start_new_session=True, env=os.environ | (more or {})
                )
            )
        return started[-1]

    yield start
    for process in started:
        process.terminate()
    for process in started:
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def scheduler_of(cluster, port):
    return cluster(
        "dask_scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard", "--no-show"
    )


def worker_of(cluster, port, folder, more=None):
    return cluster(
        "dask_worker", f"tcp://127.0.0.1:{port}", "--host", "127.0.0.1", "--nthreads", "1", "--no-nanny",
        "--no-dashboard", "--local-directory", str(folder), "--death-timeout", "60",
        more=more,
    )  # fmt: skip


@in_ci
def test_a_cluster_makes_the_same_bytes_though_a_worker_is_killed_and_the_scheduler_ends(tmp_path, cluster):
    assert swept(tmp_path / "one", "--workers", "1", text="keep = 'all'").exit_code == 0
    port = 20000 + os.getpid() % 20000
    first = scheduler_of(cluster, port)
    workers = [worker_of(cluster, port, tmp_path / name) for name in "ab"]
    path = tmp_path / "strokes.toml"
    command = [sys.executable, "-m", "mechwright", "sweep", str(path), "-o", str(tmp_path / "two")]
    running = subprocess.Popen(
        [*command, "--scheduler", f"tcp://127.0.0.1:{port}"],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    tables = tmp_path / "two" / "tables"
    end = time.monotonic() + 120
    while not (tables.is_dir() and any(tables.iterdir())) and time.monotonic() < end:
        time.sleep(0.05)
    workers[0].send_signal(signal.SIGKILL)
    first.kill()
    first.wait()
    scheduler_of(cluster, port)
    worker_of(cluster, port, tmp_path / "c")
    said, _ = running.communicate(timeout=240)
    assert running.returncode == 0, said.decode()
    assert bytes_of(tmp_path / "one") == bytes_of(tmp_path / "two")


@in_ci
def test_a_cluster_shares_one_batch_though_a_worker_is_killed_and_the_scheduler_ends(tmp_path, cluster):
    path, port = tmp_path / "forces.toml", 20000 + (os.getpid() + 13) % 20000
    path.write_text(sweep_in_slices.TEXT.format(more=""))
    evaluate(load_study(path, host()), tmp_path / "one", workers.Alone(), host())
    first = scheduler_of(cluster, port)
    dying = [worker_of(cluster, port, tmp_path / name) for name in "ab"]
    command = [sys.executable, sweep_in_slices.__file__, "sweep", str(path), "-o", str(tmp_path / "two")]
    running = subprocess.Popen(
        [*command, "--scheduler", f"tcp://127.0.0.1:{port}"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    slices, end = tmp_path / "two" / "slices", time.monotonic() + 120
    while len(list(slices.glob("*.parquet"))) < 3 and running.poll() is None and time.monotonic() < end:
        time.sleep(0.05)
    dying[0].send_signal(signal.SIGKILL)
    first.kill()
    first.wait()
    scheduler_of(cluster, port)
    worker_of(cluster, port, tmp_path / "c")
    said, _ = running.communicate(timeout=240)
    assert running.returncode == 0, said.decode()
    assert bytes_of(tmp_path / "one") == bytes_of(tmp_path / "two")


NO_ADDRESSES = (
    *("", " ", "tcp", "tcp://", "tcp://:", "tcp://:8786", "host", "tcp://host", "host:0", "tcp://host:65536"),
    *(
        "tcp://host:-1",
        "tcp://host:door",
        "tcp://a:b:c",
        "nonsense://host:8786",
        "http://host:80",
        "inproc://",
    ),
    *("tcp://h h:1", "tcp://[::1", "tcp://a..b:1", "tcp://user@host:1", "tcp://host:1/path", "tcp://host:１"),
)


@pytest.mark.parametrize("address", NO_ADDRESSES)
def test_what_is_no_address_is_one_line_at_once(tmp_path, address, monkeypatch):
    said = f"{address!r} is no address; give one such as tcp://host:8786"
    done = swept(tmp_path / "out", "--scheduler", address)
    assert (done.exit_code, str(done.exception)) == (1, f"--scheduler: {said}")
    if address:
        monkeypatch.setenv(workers.ADDRESS, address)
        done = swept(tmp_path / "out")
        assert (done.exit_code, str(done.exception)) == (1, f"{workers.ADDRESS}: {said}")


class Echo:
    """A source whose tables are their names."""

    def done(self, task):
        return task.name.encode()


def test_one_pool_does_every_task_once(monkeypatch):
    """Far more tasks than are given out ahead."""
    pools = []

    class Pool(WorkerPool):
        def __init__(self, *given, **named):
            pools.append(self)
            super().__init__(*given, **named)

    monkeypatch.setattr(workers, "WorkerPool", Pool)
    tasks = [Task(f"part-{number}", number, number) for number in range(100)]
    done = list(workers.Processes(2).done(Echo(), ListedTasks(tasks)))
    assert len(pools) == 1
    assert sorted(task.first for task, _ in done) == list(range(100))
    assert all(content == task.name.encode() for task, content in done)


def test_a_worker_that_comes_later_with_another_program_makes_no_table():
    pytest.importorskip("pyarrow", reason="pip install 'mechwright[scale]'")
    with pytest.raises(
        PluginError, match=r"^it has python [^\n]+; here it is python 0: install the same on both$"
    ):
        Source("{}", "strokes.toml", "slider-crank").alike("python 0", Task("part-000000", 0, 0))


@in_ci
def test_a_worker_with_another_program_is_refused_in_one_line(tmp_path, cluster):
    other = tmp_path / "other" / "mechwright"
    shutil.copytree(Path(mechwright.__file__).parent, other, ignore=shutil.ignore_patterns("__pycache__"))
    (other / "errors.py").write_text((other / "errors.py").read_text() + "# changed\n")
    port = 20000 + (os.getpid() + 7) % 20000
    scheduler_of(cluster, port)
    path = os.pathsep.join(filter(None, (str(other.parent), os.environ.get("PYTHONPATH"))))
    worker_of(cluster, port, tmp_path / "a", {"PYTHONPATH": path})
    done = swept(tmp_path / "out", "--scheduler", f"tcp://127.0.0.1:{port}")
    assert done.exit_code == 1
    assert re.fullmatch(
        r"--scheduler: worker tcp://[\d.:]+: it has [^\n]+: install the same on both", str(done.exception)
    )


@in_ci
def test_the_end_of_a_scheduler_is_one_line(tmp_path, cluster, monkeypatch, capfd):
    monkeypatch.setattr(studies_cluster, "PATIENCE", 5.0)
    port = 20000 + (os.getpid() + 29) % 20000
    first = scheduler_of(cluster, port)
    worker_of(cluster, port, tmp_path / "a")

    def end():
        tables, until = tmp_path / "out" / "tables", time.monotonic() + 60
        while not (tables.is_dir() and any(tables.iterdir())) and time.monotonic() < until:
            time.sleep(0.02)
        first.kill()

    Thread(target=end, daemon=True).start()
    text = "keep = 'all'\n# " + "more"
    path = tmp_path / "strokes.toml"
    swept_text = (
        strokes.TEXT.format(more=text)
        .replace("count = 24", "count = 2000000")
        .replace("batch = 8", "batch = 20000")
    )
    path.write_text(swept_text)
    done = strokes.swept_file(path, tmp_path / "out", "--scheduler", f"tcp://127.0.0.1:{port}")
    assert done.exit_code == 1
    assert "no scheduler answers within 5 s; it had ended: " in str(done.exception)
    assert "\n" not in str(done.exception)
    assert "Traceback" not in capfd.readouterr().err


@in_ci
def test_an_address_where_nobody_answers_is_one_line(tmp_path, monkeypatch):
    pytest.importorskip("distributed", reason="pip install 'mechwright[scale]'")
    monkeypatch.setattr(studies_cluster, "PATIENCE", 3.0)
    done = swept(tmp_path / "out", "--scheduler", "tcp://127.0.0.1:9")
    assert done.exit_code == 1
    assert "no scheduler answers within 3 s" in str(done.exception)
