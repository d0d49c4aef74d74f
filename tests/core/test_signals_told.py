"""The keyboard stops the program, whatever a plugin makes of it; a plugin that says so itself does not."""

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import foreign_plugin
import pytest
from test_guard import Bad, Size, told

from mechwright.contracts.stops import UnaskedError, is_stop, listening
from mechwright.errors import PluginFaultError
from mechwright.plugins.host import Registered

OWN = "raises KeyboardInterrupt, which is the keyboard's; raise an error ("
needs_kill = pytest.mark.skipif(sys.platform == "win32", reason="no signals from here")


@pytest.fixture(autouse=True)
def _heard() -> Iterator[None]:
    """A process in the background of a shell ignores the keyboard, and so do its children."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def interrupts(*_: object) -> Any:
    raise KeyboardInterrupt


def pressed(*_: object) -> Any:
    signal.raise_signal(signal.SIGINT)
    return []


def swallowed(*_: object) -> Any:
    try:
        pressed()
    except BaseException:
        return []


def turned(*_: object) -> Any:
    try:
        pressed()
    except KeyboardInterrupt:
        raise ValueError from None


def test_one_of_its_own_is_told_as_the_plugins() -> None:
    assert told("check", interrupts).startswith(f"{OWN}test_signals_told.py, line ")


def test_one_of_its_own_in_another_thread_is_too() -> None:
    family, found = Registered(Bad(), "bad-mechanisms", "bad").item, []
    family.does = interrupts

    def work() -> None:
        try:
            family.check(Size())
        except PluginFaultError as error:
            found.append(str(error))

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert OWN in found[0]


@needs_kill
@pytest.mark.parametrize("does", [pressed, swallowed, turned])
def test_the_keyboard_is_not_lost(does: Callable[..., Any]) -> None:
    family = Registered(Bad(), "bad-mechanisms", "bad").item
    family.does = does
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        family.check(Size())
    assert signal.getsignal(signal.SIGINT) is before


@needs_kill
def test_a_call_within_a_call_and_after_a_stop() -> None:
    with pytest.raises(KeyboardInterrupt), listening(), listening():
        pressed()
    with pytest.raises(UnaskedError), listening():
        interrupts()
    assert is_stop(KeyboardInterrupt())
    assert not is_stop(ValueError())
    with listening():
        assert not is_stop(KeyboardInterrupt())


@needs_kill
def test_a_handler_that_goes_on_is_left_alone() -> None:
    """As that of a server, which ends when its answers are given."""
    heard: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: heard.append(number))
    try:
        with listening():
            pressed()
    finally:
        signal.signal(signal.SIGINT, before)
    assert heard == [signal.SIGINT]


@needs_kill
def test_the_command_line_tells_one_from_the_other(tmp_path: Path) -> None:
    """Whether it comes while the module is loaded, or from a method; and the code is that of the signal."""
    signals = "import os, signal\nos.kill(os.getpid(), signal.{})\n"
    cases = {
        "raise KeyboardInterrupt": (2, f"{foreign_plugin.WHO}: family rude: check(): {OWN}rude.py, line "),
        "try:\n    import os\n    os.kill(os.getpid(), 2)\nexcept BaseException:\n    pass": (
            130,
            "stopped; ",
        ),
        signals.format("SIGTERM"): (143, "stopped; nothing was written"),
    }
    for place, (body, (code, said)) in enumerate(cases.items()):
        (folder := tmp_path / str(place)).mkdir()
        design = foreign_plugin.installed(folder, body)
        found = foreign_plugin.run(folder, "check", design)
        assert (found.returncode, len(found.stderr.splitlines())) == (code, 1)
        assert said in found.stderr
    (loaded := tmp_path / "loaded").mkdir()
    design = foreign_plugin.installed(loaded, "pass", "raise KeyboardInterrupt\n")
    found = foreign_plugin.run(loaded, "check", design)
    assert found.returncode == 2
    assert f"{foreign_plugin.WHO} is not used: KeyboardInterrupt" in found.stderr
    assert os.fspath(design) in found.stderr
