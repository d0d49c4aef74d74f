"""The lowest versions that ``pyproject.toml`` declares, as constraints for pip: ``python .ci/lowest.py``."""

import tomllib
from pathlib import Path

PROJECT = Path(__file__).parents[1] / "pyproject.toml"

if __name__ == "__main__":
    for wanted in tomllib.loads(PROJECT.read_text("utf-8"))["project"]["dependencies"]:
        print(wanted.replace(">=", "=="))
