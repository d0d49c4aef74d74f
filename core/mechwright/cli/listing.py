"""The commands ``families`` and ``new``."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import typer

from mechwright.cli.hosting import open_host
from mechwright.cli.progress import fraction
from mechwright.cli.telling import echo
from mechwright.contracts.family import Family
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.table import Table
from mechwright.designs.files import read_text
from mechwright.designs.requirement import require_synthesis
from mechwright.designs.schema import as_file, file_schema, schema_name
from mechwright.designs.tables import unknown
from mechwright.designs.text import requirement_template, template, toml
from mechwright.errors import DesignError
from mechwright.output.folder import write_new
from mechwright.plugins.host import Host, Registered
from mechwright.shell import file_word


def families(as_json: bool) -> None:
    """List what is installed: families with what they can be asked for, and all else by its kind."""
    found = open_host(warn=not as_json)
    others = {
        contract.plural: sorted(items)
        for contract, items in sorted(found.registered.items(), key=lambda item: item[0].plural)
        if contract is not Family
    }
    if as_json:
        listing = {
            "families": [_described(entry) for _, entry in sorted(found.of(Family).items())],
            **others,
            **{
                what: [{"distribution": b.distribution, "plugin": b.plugin, "reason": b.reason} for b in some]
                for what, some in (("broken", found.broken), ("outdated", found.outdated))
            },
        }
        typer.echo(json.dumps(listing, indent=2))
        return
    for name, entry in sorted(found.of(Family).items()):
        echo(f"{name}  ({entry.distribution})", f"    {entry.item.title}: {entry.item.summary}")
        if entry.item.requirements:
            echo(f"    synthesis: {', '.join(entry.item.requirements)}")
    width = max(map(len, others), default=0)
    for plural, names in others.items():
        echo(f"{plural + ':':{width + 1}} {', '.join(names)}")


def _described(entry: Registered[Family[Any]]) -> dict[str, Any]:
    """A family for programs: its names, and the schemas of its tables."""
    family = entry.item
    return {
        "name": family.name,
        "title": family.title,
        "summary": family.summary,
        "distribution": entry.distribution,
        "parameters": model_schema(family.Params),
        "requirements": {kind: model_schema(model) for kind, model in family.requirements.items()},
    }


@dataclass(frozen=True)
class Start:
    """What a new file begins with, as it was typed."""

    requirement: str = ""
    source: str = ""
    shop: Path | None = None
    fit: str = ""
    settings: tuple[str, ...] = ()


def new(name: str, start: Start, output: Path | None, *, force: bool, whole: bool) -> None:
    """Write or print a design file, or a requirement file of a kind; all keys if ``whole``."""
    found, told, kind = open_host(), list[str](), start.requirement
    family = found.family(name)
    if kind:
        for option, given in (
            ("--shop and --fit", start.shop is not None or start.fit),
            ("--set", start.settings),
            ("--from", start.source),
        ):
            if given:
                raise DesignError(
                    f"--requirement: its file begins with its defaults; leave {option} out, and edit the file"
                )
        require_synthesis(family, "--requirement")
        if kind not in family.requirements:
            raise DesignError(f"--requirement: {unknown(kind, tuple(family.requirements), 'kind')}")
        text = requirement_template(family, kind, name, found.all(Table), short=not whole)
        command = "mechwright synthesize"
    else:
        draft = family.draft(start.source, _text(start.source))
        if start.settings:
            draft = _with_settings(family, draft, start.settings)
        text, command = template(family, name, found.all(Table), short=not whole, draft=draft), BUILD
        if start.shop is not None or start.fit:
            path = output or Path(f"{name}.toml")
            text, told = _of_shop(text, family, path, start.shop, start.fit, found, whole=whole)
    if output is None:
        typer.echo(text, nl=False)
    else:
        write_new(output, text, replace=force)
        echo(*told)
        echo(f"{output}: written; go on with: {command} {file_word(output)} -o out")
        option = " --requirement" if kind else ""
        file = output.with_name(schema_name(name, requirement=bool(kind)))
        if not file.exists():
            echo(
                f"for an editor that completes and checks it: mechwright schema {name}{option} "
                f"-o {file_word(file)}"
            )


def _with_settings(family: Family[Any], draft: Parameters, settings: tuple[str, ...]) -> Parameters:
    """The parameters with what was typed as KEY=VALUE laid over them."""
    from mechwright.designs.bounded_toml import toml_of
    from mechwright.designs.tables import read_table

    given: dict[str, Any] = {}
    for text in settings:
        key, equals, value = (word.strip() for word in text.partition("="))
        if not (key and equals and value):
            raise DesignError(f"--set: {text!r} should be KEY=VALUE, such as thickness=6")
        try:
            given |= toml_of(f"{key} = {value}", "--set")
        except DesignError:
            given[key] = value
    values = {**draft.model_dump(exclude_unset=True), **given}
    made: Parameters = read_table(family.Params, values, "--set", "parameters")
    return made


def _of_shop(
    text: str, family: Family[Any], path: Path, shop: Path | None, fit: str, found: Host, *, whole: bool
) -> tuple[str, list[str]]:
    """The text of a new design that is made of what a shop has, and the lines that tell what was changed."""
    from mechwright.contracts.finding import Stage
    from mechwright.designs.bounded_toml import toml_of
    from mechwright.designs.change import changed, rewritten
    from mechwright.designs.design import design_of
    from mechwright.remedies import repaired
    from mechwright.remedies.starting import fit_of, started

    size = fit_of(fit) if fit else None
    head: dict[str, Any] = {}
    if shop is not None:
        if shop.resolve().parent != path.resolve().parent:
            raise DesignError(f"--shop: {shop} should lie beside {path}; copy it there")
        head = {"shop": shop.name, "cam": None}  # the shop has a control and a machine of its own
    content = changed(toml_of(text, path), head)
    change = started(content, path, found, size)
    with fraction() as progress:
        design = design_of(changed(content, change), path, "", found)
        repair = repaired(design, found, Stage.MACHINING, progress)
    change |= repair.change or {}
    params = design_of(changed(content, change), path, "", found).params
    rest = {key: value for key, value in change.items() if not key.startswith("parameters.")}
    text = template(family, family.name, found.all(Table), short=not whole, draft=params)
    lines = [
        f"leave out {key}" if value is None else f"set {key} = {toml(value)}" for key, value in change.items()
    ]
    if not repair.builds:
        lines += [f"not solved yet: {finding}" for finding in repair.left]
    return rewritten(text, {**head, **rest}), lines


BUILD = "mechwright build"
"""What one goes on with after ``new``."""


def _text(source: str) -> str:
    """What a file says that ``--from`` names; nothing of what is no file, such as an entry of a catalogue."""
    path = Path(source)
    looks_like_one = bool(path.suffix) or path.exists()
    return read_text(path)[0] if source and looks_like_one and "?" not in source else ""


def schema(name: str, requirement: bool, study: bool, output: Path | None, force: bool) -> None:
    """Write or print the JSON schema of design, requirement or study files, or of what a table names."""
    if requirement and study:
        raise DesignError("--study and --requirement: a file is one of them; give one")
    found = open_host()
    named = found.of(Table).get(name)
    schema = named.item.file_schema() if named is not None else {}
    if schema and (requirement or study):
        option = "--study" if study else "--requirement"
        raise DesignError(f"{option}: {name} is the file of a table; leave it out")
    if schema:
        schema = as_file(schema)
    elif study:
        from mechwright.studies.schema import study_schema

        schema = study_schema(found, name)
    else:
        schema = file_schema(found, name, requirement=requirement)
    text = json.dumps(schema, indent=2) + "\n"
    if output is None:
        typer.echo(text, nl=False)
    else:
        write_new(output, text, replace=force)
        echo(f"{output}: written; editors look for it where the first line of a file says: #:schema FILE")
