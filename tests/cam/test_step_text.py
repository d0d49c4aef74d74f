"""The order of styles in STEP files does not depend on the run."""

import itertools

from mechwright_cad.exporters.step_text import sort_styles

HEAD = "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION"


def file_of(blocks: list[tuple[int, int]], share: bool) -> bytes:
    """A file that styles solids in the given order; the first block of a shared colour holds it."""
    number, lines, held = 100, ["DATA;", "#7 = SOLID('a');", "#8 = SOLID('b');", "#9 = SOLID('c');"], {}
    for solid, colour in blocks:
        item, style = number + 1, held.get(colour) if share else None
        lines.append(f"#{number} = {HEAD}('',(\n    #{item}),#{solid + 20});")
        lines.append(f"#{item} = STYLED_ITEM('color',(#{style or item + 1}),#{solid});")
        number = item + 1
        if style is None:
            held[colour] = number
            lines.append(f"#{number} = COLOUR_RGB('',0.{colour},0.,0.);")
            number += 1
    return ("\n".join(lines) + "\nENDSEC;\nEND-ISO-10303-21;\n").encode()


def test_every_order_gives_the_same_text() -> None:
    blocks = [(7, 3), (8, 5), (9, 3)]
    for share in (False, True):
        texts = {sort_styles(file_of(list(order), share)) for order in itertools.permutations(blocks)}
        assert len(texts) == 1
        (text,) = texts
        assert text.count(b"STYLED_ITEM") == 3
        assert text.count(b"COLOUR_RGB") == (2 if share else 3)
        assert text.index(b",#7);") < text.index(b",#8);") < text.index(b",#9);")


def test_a_file_without_styles_stays_as_it_is() -> None:
    text = b"DATA;\n#1 = SOLID('a');\nENDSEC;\nEND-ISO-10303-21;\n"
    assert sort_styles(text) == text
