"""The command of the CAD room."""

from mechwright.cli.command import Also, AsJson, At, Command, DesignFile, OutputFolder, names
from mechwright.contracts.plugin import Plugin
from mechwright.plugins.hookspecs import hookimpl


class Model(Command):
    """``mechwright model``."""

    name = "model"
    order = 50

    def run(
        self,
        design: DesignFile,
        output: OutputFolder,
        also: Also = "",
        at: At = "",
        as_json: AsJson = False,
    ) -> None:
        """Write the solids: parts and assembly as STEP."""
        from mechwright.build import Wanted
        from mechwright.cli.perform import perform
        from mechwright.contracts.finding import Stage

        wanted = Wanted("model", at=at, formats=names(also))
        perform(design, output, wanted, Stage.PARTS, as_json=as_json)


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The command that makes solids."""
    return [Model]
