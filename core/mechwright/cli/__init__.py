"""The command line. Only here do families and CAM meet."""

import sys


def main() -> None:
    """Run the command line; errors become a line each and exit code 2, or 1 for a failed proof."""
    from mechwright.cli.app import app
    from mechwright.errors import ProofError

    try:
        app()
    except Exception as error:  # noqa: BLE001,RUF100 - a traceback is of no use to a machinist
        from mechwright.cli import failure

        for line in failure.lines(error):
            print(f"mechwright: {line}", file=sys.stderr)  # noqa: T201 - this is the program's own output
        sys.exit(1 if isinstance(error, ProofError) else 2)
    except KeyboardInterrupt:
        sys.exit(130)
