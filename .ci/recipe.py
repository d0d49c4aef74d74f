"""The recipe of conda-forge: ``python .ci/recipe.py SDIST --home ADDRESS --maintainer NAME > recipe.yaml``.

Names and lowest versions are those of ``pyproject.toml``; version and hash are those of the sdist. Whoever
hands it in names the address of the project, and the maintainers of the recipe.
"""

import argparse
import hashlib
import json
import re
import sys
import tomllib
from pathlib import Path

PROJECT = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text("utf-8"))["project"]
CONDA = {}
"""Name on PyPI to the name on conda-forge, where they differ."""
SDIST = re.compile(r"mechwright-(\d+\.\d+\.\d+)\.tar\.gz")
LOWEST = PROJECT["requires-python"].removeprefix(">=")


def requirement(text):
    """A dependency as conda writes it: ``numpy >=2.0``."""
    name, lowest = text.split(">=")
    return f"{CONDA.get(name, name)} >={lowest}"


def recipe(sdist, home, maintainers):
    """The recipe of an sdist, as data."""
    match = SDIST.fullmatch(sdist.name)
    if match is None:
        raise SystemExit(f"{sdist}: is no sdist of a release, such as dist/mechwright-1.2.3.tar.gz")
    command, where = next(iter(PROJECT["scripts"].items()))
    return {
        "schema_version": 1,
        "context": {"version": match[1], "python_min": LOWEST},
        "package": {"name": PROJECT["name"], "version": "${{ version }}"},
        "source": {
            "url": "https://pypi.org/packages/source/m/mechwright/mechwright-${{ version }}.tar.gz",
            "sha256": hashlib.sha256(sdist.read_bytes()).hexdigest(),
        },
        "build": {
            "number": 0,
            "noarch": "python",
            "script": "${{ PYTHON }} -m pip install . -vv --no-deps --no-build-isolation",
            "python": {"entry_points": [f"{command} = {where}"]},
        },
        "requirements": {
            "host": ["python ${{ python_min }}.*", "pip", "hatchling >=1.27"],
            "run": ["python >=${{ python_min }}", *map(requirement, PROJECT["dependencies"])],
        },
        "tests": [
            {
                "python": {
                    "imports": [PROJECT["name"]],
                    "python_version": ["${{ python_min }}.*", "*"],
                    "pip_check": True,
                }
            },
            {"script": ["mechwright families", "mechwright demo demo --no-open"]},
        ],
        "about": {
            "homepage": home,
            "summary": PROJECT["description"],
            "license": PROJECT["license"],
            "license_file": PROJECT["license-files"],
        },
        "extra": {"recipe-maintainers": maintainers},
    }


def yaml(value, indent=0):
    """Data as YAML: its scalars are JSON, which YAML reads."""
    space = "  " * indent
    if isinstance(value, dict):
        lines = []
        for key, one in value.items():
            nested = isinstance(one, (dict, list))
            lines.append(
                f"{space}{key}:" + ("\n" + yaml(one, indent + 1) if nested else f" {json.dumps(one)}")
            )
        return "\n".join(lines)
    lines = []
    for one in value:
        text = yaml(one, indent + 1).lstrip() if isinstance(one, dict) else json.dumps(one)
        lines.append(f"{space}- {text}")
    return "\n".join(lines)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("sdist", type=Path)
    parser.add_argument("--home", required=True)
    parser.add_argument("--maintainer", action="append", required=True)
    asked = parser.parse_args(arguments)
    sys.stdout.write(yaml(recipe(asked.sdist, asked.home, asked.maintainer)) + "\n")


if __name__ == "__main__":
    main()
