"""The program: ``mechwright``, or ``python -m mechwright``."""


def program() -> None:
    """Run the command line as all that this process does.

    From the first line here to the last moment of the interpreter, the keyboard stops it in one line: so
    nothing is imported before, and what comes when all is said and done changes nothing any more.
    """
    try:
        from mechwright.cli import main

        main()
    except SystemExit as error:
        from mechwright.cli import leave
        from mechwright.plugins.host import foreign

        if foreign():
            leave(error.code)
        raise
    except KeyboardInterrupt:  # while what listens is loaded
        from mechwright.cli.stopping import ended

        ended()
    finally:
        from mechwright.cli.stopping import deaf

        deaf()


if __name__ == "__main__":
    program()
