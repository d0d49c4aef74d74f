"""The commands ``families`` and ``new``."""

import json
from pathlib import Path

import typer

from mechwright.design.design import unknown
from mechwright.design.requirement import require_synthesis
from mechwright.design.text import requirement_template, template
from mechwright.errors import DesignError
from mechwright.output.folder import write_new
from mechwright.plugins.host import Host, host


def warn_broken(found: Host) -> None:
    """Name the plugins that could not be used, on standard error."""
    for broken in found.broken:
        typer.echo(f"mechwright: warning: {broken}", err=True)


def families(as_json: bool) -> None:
    """List what is installed."""
    found = host()
    if as_json:
        listing = {
            "families": [
                {
                    "name": name,
                    "title": item.item.title,
                    "summary": item.item.summary,
                    "distribution": item.distribution,
                    "parameters": item.item.Params.model_json_schema(),
                    "requirements": {
                        kind: model.model_json_schema() for kind, model in item.item.requirements.items()
                    },
                }
                for name, item in sorted(found.families.items())
            ],
            "controls": sorted(found.posts),
            "formats": sorted(found.exporters),
            "broken": [
                {"distribution": b.distribution, "plugin": b.plugin, "reason": b.reason} for b in found.broken
            ],
        }
        typer.echo(json.dumps(listing, indent=2))
        return
    warn_broken(found)
    for name, item in sorted(found.families.items()):
        typer.echo(f"{name}  ({item.distribution})\n    {item.item.title}: {item.item.summary}")
        if item.item.requirements:
            typer.echo(f"    synthesis: {', '.join(item.item.requirements)}")
    typer.echo(f"controls: {', '.join(sorted(found.posts)) or 'none'}")
    typer.echo(f"formats:  {', '.join(sorted(found.exporters)) or 'none'}")


def new(name: str, kind: str, output: Path | None, force: bool) -> None:
    """Write or print a design file, or a requirement file of the kind that is asked for."""
    found = host()
    warn_broken(found)
    family = found.family(name)
    if kind:
        require_synthesis(family, "--requirement")
        if kind not in family.requirements:
            raise DesignError(f"--requirement: {unknown(kind, tuple(family.requirements), 'kind')}")
        text, command = requirement_template(family, kind, name), "mechwright synthesize"
    else:
        text, command = template(family, name), "mechwright build"
    if output is None:
        typer.echo(text, nl=False)
    else:
        write_new(output, text, replace=force)
        typer.echo(f"{output}: written; go on with: {command} {output} -o out")
