"""Two workers of a Dask cluster against two processes: ``python benchmarks/bench_dask.py [TASKS]``.

Both do the same batches of the four-bars' study, in turns. What counts is from the first tables on, when all
workers are up, to the last: designs per second of the clock, and per second of the processors of all who take
part: workers, scheduler and the process that asks. Processes of a pool that is done with have ended before
the next begins, so that those at work alone are counted. The clock tells only where nothing else runs, and
beside other work a core does now more, now less in a second. What holds on any machine is the share of the
processors' time that goes into the tables themselves, by the clock of the thread that makes them: it is asked
to be nine tenths of the share with processes.
"""

import os
import struct
import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import psutil
from harness import require
from timed_source import Tasks, Timed

from mechwright.plugins.host import host
from mechwright.studies.cluster import Cluster
from mechwright.studies.study import study_of
from mechwright.studies.task import Source, Task
from mechwright.studies.task_queue import Workers
from mechwright.studies.workers import Processes

EXAMPLE = Path(__file__).parents[1] / "examples" / "four-bar-study.toml"
BATCH, FIRST, MORE, ROUNDS, WORKERS = 1 << 15, 10, 12, 3, 2
"""Tasks of half a second and more; the first tables find workers that are still waking up."""

LEAST = 0.9
"""Throughput of the cluster as part of that of the processes."""

ADDRESS, PORT = "127.0.0.1", "18786"

LIGHT = {
    "PYTHONPATH": os.pathsep.join(sys.path),
    "DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "False",
    "DASK_DISTRIBUTED__ADMIN__TICK__INTERVAL": "1s",
}
"""As ``docs/scale.md`` has it: nobody samples what workers are at, or looks all the time whether they lag."""


@dataclass(frozen=True)
class Rate:
    """Designs a second of the clock, and of the processors of all; which share of these makes tables."""

    clock: float
    processor: float
    share: float


def processor(others: Sequence[psutil.Process]) -> float:
    """Seconds that these processes and this one have taken."""
    return time.process_time() + sum(sum(one.cpu_times()[:2]) for one in others)


def pool() -> list[psutil.Process]:
    """The processes that this one has started for the tasks that are under way."""
    return psutil.Process().children()


def rate(workers: Workers, source: Source, more: int, others: Callable[[], Sequence[psutil.Process]]) -> Rate:
    """Of some tasks after the first few."""
    tasks = [Task(f"part-{number:06d}", number * BATCH, number) for number in range(FIRST + more)]
    tables = workers.done(source, Tasks(tasks))
    for _ in range(FIRST):
        next(tables)
    working = others()
    start, before = time.perf_counter(), processor(working)
    inside = sum(struct.unpack("d", next(tables)[1][-8:])[0] for _ in range(more))
    clock, spent = time.perf_counter() - start, processor(working) - before
    assert not list(tables)  # which ends what was started
    return Rate(more * BATCH / clock, more * BATCH / spent, inside / spent)


def started(folder: str, ended: ExitStack) -> list[psutil.Process]:
    """A scheduler and its workers, each a process of one thread."""
    words = [["dask_scheduler", "--host", ADDRESS, "--port", PORT, "--no-dashboard", "--no-show"]]
    words += [
        ["dask_worker", f"tcp://{ADDRESS}:{PORT}", "--host", ADDRESS, "--nthreads", "1", "--no-nanny",
         "--no-dashboard", "--local-directory", folder, "--death-timeout", "60"]
    ] * WORKERS  # fmt: skip
    found = []
    for command in words:
        run = [sys.executable, "-m", f"distributed.cli.{command[0]}", *command[1:]]
        with Path(folder, f"log-{len(found)}").open("wb") as out:
            process = subprocess.Popen(
                run, stdout=out, stderr=out, start_new_session=True, env=os.environ | LIGHT
            )
        ended.callback(process.wait)
        ended.callback(process.kill)
        found.append(psutil.Process(process.pid))
    return found


def main(more: int) -> int:
    """Report both; the exit code is 1 where the cluster is too slow."""
    text = tomllib.loads(EXAMPLE.read_text())
    text["study"] |= {"count": (FIRST + more) * BATCH, "batch": BATCH}
    source = Timed.of(study_of(text, EXAMPLE, host()))
    with ExitStack() as ended:
        folder = ended.enter_context(tempfile.TemporaryDirectory())
        cluster = started(folder, ended)

        contestants = {
            "processes": (Processes(WORKERS), pool),
            "cluster": (Cluster(f"tcp://{ADDRESS}:{PORT}"), lambda: cluster),
        }
        rates: dict[str, list[Rate]] = {name: [] for name in contestants}
        for _ in range(ROUNDS):
            for name, (workers, others) in contestants.items():
                rates[name].append(rate(workers, source, more, others))
    for name, found in rates.items():
        clock, spent, share = (
            median(getattr(one, key) for one in found) for key in ("clock", "processor", "share")
        )
        print(
            f"{name:10s} {clock:9,.0f} designs a second, {spent:9,.0f} a second of the processors, "
            f"{100 * share:.1f} % of which make tables"
        )
    clock, spent, share = (
        median(getattr(b, key) / getattr(a, key) for a, b in zip(*rates.values(), strict=True))
        for key in ("clock", "processor", "share")
    )
    ratios = f"{clock:.2f} of the throughput, by the processors {spent:.2f}, by shares {share:.3f}"
    print(f"the cluster does {ratios}")
    return 0 if require("the processes' share over the cluster's", 1 / share, 1 / LEAST) else 1


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else MORE))
