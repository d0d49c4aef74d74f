"""What importing the core brings in: numbers and validation, nothing heavy, and no test library."""

import pkgutil
import subprocess
import sys

import mechwright
from mechwright.testing.commands import HEAVY

ALLOWED_IN_TESTING = {"hypothesis", "pytest"}

ON_DEMAND = (
    "mechwright.testing",
    "mechwright.mechanics.algebra",
    "mechwright.mechanics.compiled",
    "mechwright.mechanics.continuation",
    "mechwright.mechanics.laws.table",
    "mechwright.mechanics.linkage.kinematics.channel_extremes",
    "mechwright.mechanics.planar.compiled_",
    "mechwright.geometry.prepared",
    "mechwright.machine.frame.",
    "mechwright.machine.framed",
    "mechwright.machine.speeds",
    "mechwright.mechanics.strength.motor_speed",
    "mechwright.drawings",
)
"""What only those import who use it, with what it needs."""


def core_modules():
    found = pkgutil.walk_packages(mechwright.__path__, "mechwright.")
    return [
        item.name
        for item in found
        if not item.name.startswith(ON_DEMAND) and not item.name.endswith("__main__")
    ]


def test_the_core_imports_nothing_heavy_and_no_test_library():
    modules = core_modules()
    assert {"mechwright.plugins.host", "mechwright.geometry.outline", "mechwright.contracts.part"} <= set(
        modules
    )
    code = f"import sys\nfor name in {modules!r}: __import__(name)\nprint(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert set(done.stdout.split()) & ({*HEAVY} | ALLOWED_IN_TESTING) == set()


def test_no_public_name_is_that_of_a_module():
    """A module that has been imported would stand in the way of the public name."""
    modules = {item.name for item in pkgutil.iter_modules(mechwright.__path__)}
    assert not modules & set(mechwright.__all__)
    for name in mechwright.__all__:
        assert getattr(mechwright, name) is not None
