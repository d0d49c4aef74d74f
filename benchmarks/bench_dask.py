"""Two workers of a Dask cluster against two processes: ``python benchmarks/bench_dask.py [TASKS]``.

Both do the same batches of the four-bars' study, in turns. What counts is from the first tables on, when all
workers are up: designs per second of the clock, and per second of the processors, of whoever takes part:
workers, scheduler and the process that asks. The clock tells only where nothing else runs.
"""

import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import psutil
from harness import require

from mechwright.plugins.host import host
from mechwright.sweep.study import study_of
from mechwright.sweep.task import Source, Task
from mechwright.sweep.workers import Cluster, Processes, Workers

EXAMPLE = Path(__file__).parents[1] / "examples" / "four-bar-study.toml"
BATCH, TASKS, ROUNDS, WORKERS, SKIPPED = 1 << 15, 12, 3, 2, 4
"""Tasks of half a second and more; the first tables find workers that are still waking up."""

LEAST = 0.9
"""Throughput of the cluster as part of that of the processes."""


@dataclass(frozen=True)
class Rate:
    """Designs a second: of the clock, and of the processors of all who take part."""

    clock: float
    processor: float


def processor(own: list[psutil.Process]) -> float:
    """Seconds that these processes and this one have taken."""
    return sum(one.cpu_times().user + one.cpu_times().system for one in [psutil.Process(), *own])


def measured(
    workers: Workers, source: Source, tasks: list[Task], who: Callable[[], list[psutil.Process]]
) -> Rate:
    """Of the tasks after the first few."""
    for seen, _ in enumerate(workers.done(source, tasks), 1):
        if seen == SKIPPED:
            own = who()
            start, spent = time.perf_counter(), processor(own)
        if seen == len(tasks):
            designs = (len(tasks) - SKIPPED) * BATCH
            return Rate(designs / (time.perf_counter() - start), designs / (processor(own) - spent))
    raise AssertionError("no task")


def spawned() -> list[psutil.Process]:
    """The processes of the pool, without those that a library starts for a moment."""
    return [one for one in psutil.Process().children() if "spawn_main" in " ".join(one.cmdline())]


def started(folder: str) -> tuple[list[subprocess.Popen[bytes]], str]:
    """A scheduler and its workers, each a process of one thread."""
    address = "tcp://127.0.0.1:18786"
    words = [["dask_scheduler", "--host", "127.0.0.1", "--port", "18786", "--no-dashboard", "--no-show"]]
    words += [
        ["dask_worker", address, "--host", "127.0.0.1", "--nthreads", "1", "--no-nanny", "--no-dashboard",
         "--local-directory", folder, "--death-timeout", "60"]
    ] * WORKERS  # fmt: skip
    found = []
    for command in words:
        run = [sys.executable, "-m", f"distributed.cli.{command[0]}", *command[1:]]
        with Path(folder, f"log-{len(found)}").open("wb") as out:
            found.append(subprocess.Popen(run, stdout=out, stderr=out, start_new_session=True))
    return found, address


def main(count: int) -> int:
    """Report both; the exit code is 1 where the cluster is too slow."""
    text = tomllib.loads(EXAMPLE.read_text())
    text["study"] |= {"count": count * BATCH, "batch": BATCH}
    source = Source.of(study_of(text, EXAMPLE, host()))
    tasks = [Task(f"part-{number:06d}", number * BATCH, number) for number in range(count)]
    with tempfile.TemporaryDirectory() as folder:
        cluster, address = started(folder)
        others = [psutil.Process(one.pid) for one in cluster]
        try:
            rates: dict[str, list[Rate]] = {"processes": [], "cluster": []}
            for _ in range(ROUNDS):
                rates["processes"].append(measured(Processes(WORKERS), source, tasks, spawned))
                rates["cluster"].append(measured(Cluster(address), source, tasks, lambda: others))
        finally:
            for one in cluster:
                one.terminate()
            for one in cluster:
                try:
                    one.wait(10)
                except subprocess.TimeoutExpired:
                    one.kill()
                    one.wait()
    for name, found in rates.items():
        clock, spent = (median(getattr(rate, key) for rate in found) for key in ("clock", "processor"))
        print(f"{name:10s} {clock:9,.0f} designs a second, {spent:9,.0f} a second of the processors")
    share = [
        median(getattr(b, key) / getattr(a, key) for a, b in zip(*rates.values(), strict=True))
        for key in ("clock", "processor")
    ]
    print(f"the cluster does {share[0]:.2f} of the throughput, by the processors {share[1]:.2f}")
    return 0 if require("processors' share of the least", LEAST / share[1], 1.0) else 1


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else TASKS))
