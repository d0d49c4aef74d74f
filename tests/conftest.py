"""What all tests share: the hypothesis profile, and the rule that nothing is skipped in CI for want of a client."""

import gc
import importlib.util
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from by_night import NIGHT, examples
from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers
from slow_tests import listed

collect_ignore = ["cam/planner_machine", "cam/freecad_bodies.py", "cam/freecad_panel.py"]
"""Files of a machine that LinuxCNC runs, and scripts that run inside FreeCAD."""

REQUIRE_CLIENTS = "MECHWRIGHT_REQUIRE_CLIENTS"
PROGRAMS = {
    "rs274": "linuxcnc-uspace",
    "linuxcnc": "linuxcnc-uspace",
    "ogr2ogr": "gdal-bin",
    "ogrinfo": "gdal-bin",
}
"""Program to the Debian package that has it."""
MODULES = ("gmsh", "mujoco", "mypy")
PYGCODE = "MECHWRIGHT_PYGCODE"
"""Environment variable with the folder that pygcode is installed in."""

# The machine's load must not decide whether a property holds. Every day's examples are the same ones: the many
# that only repeat what the first ones show belong to the night.
settings.register_profile(
    "mechwright",
    deadline=None,
    derandomize=True,
    max_examples=examples(30, 100),
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("mechwright")
# Nor what another run has kept: every test makes what it looks at.
os.environ.setdefault("MECHWRIGHT_STORE", "off")
# Nor must the worker that runs it: constants of whatever modules are loaded would go into the examples.
if hasattr(providers, "is_local_module_file"):
    providers.is_local_module_file = lambda path: False


YOUNG = 10_000
"""New objects after which the collector looks for cycles among them, some ten times as many as by default: pydantic
and hypothesis make them by the thousand."""


QUICK = (
    "core/test_*.py",
    "plugins/test_*_reference.py",
    "cam/test_interpreter.py",
    "cam/test_block_words.py",
    "test_house.py",
    "test_slow_tests.py",
)
"""Files of ``pytest -m quick``, which takes less than a minute: figures of every family, words of every control."""


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Read no other files for ``-m quick``."""
    if config.option.markexpr != "quick" or collection_path.suffix != ".py":
        return None
    return True if not _is_quick(collection_path) else None


def _is_quick(path: Path) -> bool:
    return any(path.match(f"tests/{pattern}") for pattern in QUICK)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark quick tests, and leave slow ones to the night unless they are asked for by their file."""
    for item in items:
        if _is_quick(item.path):
            item.add_marker("quick")
    if NIGHT or [Path(one).name for one in config.args] != config.getini("testpaths"):
        return
    slow = {f"tests/{name}" for name in listed()}
    config.hook.pytest_deselected(items=[item for item in items if item.nodeid in slow])
    items[:] = [item for item in items if item.nodeid not in slow]


def pytest_collection_finish() -> None:
    """What collection has loaded lives to the end: the collector need not go through it over and over."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(YOUNG)


def pytest_configure() -> None:
    """Stop where a client is missing that CI has to have; elsewhere the tests that need it skip."""
    if not os.environ.get(REQUIRE_CLIENTS):
        return
    missing = [
        f"{name} (Debian package {package})" for name, package in PROGRAMS.items() if not shutil.which(name)
    ]
    missing += [f"{name} (PyPI)" for name in MODULES if importlib.util.find_spec(name) is None]
    if not (Path(os.environ.get(PYGCODE, "")) / "pygcode").is_dir():
        missing.append(f"pygcode (PyPI), in the folder that {PYGCODE} names")
    if missing:
        pytest.exit(f"{REQUIRE_CLIENTS} is set, and these are missing: {', '.join(missing)}", returncode=1)


@pytest.fixture
def command_line() -> Callable[..., tuple[int, str, str]]:
    """Call the command line in this process: exit code, standard output, standard error."""
    from mechwright.testing import commands

    def call(*arguments: object) -> tuple[int, str, str]:
        done = commands.run(*arguments)
        return done.returncode, done.stdout, done.stderr

    return call
