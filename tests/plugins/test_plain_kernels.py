"""Kernels of many designs at once as plain Python: they say what each design says by itself.

The compiler takes some 20 s for them, and 27 designs take 5 s without it. Compiled they are tried by CI, in
``test_*_many.py``, and by night in the contract of each family.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
WORDS = """
import numba
from test_{}_contract import {} as Contract
assert numba.config.DISABLE_JIT
Contract().test_evaluate()
"""


@pytest.mark.parametrize(
    ("module", "contract"),
    [
        ("five_bar", "TestFiveBars"),
        ("four_bar", "TestFourBars"),
        ("slider", "TestSliderCrank"),
        ("spherical", "TestSpherical"),
    ],
)
def test_many_designs_at_once_are_what_each_is_by_itself(module: str, contract: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", WORDS.format(module, contract)],
        env={
            **os.environ,
            "NUMBA_DISABLE_JIT": "1",
            "PYTHONPATH": os.pathsep.join(filter(None, [str(HERE), str(HERE.parent), *sys.path])),
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
