"""The command line."""

import atexit
import os
import sys
from contextlib import suppress
from typing import NoReturn

LONGEST_EPOCH = 11
"""Digits of a date in seconds up to the year 5138; libraries end at 9999."""


def main() -> None:
    """Run the command line; errors become a line each and exit code 2, or 1 for a failed proof.

    What is stopped ends with 128 and the number of the signal: 130 by the keyboard, 143 where it is ended.
    The interpreter would wait for a thread that a plugin has left; then it is not asked to.
    """
    try:
        _stoppable()
    except SystemExit as error:
        from mechwright.contracts.ground import threads_left

        if not threads_left():
            raise
        leave(error.code)


def leave(code: object) -> NoReturn:
    """End the process with an exit code, and delete no object: one of a plugin might change the code."""
    atexit._run_exitfuncs()
    with suppress(OSError, ValueError):
        sys.stderr.flush()
    os._exit(code if isinstance(code, int) else int(code is not None))


def _stoppable() -> None:
    from mechwright.cli.stopping import StoppedError, ended, heard
    from mechwright.cli.streams import present

    with heard():
        try:
            present()
            _run()
        except (KeyboardInterrupt, StoppedError) as stop:
            ended(str(stop))


def _run() -> None:
    import warnings

    from mechwright.cli import failure
    from mechwright.cli.app import make_app
    from mechwright.cli.stopping import StoppedError, stopped
    from mechwright.cli.streams import say
    from mechwright.errors import ProofError

    warnings.showwarning = failure.warned
    try:
        try:
            with failure.errors_in_lines():
                _require_epoch()
                make_app()()
        finally:
            _flush()
    except SystemExit as error:
        if error.code and stopped():  # typer ends without a word what is stopped between its commands
            raise KeyboardInterrupt from error
        raise
    except (KeyboardInterrupt, StoppedError):
        raise
    except BaseException as error:  # a command of a plugin may raise any kind
        if stopped():
            raise KeyboardInterrupt from error
        # A traceback is of no use to a machinist.
        for line in failure.lines(error):
            say(f"mechwright: {line}")
        sys.exit(1 if isinstance(error, ProofError) else 2)


def _flush() -> None:
    """Write what is still held back, while a full disk can still be told; a reader that left is no fault."""
    from mechwright.cli.streams import silent

    try:
        sys.stdout.flush()
    except OSError as error:
        silent(sys.stdout.fileno())
        if not isinstance(error, BrokenPipeError):
            raise


def _require_epoch() -> None:
    """Raise DesignError where libraries cannot read the date that the environment gives them."""
    from mechwright.errors import DesignError

    said = os.environ.get("SOURCE_DATE_EPOCH")
    if said is not None and not (said.isascii() and said.isdigit() and len(said) <= LONGEST_EPOCH):
        raise DesignError(
            f"SOURCE_DATE_EPOCH: {said[:40]!r} in the environment is no whole number of seconds since 1970; "
            "unset it, or correct it"
        )
