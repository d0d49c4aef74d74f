"""Warnings of workers of a sweep reach who asked for it, each once, with the plugin that they come from."""

import warnings

import pytest
from listed_tasks import ListedTasks
from sweep_warners import Warner

from mechwright.cli import failure
from mechwright.studies.task import Task
from mechwright.studies.workers import Processes

TASKS = [Task(f"part-{n}", 0, n) for n in range(8)]


def of_two_processes() -> list[str]:
    source = Warner("{}", "study.toml", "odd")
    return sorted(content.decode() for _, content in Processes(2).done(source, ListedTasks(TASKS)))


def test_each_is_said_once_as_it_would_be_said_here(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("default")
        monkeypatch.setattr(warnings, "showwarning", failure.warned)
        assert of_two_processes() == sorted(task.name for task in TASKS)
    said = capsys.readouterr().err.splitlines()
    same = [line for line in said if "divide" in line]
    assert len(same) == 1
    assert same[0].startswith(
        "mechwright: warning: family odd of odd-families: evaluate: RuntimeWarning: divide by zero "
        "(sweep_warners.py, line "
    )
    own = sorted(line.partition(" (")[0] for line in said if line not in same)
    assert own == [f"mechwright: warning: this program: UnusualWarning: of {task.name}" for task in TASKS]


def test_who_takes_warnings_for_errors_gets_one() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(Warning, match=r"divide by zero|of part-"):
            of_two_processes()
