"""The commands ``families`` and ``new``."""

import json
from pathlib import Path

import typer

from mechwright.design import template
from mechwright.files import write_new
from mechwright.host import Host, host


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
    typer.echo(f"controls: {', '.join(sorted(found.posts)) or 'none'}")
    typer.echo(f"formats:  {', '.join(sorted(found.exporters)) or 'none'}")


def new(family: str, output: Path | None, force: bool) -> None:
    """Write or print a design file."""
    found = host()
    warn_broken(found)
    text = template(found.family(family), family)
    if output is None:
        typer.echo(text, nl=False)
    else:
        write_new(output, text, replace=force)
        typer.echo(f"{output}: written; build it with: mechwright build {output} -o out")
