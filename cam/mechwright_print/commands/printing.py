"""The command ``print``."""

import json
from pathlib import Path

import typer

from mechwright.cli.perform import perform
from mechwright.cli.telling import echo
from mechwright.contracts.finding import Stage
from mechwright.errors import DesignError
from mechwright.output.folder import Output, check_folder, write_folder, write_new
from mechwright.pipeline import Wanted
from mechwright.pipeline.work import Work
from mechwright_print.printer.printer_file import printer_text, read_printer
from mechwright_print.printer.settings import Printer
from mechwright_print.settings import PRINT


def print_design(path: Path, folder: Path, *, as_json: bool) -> None:
    """Write the printed parts of a design into a folder."""
    wanted = Wanted("print", work=Work(Stage.MACHINING, process=PRINT))
    perform(path, folder, wanted, "makes nothing that is printed; use mechwright model", as_json)


def write_coupon(folder: Path, base: Path | None) -> None:
    """Write the coupon of a printer, by default of one with the usual figures, into a folder."""
    from mechwright_print.coupon.coupon_files import coupon_files

    check_folder(folder)
    printer = Printer() if base is None else read_printer(base)
    output = Output()
    for name, content in coupon_files(printer).items():
        output.add(name, content)
    write_folder(folder, output, "print", {"coupon": printer.name})
    echo(
        f"{folder}: {len(output.files)} files written: {', '.join(sorted(output.files))}",
        f"print the plates, fill in coupon.csv, then: mechwright print --measured {folder}/coupon.csv "
        "-o printer.toml",
    )


def fit_printer(measured: Path, output: Path, base: Path | None, *, force: bool, as_json: bool) -> None:
    """Write the file of the printer that a coupon describes; raises DesignError for a doubtful one."""
    from mechwright_print.coupon.calibrated import calibrated, report
    from mechwright_print.coupon.filled import read_coupon

    sizes = read_coupon(measured)
    try:
        printer, found = calibrated(sizes, Printer() if base is None else read_printer(base))
    except DesignError as error:
        raise DesignError("\n".join(f"{measured}: {line}" for line in str(error).splitlines())) from error
    lines = list(report(printer, found, sizes))
    write_new(output, printer_text(printer, f"Measured on a coupon: {lines[0]}"), replace=force)
    if as_json:
        data = {"file": str(output), "values": found.values, "errors": found.errors, "spread": found.spread}
        typer.echo(json.dumps({**data, "residuals": found.residuals}, indent=2))
        return
    echo(f"{output}: written, {lines[0]}", *lines[1:])
