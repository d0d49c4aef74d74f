"""Good programs in the hand of others: headers, cycles and heights as other posts and machinists write them."""

import re
from collections.abc import Callable

import pytest
from machine_programs import job_of, text_of
from test_named_states import reasons

FANUCS = ("fanuc", "haas")


def inches(text: str) -> str:
    """The program in inches of four decimals, each rounded to the nearest: heights may be lower by half of one."""

    def spelt(word: re.Match[str]) -> str:
        value = f"{float(word[2]) / 25.4:.4f}" if word[1] in "Z" else f"{float(word[2]) / 25.4:.5f}"
        return word[1] + value

    lines = [
        line if line.startswith("(") else re.sub(r"([XYZIJRFQ])(-?[\d.]+)", spelt, line)
        for line in text.split("\n")
    ]
    return "\n".join(lines).replace("G21", "G20").replace("P0.002", "P0.00008")


STYLES: dict[str, tuple[Callable[[str], str], tuple[str, ...]]] = {
    "modes beside G0 and G80": (
        lambda text: text.replace("G17 G21 G40 G49 G80 G90 G94", "G21\nG0 G17 G40 G49 G80 G90 G94"),
        FANUCS,
    ),
    "a cycle ended in a rapid": (lambda text: re.sub(r"G80\nM9", "G0 G80 Z50. M9", text), FANUCS),
    "the rapid before the cycle is in force behind it": (
        lambda text: re.sub(r"G80\nM9", "G80\nZ50.\nM9", text),
        FANUCS,
    ),
    "a cycle run once": (lambda text: re.sub(r"(G98 G8.*)", r"\1 K1", text), ("fanuc",)),
    "a cycle run once, by L": (lambda text: re.sub(r"(G98 G8.*)", r"\1 L1", text), ("linuxcnc", "haas")),
    "the centre across the plane": (lambda text: re.sub(r"(I\S+ J\S+)", r"\1 K0.", text), ("grbl",)),
    "no G40 where there is no G41": (lambda text: text.replace(" G40", ""), ("grbl",)),
    "heights rounded in inches": (inches, ("linuxcnc", "mach3", "grbl", "fanuc")),
}


@pytest.mark.parametrize(
    ("style", "control"), [(s, c) for s, (_, controls) in STYLES.items() for c in controls]
)
def test_it_is_proven(style: str, control: str) -> None:
    before = text_of(control)
    text = STYLES[style][0](before)
    assert text != before
    assert reasons(text, job_of(control), control) == {}


def changed(control: str, old: str, new: str) -> str:
    text = text_of(control)
    assert re.search(old, text, re.MULTILINE)
    return re.sub(old, new, text, count=1, flags=re.MULTILINE)


REFUSED = {
    (
        "haas",
        r"F600\.",
        "F600",
    ): "F600 has no decimal point, and Haas may read hundredths or less; write F600.",
    ("haas", r"^G1 X22\.$", "F600 G1 X22."): "F600 has no decimal point",
    ("fanuc", "S8000", "S8000."): "S8000. has a decimal point, and Fanuc takes S whole",
    ("fanuc", "^G43 H3 ", "G43 H3. "): "H3. has a decimal point, and Fanuc takes H whole",
    ("fanuc", "M8$", "M8."): "M8. has a decimal point, and Fanuc takes M whole",
    ("fanuc", r"^G1 X22\.$", "/2 G1 X22."): "/2 is a level of its own; write / for lines that may be skipped",
    ("fanuc", r"^G1 X22\.$", "M99"): "M99 in the main program begins it again, without end; write M30",
    (
        "fanuc",
        "^(G98 G83.*)$",
        r"\1 K3",
    ): "G83 is run as often as K3 says, which is not read; write each hole",
    (
        "fanuc",
        "^G1 Z0. F400.$",
        "M5\nG1 Z0. F400. M3",
    ): "M3 beside a feed: whether Fanuc starts the spindle before",
    ("fanuc", "^G80$", "G80 G81 X0. Z-1. R2."): "G80 and G81 exclude each other",
    ("fanuc", "^G98 G83", "G0 G98 G83"): "G0 and G83 exclude each other (motion)",
    ("linuxcnc", "^G80$", "G80\nZ50"): "an axis without a motion",
    ("linuxcnc", "^G80$", "G0 G80 Z50"): "G0 and G80 exclude each other (motion)",
    ("linuxcnc", r"^(G3 .*)$", r"\1 K0"): "K means nothing in this line",
    ("grbl", r"^(G3 .*)$", r"\1 K1"): "K means nothing in this line",
    ("linuxcnc", r"^(G2 .*)$", r"G18 \1"): "it lies in the plane of Z and X (G18)",
}


@pytest.mark.parametrize("case", REFUSED)
def test_it_is_refused_by_name(case: tuple[str, str, str]) -> None:
    control, old, new = case
    said = reasons(changed(control, old, new), job_of(control), control)["reading"][1]
    assert re.match(r"line \d+: ", said)
    assert REFUSED[case] in said


def test_feeds_of_fanuc_need_their_point_in_inches_alone() -> None:
    bare = re.sub(r"(F\d+)\.(?=\n)", r"\1", text_of("fanuc"))
    assert reasons(bare, job_of("fanuc"), "fanuc") == {}
    inch = re.sub(r"F\d+\.\d*", "F15", inches(text_of("fanuc")), count=1)
    assert "F15 has no decimal point" in reasons(inch, job_of("fanuc"), "fanuc")["reading"][1]
