"""What nobody writes on purpose, or somebody does: programs for bench_bounds.py."""

from collections.abc import Callable

from bound_places import MANY, inside, places


def _deep_brackets() -> list[str]:
    return [f"#31={'[' * 40}{k}{']' * 40}" for k in range(MANY // 10)]


def _parameters_of_parameters() -> list[str]:
    chain = [f"#{k}={k + 1}" for k in range(31, 60)]
    return [*chain, *(f"#99={'#' * (k % 20 + 1)}31" for k in range(MANY // 2))]


def _choices() -> list[str]:
    """A loop that takes one of two ways each time."""
    loop = ["o1 while [#1 lt 60000]", "o2 if [[#1 mod 2] eq 0]", "G1 X1", "o2 else", "G1 X-1", "o2 endif"]
    return ["G0 X0 Y0", "G1 Z1 F1000", "#1=0", *loop, "#1=[#1+1]", "o1 endwhile"]


def _to_and_fro() -> list[str]:
    """Distances and places by turns."""
    turns = (("G91 G1 X.01", "G90 G1 X0") for _ in range(MANY // 2))
    return ["G0 X0 Y0", "G1 Z1 F1000", *(line for pair in turns for line in pair)]


def _waves() -> list[str]:
    """Along one slot in waves of Z, each a little lower."""
    ups = (f"X{(k * 0.0371) % 20 - 10:.4f} Z{-0.5 - k / MANY - k % 2 * 0.2:.5f}" for k in range(MANY))
    return ["G0 X-10 Y0", "G1 Z-.5 F1000", *ups]


def _roughed_again() -> list[str]:
    """Ten levels of one pocket, with a rapid back to the start of each row."""
    out = []
    for level in range(10):
        out += ["G0 Z5", "G0 X-15 Y-15", f"G1 Z{-0.3 * (level + 1):.1f} F1000"]
        for row in range(3000):
            y = f"Y{-15 + row / 100:.3f}"
            out += [f"G1 X-15 {y}", "X15", "G0 X-15"]
    return out


CASES: dict[str, Callable[[], list[str]]] = {
    "100,000 lines with tabs": lambda: ["G1 Z1 F1000", *("\t" + p.replace(" ", "\t") for p in places(MANY))],
    "100,000 comments amid words": lambda: [
        *("G1 Z1 F1000", *(p.replace(" ", "(then)") for p in places(MANY)))
    ],
    "100,000 deleted blocks": lambda: ["G1 Z1 F1000", *(f"/G1 {p}" for p in places(MANY))],
    "100,000 polar places": lambda: [
        *("G0 X5 Y0", "G1 Z1 F1000", *(f"G1 @{5 + k % 9} ^{k % 360}" for k in range(MANY)))
    ],
    "100,000 distances and places by turns": _to_and_fro,
    "100,000 times coolant on and off": lambda: ["M8", "M9"] * (MANY // 2),
    "100,000 exact stops and none": lambda: [
        *("G1 Z1 F1000", *(f"{('G61', 'G64 P0.002 Q0')[k % 2]} G1 {p}" for k, p in enumerate(places(MANY))))
    ],
    "100,000 length offsets": lambda: ["G43 H23", "G49"] * (MANY // 2),
    "100,000 planes": lambda: ["G18", "G17"] * (MANY // 2),
    "10,000 values in 40 brackets": _deep_brackets,
    "50,000 parameters of parameters": _parameters_of_parameters,
    "60,000 choices in a loop": _choices,
    "33,000 holes in one place": lambda: ["G98 G81 X0 Y0 Z-1 R1 F100", *["X0 Y0"] * (MANY // 3), "G80"],
    "100,000 waves along a slot": _waves,
    "30,000 rows and rapids back, in ten levels": _roughed_again,
    "50,000 cuts far outside": lambda: [
        *("G1 Z-1 F1000", *(f"G1 X{200 + k % 7} Y{k % 50}" for k in range(MANY // 2)))
    ],
    "a repeat of 20,000 in a pocket": lambda: [
        *("G0 X-5 Y0", "G1 Z-.5 F900", "o1 repeat [20000]", "G3 X5 I5", "G3 X-5 I-5", "G1 X5", "G1 X-5"),
        "o1 endrepeat",
    ],
    "one line of 10 MB": lambda: ["G1 X1 Y1 F1000 " + "X" * 10_000_000],
    "a comment of 10 MB": lambda: ["(" + "a" * 10_000_000 + ")"],
    "a million empty lines": lambda: [""] * 1_000_000,
    "100,000 places in the stock, up each time": lambda: [
        *(
            "G0 Z5",
            *(w for _ in range(MANY // 4) for w in (f"G0 {inside(9)}", "Z.5", "G1 Z-.2 F300", "G0 Z5")),
        )
    ],
}
