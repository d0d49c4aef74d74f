"""The command line. Only here do families and CAM meet."""

import sys


def main() -> None:
    """Run the command line; expected errors become a line each and exit code 2, or 1 for a failed proof."""
    from mechwright.cli.app import app
    from mechwright.errors import MechwrightError, ProofError

    try:
        app()
    except MechwrightError as error:
        for line in str(error).splitlines():
            print(f"mechwright: {line}", file=sys.stderr)  # noqa: T201 - this is the program's own output
        sys.exit(1 if isinstance(error, ProofError) else 2)
    except KeyboardInterrupt:
        sys.exit(130)
