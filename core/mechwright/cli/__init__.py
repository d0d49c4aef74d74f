"""The command line. Only here do families and CAM meet."""

import sys


def main() -> None:
    """Run the command line; expected errors become one line and exit code 2."""
    from mechwright.cli.app import app
    from mechwright.errors import MechwrightError

    try:
        app()
    except MechwrightError as error:
        for line in str(error).splitlines():
            print(f"mechwright: {line}", file=sys.stderr)  # noqa: T201 - this is the program's own output
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
