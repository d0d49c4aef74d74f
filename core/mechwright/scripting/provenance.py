"""What a manifest says of a run besides its outputs: what went in, and which versions were at work."""

import os
import sys
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from mechwright.contracts.family import Family
from mechwright.contracts.inputs import input_files
from mechwright.contracts.table import Table
from mechwright.designs.design import Design
from mechwright.designs.files import digest_of, read_bytes
from mechwright.kernels import kernels
from mechwright.mechanics.chain import Chain
from mechwright.plugins.host import Host


def facts(design: Design, found: Host) -> dict[str, Any]:
    """Facts of a run on a design: the hash of its file and of all that it names."""
    inputs = {design.path.name: design.digest or digest_of(design.text)}
    inputs |= {_slashed(file.name): file.digest for file in input_files(design.params).values()}
    for name, value in design.tables.items():
        named = found.get(Table, name).inputs(value, design.path)
        inputs |= {_slashed(name): digest_of(read_bytes(file)) for name, file in named.items()}
    return run_facts(design.name, design.family, inputs, found)


def _slashed(name: str) -> str:
    """The name of a file as manifests have it on every system."""
    return name.replace(os.sep, "/")


def run_facts(name: str, family: Family[Any], inputs: Mapping[str, str], found: Host) -> dict[str, Any]:
    """Facts of a run; ``inputs`` is file name to SHA-256."""
    known, stages = found.of(Family), family.families if isinstance(family, Chain) else (family,)
    origins = {known[one.name].distribution for one in stages}
    packages = {"cadquery", "ezdxf", "mechwright", "numpy", "scipy", "shapely"} | origins
    return {
        "design": name,
        "family": family.name,
        "inputs_sha256": dict(inputs),
        "kernels": kernels(),
        "versions": {
            "python": ".".join(map(str, sys.version_info[:3])),
            **{package: _version(package) for package in sorted(packages)},
        },
    }


def _version(distribution: str) -> str:
    try:
        return version(distribution)
    except PackageNotFoundError:
        return "unknown"
