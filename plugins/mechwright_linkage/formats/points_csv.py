"""Points as a table: ``point,x,y,links`` and, for a slide, ``angle``.

A row is a point and the links that it is on, parted by blanks; ``ground`` stands still. With an angle, in
degrees from X, the last of the links slides on the first one through this point, and they have no pin there::

    point,x,y,links,angle
    A0,0,0,ground crank,
    A,30,0,crank rod,
    B,100,0,rod slider,
    B,100,0,ground slider,0
"""

import csv
import io

from mechwright import DesignError
from mechwright_linkage.formats.drawing import Drawing

COLUMNS = ("point", "x", "y", "links", "angle")


def read(text: str, source: str) -> Drawing:
    """The linkage of a table; raises DesignError with the line that is wrong."""
    rows = csv.DictReader(io.StringIO(text.lstrip("\ufeff")), skipinitialspace=True)
    header = [name.strip().lower() for name in rows.fieldnames or ()]
    if not set(COLUMNS[:4]) <= set(header):
        raise DesignError(f"{source}: the first line is {','.join(header)}; it has to be point,x,y,links")
    rows.fieldnames = header
    found = Drawing()
    for number, row in enumerate(rows, start=2):
        cells = {name: (row.get(name) or "").strip() for name in COLUMNS}
        where = f"{source}: line {number}"
        name, links = cells["point"], cells["links"].split()
        if not name or not links:
            raise DesignError(f"{where}: it needs a point and its links, as A,30,0,crank coupler")
        place = _number(cells["x"], where, "x"), _number(cells["y"], where, "y")
        if found.points.setdefault(name, place) != place:
            raise DesignError(f"{where}: {name} stands elsewhere in an earlier line; give one place")
        if not cells["angle"]:
            for link in links:
                found.add(name, link)
            continue
        if len(links) != 2:
            raise DesignError(f"{where}: a slide has two links, the guide and the block, not {len(links)}")
        found.add(name, links[1])
        found.slide(name, links[1], links[0], _number(cells["angle"], where, "angle"))
    if not found.points:
        raise DesignError(f"{source}: it has no points; a line is A,30,0,crank coupler")
    return found


def _number(text: str, where: str, column: str) -> float:
    try:
        value = float(text)
    except ValueError as error:
        raise DesignError(f"{where}: {column} is {text!r}, which is no number") from error
    if not abs(value) < 1e6:
        raise DesignError(f"{where}: {column} is {text}; the limit is 1e6")
    return value
