"""What everybody in a process shares is as it was after a call into a plugin, and the plugin is told."""

import decimal
import gc
import json
import locale
import os
import random
import signal
import sys
import threading
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import foreign_plugin
import numpy as np
import pytest
from test_guard import Bad, Size

from mechwright.contracts import ground
from mechwright.contracts.family import Family
from mechwright.plugins.host import Registered


def loud(*_: object) -> None:
    """Shows nothing."""


def seeded(*_: object) -> None:
    random.seed(1)


def drawn(*_: object) -> None:
    np.random.rand(3)  # noqa: NPY002 - which is what is told


def blocked(*_: object) -> None:
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])


def other_locale(*_: object) -> None:
    here = locale.setlocale(locale.LC_CTYPE)
    locale.setlocale(locale.LC_CTYPE, "C" if here != "C" else "C.UTF-8")


SPOILS: dict[str, tuple[Callable[..., Any], str]] = {
    "directory": (lambda _: os.chdir("/"), "the working directory"),
    "mask": (lambda _: os.umask(0), "the mask of new files (umask)"),
    "environment": (lambda _: os.environ.update(TZ="Asia/Tokyo", NEW="1"), "the environment"),
    "less of it": (lambda _: os.environ.pop("PATH"), "the environment"),
    "filters": (lambda _: warnings.simplefilter("ignore"), "the filters of warnings"),
    "shown": (lambda _: setattr(warnings, "showwarning", loud), "who shows warnings"),
    "signals": (lambda _: signal.signal(signal.SIGTERM, lambda *_: None), "handlers of signals"),
    "blocked": (blocked, "handlers of signals"),
    "recursion": (lambda _: sys.setrecursionlimit(5000), "the limit of recursion"),
    "digits": (lambda _: sys.set_int_max_str_digits(0), "the limit of digits"),
    "garbage": (lambda _: gc.disable(), "whether garbage is collected"),
    "locale": (other_locale, "the locale"),
    "random": (seeded, "the state of random numbers"),
    "of numpy": (drawn, "the state of numpy's random numbers"),
    "errors": (lambda _: np.seterr(all="raise"), "what numpy does about errors"),
    "decimals": (lambda _: setattr(decimal.getcontext(), "prec", 2), "the context of decimal numbers"),
    "other decimals": (lambda _: decimal.setcontext(decimal.BasicContext), "the context of decimal numbers"),
    "output": (lambda _: setattr(sys, "stdout", None), "standard output or standard error"),
}


def stands() -> list[Any]:
    """How everything stands."""
    return [piece.read() for piece in ground.PIECES]


@pytest.fixture
def family() -> Bad:
    ground._told.clear()
    return Registered(Bad(), "bad-mechanisms", "bad").item


def heard(family: Family[Size]) -> list[str]:
    """The warnings of a call."""
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("default")
        before = stands()
        family.parts(Size())
        assert stands() == before
    return [str(one.message) for one in found]


@pytest.mark.parametrize("case", SPOILS)
def test_what_is_spoilt_is_set_back_and_told(case: str, family: Bad) -> None:
    spoils, name = SPOILS[case]
    family.does = lambda _: (spoils(_), [])[1]
    assert heard(family) == [f"changes {name}, which is everybody's; it is set back"]
    assert heard(family) == []  # once for each method


@pytest.mark.parametrize("spoilt", [False, True])
def test_a_call_that_fails_is_set_back_too(spoilt: bool, family: Bad) -> None:
    def fails(_: object) -> None:
        if spoilt:
            np.seterr(all="raise")
        raise OSError

    family.does = fails
    before = stands()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with pytest.raises(Exception, match="OSError"):
            family.check(Size())
    assert stands() == before


def test_a_directory_that_is_gone_and_a_call_inside_of_another(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, family: Bad
) -> None:
    """The innermost plugin is the culprit."""
    other = Registered(Bad(), "other-mechanisms", "other").item

    def inner(_: object) -> list[Any]:
        gone = tmp_path / "gone"
        gone.mkdir()
        os.chdir(gone)
        gone.rmdir()
        return []

    other.does = inner
    family.does = lambda params: other.check(params)
    monkeypatch.chdir(tmp_path)
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        family.check(Size())
    assert len(found) == 1
    assert Path.cwd() == tmp_path


def test_a_library_that_is_loaded_meanwhile_may_ask_for_filters(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, family: Bad
) -> None:
    (tmp_path / "asks_for_filters.py").write_text(
        "import warnings\nwarnings.filterwarnings('ignore', 'asked')\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    family.does = lambda _: __import__("asks_for_filters") and []
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        family.check(Size())
        warnings.warn("asked", UserWarning, stacklevel=1)


def test_a_thread_that_goes_on_is_told(family: Bad) -> None:
    end = threading.Event()
    threads = [threading.Thread(target=end.wait, name="endless", daemon=daemon) for daemon in (False, True)]
    family.does = lambda _: [one.start() for one in threads][:0]
    try:
        assert heard(family) == ["leaves the thread 'endless' running; end it"]
        assert ground.threads_left()
    finally:
        end.set()
        for one in threads:
            one.join()
    assert not ground.threads_left()


HEAD = """
import os, subprocess, sys, threading, time
print("while it is loaded")
os.umask(0)
"""
CHECK = """
subprocess.run(["echo", "a process"])
os.write(1, b"a library\\n")
sys.stdout.close()
sys.__stdout__.close()
os.close(1)
os.chdir("/")
threading.Thread(target=time.sleep, args=(1e6,), name="endless").start()
"""


def test_the_command_line_says_all_of_it_and_ends(tmp_path: Path) -> None:
    design = foreign_plugin.installed(tmp_path, CHECK, HEAD)
    done = foreign_plugin.run(tmp_path, "check", design.name, "--json")
    assert json.loads(done.stdout)["ok"] is True
    assert done.returncode == 0
    said = done.stderr.splitlines()
    who = "mechwright: warning: plugin rude of rude-mechanisms: "
    mask = "RuntimeWarning: changes the mask of new files (umask), which is everybody's; it is set back"
    assert said[:4] == ["while it is loaded", f"{who}{mask} (rude.py, line 1)", "a process", "a library"]
    who += "family rude: check(): RuntimeWarning: "
    told = {line.removeprefix(who).rpartition(" (rude.py, line ")[0] for line in said[4:]}
    assert told == {
        "changes standard output or standard error, which is everybody's; it is set back",
        "changes the working directory, which is everybody's; it is set back",
        "leaves the thread 'endless' running; end it",
    }
