"""The reference of the command line, from the commands that the project registers."""

from html import escape

import click
import typer.main

from mechwright.cli.app import make_app


def sections() -> str:
    """A section for every command, with its arguments and options."""
    group = typer.main.get_command(make_app())
    context = click.Context(group, info_name="mechwright")
    return "\n".join(_section(name, command, context) for name, command in group.commands.items())


def _section(name: str, command: click.Command, above: click.Context) -> str:
    context = click.Context(command, info_name=name, parent=above)
    usage = " ".join(command.collect_usage_pieces(context))
    rows = [
        f"## `mechwright {name}`",
        "",
        (command.help or "").strip(),
        "",
        f"    mechwright {name} {usage}",
        "",
    ]
    told = [_row(one, context) for one in command.params if not getattr(one, "hidden", False)]
    told = [one for one in told if one]
    if told:
        rows += ["| | |", "| --- | --- |", *told, ""]
    return "\n".join(rows)


def _row(parameter: click.Parameter, context: click.Context) -> str:
    """A line of the table; empty for what needs no word."""
    record = parameter.get_help_record(context)
    if record is None:
        return ""
    names, words = (escape(text, quote=False).replace("|", "\\|") for text in record)
    return f"| `{names}` | {words} |".replace("&lt;", "<").replace("&gt;", ">")
