"""Parts of a chain as cutters and programs leave them: each family judges those of its own stage."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from mechwright.contracts.as_made import AsMade
from mechwright.contracts.finding import Finding
from mechwright.mechanics.chain.checks import loaded
from mechwright.mechanics.chain.links import Link, links_of, staged
from mechwright.mechanics.chain.params import ChainParams, Families

if TYPE_CHECKING:
    import shapely

    from mechwright.contracts.made_part import MadePart

T = TypeVar("T")


def own(link: Link, parts: Mapping[str, T]) -> dict[str, T]:
    """The parts of a stage by their own names; those of the chain, such as shafts, are of none."""
    mark = link.named("")
    return {name.removeprefix(mark): one for name, one in parts.items() if name.startswith(mark)}


def cut_findings(
    params: ChainParams, families: Families, cut: "Mapping[str, shapely.Polygon]"
) -> Iterator[Finding]:
    """What each family says of its parts as cut."""
    for link, table in zip(links_of(params, families), loaded(params, families), strict=True):
        for one in link.family.check_cut(table, own(link, cut)):
            yield staged(link.number, link.family, one)


def as_made(params: ChainParams, families: Families, made: "Mapping[str, Sequence[MadePart]]") -> AsMade:
    """What each family says of its stage with parts as made, titles and names with the stage's number."""
    figures, curves, findings = [], [], []
    for link, table in zip(links_of(params, families), loaded(params, families), strict=True):
        parts = {
            name: [replace(one, name=name) for one in copies] for name, copies in own(link, made).items()
        }
        said = link.family.as_made(table, parts)
        mark = f"stage {link.number}, "
        figures += [
            replace(one, name=f"{link.number}.{one.name}", title=mark + one.title) for one in said.figures
        ]
        curves += [replace(one, title=mark + one.title) for one in said.curves]
        findings += [staged(link.number, link.family, one) for one in said.findings]
    return AsMade(tuple(figures), tuple(curves), tuple(findings))


def settings_of(params: ChainParams, families: Families) -> dict[str, ChainParams]:
    """The other settings of each stage, all else as it is."""
    found = {}
    for place, (family, table) in enumerate(zip(families, params.stage, strict=True)):
        for name, other in family.settings(table.parameters).items():
            stages = list(params.stage)
            stages[place] = table.model_copy(update={"parameters": other})
            found[f"stage {place + 1}: {name}"] = params.model_copy(update={"stage": tuple(stages)})
    return found
