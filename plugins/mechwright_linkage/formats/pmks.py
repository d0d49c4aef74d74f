"""Linkages of PMKS and PMKS+: a line for each joint, and the query of a PMKS+ address.

PMKS: the names of the links that a joint joins, its type R, P or RP, x, y, and for P and RP an angle in
degrees; four letters t or f may follow, of which the last marks the driven joint. One link alone: a point
that is traced. PMKS+: numbers have 64 digits and three decimals, 0 in front is a minus.
"""

import re
from collections.abc import Sequence
from urllib.parse import unquote, urlsplit

from mechwright import DesignError
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright_linkage.formats.drawing import Drawing, name_of

DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
_SLIDES, _INPUT, _STANDS, _WELDED = 1, 2, 4, 8
_TYPES = ("R", "P", "RP")


def read_lines(text: str, source: str) -> Drawing:
    """The linkage of lines of joints, or of the part ``mech=`` of an address; raises DesignError."""
    body = unquote(text.split("mech=")[-1]) if "mech=" in text else text
    lines = [line.strip() for line in re.split(r"[\n|]", body) if line.strip()]
    found, driven = Drawing(), ""
    for number, line in enumerate(lines, start=1):
        cells = [cell for cell in re.split(r"[,\s]+", line) if cell]
        links, kind, numbers, input_ = _line(cells, f"{source}: joint {number}")
        point = name_of(f"J{number}", found.points, "J")
        found.points[point] = numbers[0], numbers[1]
        _join(found, point, links, kind, numbers, f"{source}: joint {number}")
        moving = [link for link in links if link != GROUND]
        if input_ or (number == 1 and moving):
            driven = moving[0] if moving else driven
    found.driver = driven
    return found


def _line(cells: Sequence[str], where: str) -> tuple[list[str], str, list[float], bool]:
    place = next((k for k, cell in enumerate(cells) if cell in (*_TYPES, "G")), 0)
    kind = cells[place] if cells else ""
    rest = cells[place + 1 :]
    if kind == "G":
        raise DesignError(f"{where}: gears in contact (G) are not read; put them into gears of the design")
    letters = rest[-1] if rest and re.fullmatch("[tf]{1,4}", rest[-1]) else ""
    try:
        numbers = [float(cell) for cell in (rest[:-1] if letters else rest)]
    except ValueError as error:
        raise DesignError(f"{where}: {error}; a line is: links, R, P or RP, x, y, and an angle") from error
    if place == 0 or len(numbers) < (2 if kind == "R" else 3):
        raise DesignError(
            f"{where}: it is {' '.join(cells)}; a line is: links, R, P or RP, x, y, and an angle"
        )
    links = [GROUND if link.lower() == GROUND else name_of(link, {}, "link") for link in cells[:place]]
    return links, kind, numbers, letters.endswith("t")


def _join(
    found: Drawing, point: str, links: Sequence[str], kind: str, numbers: Sequence[float], where: str
) -> None:
    if kind == "R":
        for link in links:
            found.add(point, link)
        return
    if len(links) != 2:
        raise DesignError(f"{where}: a slide joins two links, not {len(links)}")
    guide, block = sorted(links, key=lambda link: link != GROUND)
    if kind == "RP":
        if guide != GROUND:
            raise DesignError(
                f"{where}: of a pin in a slot (RP) of two moving links the line does not say which has the "
                "slot; draw the block as a link of its own, with R to one and P to the other"
            )
        pin = name_of(f"block_{point}", found.links, "block")
        found.add(point, block)
        block = pin
    found.add(point, block)
    found.slide(point, block, guide, numbers[2])


def read_address(text: str, source: str) -> Drawing:
    """The linkage of a PMKS+ address; raises DesignError where it is broken."""
    query = urlsplit(text.strip()).query or text.strip().partition("?")[2] or text.strip()
    pieces = unquote(query).split(".")
    if len(pieces) < 7:
        raise DesignError(f"{source}: it is no address of PMKS+, which has eight parts after the '?'")
    joints, links = _lists(pieces[4:])
    found, names = Drawing(), dict[str, str]()
    still, driven, sliding = list[str](), "", dict[str, float]()
    for one in joints:
        flags, (key, name, x, y, angle) = DIGITS.find(one[:1]), _cells(one[1:], 5, source)
        if flags < 0:
            raise DesignError(f"{source}: the joint {one!r} begins with no flag")
        if flags & _WELDED:
            raise DesignError(f"{source}: {name or key} is welded; draw its links as one link")
        names[key] = name_of(name or key, found.points, f"J{len(names) + 1}")
        found.points[names[key]] = _value(x, source), _value(y, source)
        if flags & _SLIDES:
            sliding[names[key]] = _value(angle, source) * 57.29577951308232
        elif flags & _STANDS:
            still.append(names[key])
        driven = names[key] if flags & _INPUT else driven
    for point in still:
        found.add(point, GROUND)
    for one in links:
        _address_link(found, one, names, source)
    for point, along in sliding.items():
        block = name_of(f"slider_{point}", found.links, "slider")
        found.add(point, block)
        found.slide(point, block, GROUND, along)
    found.driver = next((link for link, own in found.links.items() if link != GROUND and driven in own), "")
    return found


def _lists(pieces: Sequence[str]) -> tuple[list[str], list[str]]:
    """Joints and links: an empty piece ends each list."""
    found: list[list[str]] = [[], []]
    which = 0
    for piece in pieces:
        if piece:
            found[which].append(piece)
        elif (which := which + 1) == 2:
            break
    return found[0], found[1]


def _address_link(found: Drawing, text: str, names: dict[str, str], source: str) -> None:
    root, kind = text[:1], text[1:2]
    if root not in "YN" or kind not in "RP":
        raise DesignError(f"{source}: the link {text!r} begins with neither Y nor N, or neither R nor P")
    cells = text[2:].lstrip(",").split(",")
    if root == "N" or kind == "P":
        return  # part of a welded link, or a piston of no length: its joint slides
    own = cells[7:]
    own = own[: own.index("")] if "" in own else own
    if unknown := [key for key in own if key not in names]:
        raise DesignError(f"{source}: the link {cells[1] or cells[0]} names the joint {unknown[0]!r}")
    name = name_of(cells[1] or cells[0], found.links, f"link{len(found.links)}")
    for key in own:
        found.add(names[key], name)


def _cells(text: str, count: int, source: str) -> list[str]:
    cells = text.lstrip(",").split(",")
    if len(cells) < count:
        raise DesignError(f"{source}: the joint {text!r} has {len(cells)} entries, and needs {count}")
    return cells[:count]


def _value(text: str, source: str) -> float:
    """A number of 64 digits, in thousandths.

    >>> _value("0YP", ""), _value("0ce", ""), _value("0", "")
    (-2.201, -2.472, 0.0)
    """
    digits = text[1:] if text[:1] == "0" else text
    value = 0
    for digit in digits:
        if digit not in DIGITS:
            raise DesignError(f"{source}: {text!r} is no number of PMKS+")
        value = 64 * value + DIGITS.index(digit)
    return (-value if text[:1] == "0" else value) / 1000
