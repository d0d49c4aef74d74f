"""The keyboard stops the program in one line from its first line on, and changes nothing after its last."""

import subprocess
import sys

import pytest

STOPPED = "mechwright: stopped; nothing was written\n"
LOADING = """
import _thread, sys
class Stops:
    @staticmethod
    def find_spec(name, *_):
        if name == {name!r}:
            sys.meta_path.remove(Stops)
            _thread.interrupt_main()
sys.meta_path.insert(0, Stops)
"""
SPEAKING = """
import _thread, sys
class Loud:
    def write(self, text):
        _thread.interrupt_main()
        sys.__stderr__.write(text)
    def flush(self):
        sys.__stderr__.flush()
sys.stderr = Loud()
"""
LEAVING = """
import _thread, atexit, sys
atexit.register(lambda: [_thread.interrupt_main(), sum(range(9))])
sys.argv.append("--version")
"""


def run(before: str) -> tuple[int, str]:
    """Exit code and standard error of the program in a process that does something before it."""
    heard = (
        "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # a shell may ignore it
    )
    code = heard + before + "\nfrom mechwright.__main__ import program\nprogram()"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    return done.returncode, done.stderr


@pytest.mark.parametrize(
    "name", ["mechwright.cli", "mechwright.cli.stopping", "mechwright.cli.failure", "mechwright.errors"]
)
def test_a_stop_while_the_command_line_is_loaded(name: str) -> None:
    assert run(LOADING.format(name=name)) == (130, STOPPED)


def test_a_second_stop_while_the_first_is_told() -> None:
    assert run(LOADING.format(name="mechwright.errors") + SPEAKING) == (130, STOPPED)


def test_a_stop_when_all_is_done() -> None:
    assert run(LEAVING) == (0, "")


def test_nothing_is_imported_before_the_program_listens() -> None:
    code = (
        f"import sys; sys.path += {sys.path!r}; before = set(sys.modules)\n"
        "import mechwright.__main__\nprint(*set(sys.modules) - before)"
    )
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c", code], capture_output=True, text=True, check=True
    )
    assert set(done.stdout.split()) == {"mechwright", "mechwright.__main__"}
