"""The text of STEP files, put into an order of its own.

The kernel writes the styles of an assembly's products in the order of addresses in memory, which differs from
run to run.
"""

import re

_HEAD = b"MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION"
_ENTITY = re.compile(rb"#(\d+) = (.*?);\n(?=#|ENDSEC)", re.DOTALL)
_REFERENCE = re.compile(rb"#(\d+)")
_FOLD = re.compile(rb"\s*\n\s*")


_MEASURE = re.compile(rb"^(#\d+ = )MEASURE_WITH_UNIT\(([-+.\dE]+),", re.MULTILINE)


def typed_measures(text: bytes) -> bytes:
    r"""Say that limit deviations are lengths, which the kernel leaves out and ISO 10303-41 asks for.

    >>> typed_measures(b"#7 = MEASURE_WITH_UNIT(-0.009,#5);\n")
    b'#7 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(-0.009),#5);\n'
    """
    return _MEASURE.sub(rb"\1LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(\2),", text)


def sort_styles(text: bytes) -> bytes:
    """Order the styles at the end of a STEP file by what they colour, and number them anew.

    Only the entities from the first style on change; nothing before them refers to them.
    """
    first = re.search(rb"^#(\d+) = " + _HEAD, text, re.MULTILINE)
    if first is None:
        return text
    end = text.index(b"ENDSEC;", first.start())
    start = int(first[1])
    bodies = {
        int(number): _FOLD.sub(b"", body) for number, body in _ENTITY.findall(text[first.start() : end + 7])
    }

    def references(number: int) -> list[int]:
        return [int(found) for found in _REFERENCE.findall(bodies[number])]

    def coloured(head: int) -> list[int]:
        """What a style is on, and where: entities that stand before all styles."""
        inside = [number for number in references(head) if number >= start]
        return [n for item in inside for n in references(item) if n < start] + references(head)[-1:]

    order: list[int] = []

    def visit(number: int) -> None:
        if number >= start and number not in order:
            order.append(number)
            for reference in references(number):
                visit(reference)

    for head in sorted((n for n, body in bodies.items() if body.startswith(_HEAD)), key=coloured):
        visit(head)
    for number in bodies:
        visit(number)
    new = {number: start + place for place, number in enumerate(order)}

    def renumbered(match: re.Match[bytes]) -> bytes:
        number = int(match[1])
        return b"#%d" % new.get(number, number)

    lines = [b"#%d = %s;\n" % (new[number], _REFERENCE.sub(renumbered, bodies[number])) for number in order]
    return text[: first.start()] + b"".join(lines) + text[end:]
