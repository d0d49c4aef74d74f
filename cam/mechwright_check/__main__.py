"""The command ``mechwright-check``: 0 confirmed, 1 refuted, 2 not checkable; one line says why."""

import argparse
import sys
from pathlib import Path

import shapely

from mechwright_check import RefutedError, UnknownError, drawing
from mechwright_check.certificate import case_of, compare, load, texts_of
from mechwright_check.checks import check_all


def main(arguments: list[str] | None = None) -> int:
    """Run the command; gives its exit code."""
    parser = argparse.ArgumentParser(prog="mechwright-check", description=__doc__)
    parser.add_argument("certificate", type=Path, help="NAME.certificate.json, or a program with --dxf")
    parser.add_argument(
        "files", type=Path, nargs="*", help="inputs that are not beside it, such as the design"
    )
    parser.add_argument("--dxf", type=Path, help="your own drawing of the part")
    drawing.add_options(parser)
    asked = parser.parse_args(arguments)
    notes: list[str] = []
    try:
        code, said = 0, _checked(asked, notes)
    except RefutedError as error:
        code, said = 1, f"REFUTED: {error}"
    except UnknownError as error:
        code, said = 2, f"not checkable: {error}"
    except (MemoryError, RecursionError, shapely.errors.ShapelyError, ArithmeticError) as error:
        code, said = 2, f"not checkable: {type(error).__name__}"
    except (LookupError, TypeError, ValueError, AttributeError) as error:
        code, said = 1, f"REFUTED: the certificate is damaged ({type(error).__name__}: {str(error)[:80]})"
    for note in notes if code == 0 else ():
        print(f"note: {note}")
    print(f"{asked.certificate}: {' '.join(said.split())}")
    return code


def _checked(asked: argparse.Namespace, notes: list[str]) -> str:
    if asked.certificate.suffix == ".json":
        found = load(asked.certificate)
        case = case_of(found, texts_of(found, asked.certificate.parent, asked.files, notes), notes)
        compare(case, found["moves"])
        if asked.dxf is not None:
            drawing.compare(case, found["part"]["origin"], asked.dxf)
    else:
        case = drawing.case_of(asked, notes)
    check_all(case)
    if asked.dxf is None:
        return "consistent: it cuts the part of its certificate (with --dxf DRAWING: that of your drawing)"
    return "confirmed: it cuts the part of the drawing"


if __name__ == "__main__":
    sys.exit(main())
