"""What a manifest says of a run besides its outputs: what went in, and which versions were at work."""

import sys
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from mechwright import __version__
from mechwright.contracts.family import Family
from mechwright.plugins.host import Host


def facts(name: str, family: Family[Any], inputs: Mapping[str, str], found: Host) -> dict[str, Any]:
    """Facts of a run; ``inputs`` is file name to SHA-256."""
    origin = found.families[family.name].distribution
    packages = {"cadquery", "ezdxf", "numpy", "scipy", "shapely", origin} - {"mechwright"}
    return {
        "design": name,
        "family": family.name,
        "inputs_sha256": dict(inputs),
        "versions": {
            "mechwright": __version__,
            "python": ".".join(map(str, sys.version_info[:3])),
            **{package: _version(package) for package in sorted(packages)},
        },
    }


def _version(distribution: str) -> str:
    try:
        return version(distribution)
    except PackageNotFoundError:
        return "unknown"
