"""Which format a text is in, and the table of parameters that it makes."""

from collections.abc import Mapping
from typing import Any

from mechwright_linkage.formats import pmks, points_csv, pylinkage_json

KNOWN = "a table point,x,y,links; a mechanism of pylinkage (JSON); joints of PMKS, or an address of PMKS+"


def parameters_from(text: str, source: str) -> Mapping[str, Any]:
    """The table ``[parameters]`` of a drawn linkage; raises DesignError where a text is none."""
    start = text.lstrip("\ufeff \n\r\t")
    if start.startswith("{"):
        drawing = pylinkage_json.read(text, source)
    elif start.lower().startswith("point"):
        drawing = points_csv.read(text, source)
    elif "?" in start and "mech=" not in start:
        drawing = pmks.read_address(text, source)
    else:
        drawing = pmks.read_lines(text, source)
    return drawing.parameters(source)
