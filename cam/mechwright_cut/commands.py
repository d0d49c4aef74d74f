"""The command ``cut``."""

from mechwright.cli.command import AsJson, Command, DesignFiles, OutputFolder, Workers
from mechwright.contracts.plugin import Plugin
from mechwright.plugins.hookspecs import hookimpl


class CutCommand(Command):
    """``mechwright cut``."""

    name = "cut"
    order = 62

    def run(
        self,
        designs: DesignFiles,
        output: OutputFolder,
        as_json: AsJson = False,
        workers: Workers = None,
    ) -> None:
        """Write programs for laser, jet and wire.

        Or drawings for a service. The programs are proven; the page says how they are run. Of several
        designs each goes into a folder of its own in DIR.
        """
        from mechwright.cli.several import write
        from mechwright.contracts.finding import Stage
        from mechwright.pipeline import Wanted, Work

        nothing = 'has no plate that is cut: write process = "laser" at the head of the design file'
        wanted = Wanted("cut", work=Work(Stage.MACHINING))
        write(designs, output, wanted, workers, nothing, as_json)


@hookimpl
def mechwright_register() -> list[type[Plugin]]:
    """The command that cuts through."""
    return [CutCommand]
