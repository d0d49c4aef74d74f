"""What only one system has stands in one module, and other systems get their answer from it."""

import ast
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from imported import sources

from mechwright import systems

ONE = "mechwright.systems"
MODULES = {"_winapi", "fcntl", "grp", "msvcrt", "posix", "pwd", "resource", "termios", "tty", "winreg"}
"""Modules of Python that some systems have not."""
NAMES = {
    "os": {
        *("fork", "forkpty", "kill", "killpg", "getpgid", "setsid", "setpgid", "nice", "wait", "waitpid"),
        *(
            "getuid",
            "geteuid",
            "getgid",
            "getegid",
            "getgroups",
            "chown",
            "mkfifo",
            "name",
            "startfile",
            "uname",
        ),
        *("sched_getaffinity", "sched_setaffinity", "register_at_fork", "getpriority", "get_blocking"),
        *("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY", "O_DIRECTORY", "O_TMPFILE"),
    },
    "signal": {
        *(
            "SIGALRM",
            "SIGHUP",
            "SIGKILL",
            "SIGPIPE",
            "SIGCHLD",
            "SIGUSR1",
            "SIGUSR2",
            "SIGBREAK",
            "CTRL_C_EVENT",
        ),
        *("alarm", "setitimer", "getitimer", "pthread_sigmask", "pthread_kill", "sigwait", "siginterrupt"),
    },
    "sys": {"platform", "getwindowsversion"},
    "platform": {"system", "win32_ver", "mac_ver"},
    "ctypes": {"WinDLL", "windll", "OleDLL", "oledll", "WinError"},
}
"""Names that some systems have not, or that tell the systems apart."""


def of_one_system(tree: ast.AST) -> list[str]:
    """What a module uses of that."""
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found += [one.name for one in node.names if one.name in MODULES]
        elif isinstance(node, ast.ImportFrom) and not node.level:
            found += [str(node.module)] if node.module in MODULES else []
            found += [
                f"{node.module}.{one.name}"
                for one in node.names
                if one.name in NAMES.get(str(node.module), ())
            ]
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            found += [f"{node.value.id}.{node.attr}"] if node.attr in NAMES.get(node.value.id, ()) else []
        elif (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Name)
            and node.func.id in {"getattr", "hasattr"}
        ):
            asked = node.args[0]
            found += (
                [f"{node.func.id}({asked.id}, ...)"]
                if isinstance(asked, ast.Name) and asked.id in NAMES
                else []
            )
    return found


def test_what_only_one_system_has_stands_in_one_module():
    found = {
        name: of_one_system(ast.parse(path.read_text(encoding="utf-8"))) for name, path in sources().items()
    }
    assert len(found) > 900
    assert found.pop(ONE)
    # Hooks of the interpreter, which every system has, are looked up by name.
    assert {name: said for name, said in found.items() if said} == {
        "mechwright.plugins.disturbance": ["getattr(sys, ...)"],
        "mechwright.cli.streams": ["getattr(sys, ...)"],
    }


@pytest.mark.parametrize(
    "text",
    [
        "import fcntl",
        "from msvcrt import locking",
        "import os\nos.fork()",
        "from os import killpg",
        "import sys\nx = sys.platform == 'win32'",
        "import signal\nsignal.alarm(3)",
        "import os\nx = hasattr(os, 'fork')",
        "import ctypes\nctypes.WinDLL('kernel32')",
    ],
)
def test_each_of_them_would_be_found(text):
    assert len(of_one_system(ast.parse(text))) == 1


WITHOUT = """
import os, signal
for module, names in {names}.items():
    for name in names:
        if hasattr(module, name):
            delattr(module, name)
from mechwright import systems
from mechwright.contracts.alarm import TimeUpError, in_time
assert systems.alarm_left() is None
assert [one.name for one in systems.STOPS] == ["SIGINT", "SIGTERM"]
assert systems.blocked_signals() == frozenset()
systems.block_signals({{2}})
assert systems.usable_cores() == os.cpu_count()
systems.on_fork(print)
assert not {{"the user", "the cores", "a timer", "the priority"}} & systems.process_state().keys()
try:
    with in_time(0.05):
        while True:
            pass
except TimeUpError as error:
    print(error)
"""


def test_a_system_without_alarms_forks_and_users_is_served():
    """As on Windows: the names are gone before the module is imported."""
    names = (
        "{os: ['sched_getaffinity', 'register_at_fork', 'getpriority', 'geteuid', 'getegid', 'getgroups'], "
        "signal: ['SIGALRM', 'SIGHUP', 'setitimer', 'getitimer', 'pthread_sigmask']}"
    )
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT.format(names=names)], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout) == (0, "takes more than 0.05 s\n"), done.stderr


def test_signals_and_cores_of_this_system():
    assert {signal.SIGINT, signal.SIGTERM} <= set(systems.STOPS)
    assert 1 <= systems.usable_cores() <= (os.cpu_count() or 1)


def test_a_process_that_leads_a_session_is_ended_with_what_it_has_started():
    start = (
        "import subprocess, sys; child = [sys.executable, '-c', 'import time; time.sleep(60)'];"
        "print(subprocess.Popen(child).pid, flush=True); input()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", start], stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True
    ) as process:
        assert process.stdout is not None
        child = int(process.stdout.readline())
        systems.kill_group(process)
    assert process.returncode not in {0, None}
    if sys.platform == "linux":
        status, end = Path(f"/proc/{child}/status"), time.monotonic() + 20
        while _runs(status) and time.monotonic() < end:  # whoever adopts it clears it away
            time.sleep(0.01)
        assert not _runs(status)


def _runs(status: Path) -> bool:
    try:
        return not re.search(r"^State:\t[ZX]", status.read_text(), re.MULTILINE)
    except OSError:
        return False
