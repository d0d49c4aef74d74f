"""Design files with tables ``[[stage]]``: chains of mechanisms.

A chain's file names no family of its own; each stage has one, with its parameters::

    [[stage]]
    family = "noncircular-gears"
    [stage.parameters]
    law = "ellipse"

    [[stage]]
    family = "geneva"
    start = -45
    [stage.parameters]
    law = "straight"
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mechwright.contracts.family import Family
from mechwright.contracts.model_schema import model_schema
from mechwright.designs.schema import placed_schema
from mechwright.designs.tables import read_table, unknown
from mechwright.errors import DesignError, PluginError
from mechwright.mechanics.chain import Chain, ChainParams, Families, StageTable
from mechwright.mechanics.chain.params import MOST_STAGES
from mechwright.plugins.host import Host

STAGE = "stage"
"""The key of the tables."""


def chain_of(content: Mapping[str, Any], path: Path, host: Host) -> Chain:
    """The chain that a file's stages name, by their families.

    Raises DesignError where the stages are no tables, or too few or many; PluginError where a family is not
    installed: both name the stage.
    """
    for key in ("family", "parameters"):
        if key in content:
            raise DesignError(
                f"{path}: {key}: a file with [[{STAGE}]] has it in every stage; leave it out of the head"
            )
    stages = content[STAGE]
    if not isinstance(stages, list) or not all(isinstance(one, Mapping) for one in stages):
        raise DesignError(f"{path}: {STAGE}: write each stage as a table [[{STAGE}]]")
    if not 2 <= len(stages) <= MOST_STAGES:
        raise DesignError(
            f"{path}: {STAGE}: {len(stages)} are no chain; one has 2 to {MOST_STAGES}"
            + ("; a single mechanism has family and [parameters]" if len(stages) == 1 else "")
        )
    return Chain(tuple(_family(number, one, path, host) for number, one in enumerate(stages, start=1)))


def _family(number: int, stage: Mapping[str, Any], path: Path, host: Host) -> Family[Any]:
    name = stage.get("family")
    where = f"{path}: {STAGE}.{number}.family"
    if not isinstance(name, str):
        known = ", ".join(sorted(host.of(Family)))
        fault = "is missing" if name is None else f"{name!r} is no text"
        raise DesignError(f"{where}: {fault}; name one of: {known}")
    try:
        return host.family(name)
    except PluginError as error:
        raise PluginError(f"{where}: {error}") from error


def chain_params(families: Families, content: Mapping[str, Any], path: Path) -> ChainParams:
    """The parameters of a chain, from the content of its file; raises DesignError with the stage and key."""
    stages = content.get(STAGE, [])
    if [one.get("family") for one in stages] != [family.name for family in families]:
        raise DesignError(f"{path}: {STAGE}: a change keeps the families of the stages; write another file")
    return ChainParams(stage=tuple(_stages(families, stages, path)))


def _stages(families: Families, stages: Sequence[Mapping[str, Any]], path: Path) -> list[StageTable]:
    found = []
    for number, (family, stage) in enumerate(zip(families, stages, strict=True), start=1):
        where = f"{STAGE}.{number}"
        for key in stage:
            if key not in StageTable.model_fields:
                said = unknown(key, tuple(StageTable.model_fields))
                if key in {"name", "id"}:
                    said += "; stages go by their number"
                raise DesignError(f"{path}: {where}: {said}")
        for key in ("start", "gap") if number == 1 else ():
            if key in stage:
                raise DesignError(f"{path}: {where}.{key}: nothing stands before stage 1; leave {key} out")
        own = stage.get("parameters", {})
        params = read_table(family.Params, own, str(path), f"{where}.parameters", path)
        found.append(read_table(StageTable, {**stage, "parameters": params}, str(path), where, path))
    return found


def stage_schema(families: Families) -> dict[str, Any]:
    """The schema of the list of a chain's stages."""
    defs: dict[str, Any] = {}
    gap = model_schema(StageTable)["properties"]
    rest = {key: value for key, value in gap.items() if key != "parameters"}
    items = [
        {"properties": {**rest, "parameters": placed_schema(family.Params, f"{number}", defs)}}
        for number, family in enumerate(families, start=1)
    ]
    return {"type": "array", "prefixItems": items, "$defs": defs}
