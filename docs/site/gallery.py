"""The gallery: a page for every example, on which it moves, made of the design file alone."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from html import escape
from pathlib import Path

import proven
from stills import still
from tree import ROOT

import mechwright as mw
from mechwright.mechanics.chain import Chain
from mechwright_cad.animation import PAGE_SAMPLES, motion_html
from mechwright_cad.animation.scene import scene

EXAMPLES = ROOT / "examples"
FAMILIES = (
    "elliptic-gears",
    "noncircular-gears",
    "spur-gears",
    "cam-follower",
    "geneva",
    "slider-crank",
    "four-bar",
    "five-bar",
    "linkage",
    "spherical",
    "plate",
    Chain.name,
)
"""In the order of the menu; chains come last, whose stages are of any family."""
WORTH_A_LINK = {
    "poles.html": "poles of acceleration, their loci and circles",
    "construction.html": "the construction with the auxiliary circle",
    "figure-eight.html": "phase and eccentricity as sliders",
}
"""Further pages of ``mechwright solve``, and what they show."""


def design_files() -> list[Path]:
    """Every example that is a file of its own, sorted by name."""
    found = [
        *EXAMPLES.glob("*.toml"),
        *(EXAMPLES / "motion").glob("*.toml"),
        *(EXAMPLES / "chains").glob("*.toml"),
        *(EXAMPLES / "processes").glob("*.toml"),
        *(EXAMPLES / "linkages").glob("*.toml"),
    ]
    return sorted(found, key=lambda path: path.name)


@dataclass(frozen=True)
class Example:
    """An example by its file."""

    path: Path

    @property
    def name(self) -> str:
        """That of the file."""
        return self.path.stem

    @cached_property
    def text(self) -> str:
        """The file."""
        return self.path.read_text(encoding="utf-8")

    @cached_property
    def family(self) -> str:
        """By its name."""
        if "\n[[stage]]\n" in self.text:
            return Chain.name
        (name,) = re.findall(r'^family = "(.+)"$', self.text, re.M)
        return str(name)

    @property
    def required(self) -> bool:
        """Whether it is a requirement or a study, of which designs are to be found."""
        return "\n[requirement]" in self.text or "\n[study]" in self.text

    @cached_property
    def said(self) -> str:
        """What its first lines say, as Markdown."""
        lines = []
        for line in self.text.splitlines():
            if not line.startswith("#"):
                break
            lines.append(line.lstrip("# "))
        return re.sub(r"(?<!`)(mechwright \w+( [\w./-]+)+)", r"`\1`", " ".join(lines))

    @property
    def command(self) -> str:
        """What makes something of it, from the folder of the project."""
        file = self.path.relative_to(ROOT).as_posix()
        word = "synthesize" if self.required else "solve" if self.path.parent != EXAMPLES else "build"
        return f"mechwright {word} {file} -o out"


def examples() -> list[Example]:
    """All of them, by family and name."""
    found = [Example(path) for path in design_files()]
    return sorted(found, key=lambda one: (FAMILIES.index(one.family), one.required, one.name))


def files() -> Iterator[tuple[str, str]]:
    """Every file of the gallery: its path below the gallery's folder, and its content."""
    every = examples()
    for example in every:
        yield f"{example.name}.toml", example.text
        if example.required:
            yield f"{example.name}.md", page_of(example)
            continue
        mechanism = mw.load(example.path).asked(samples=PAGE_SAMPLES, command="solve")
        pages = drawn(mechanism)
        yield f"{example.name}.md", page_of(example, [*framed(example.name, pages)], [*listed(mechanism)])
        yield from ((f"{example.name}/{name}", content) for name, content in pages.items())
    yield "README.md", index(every)


def drawn(mechanism: mw.Mechanism) -> dict[str, str]:
    """What is drawn of an example: file to content; joints and lines where its parts cannot be made."""
    design, motion = mechanism.design, mechanism.motion
    parts = () if mechanism.findings.errors else tuple(mechanism.parts)
    made = {
        "still.svg": still(scene(parts, motion, solids=True)),
        "motion.html": motion_html(design.name, design.family.title, parts, motion, solids=True),
    }
    pages = [
        one for one in mechanism.host.all(mw.Page) if "solve" in one.commands and one.name != "motion-page"
    ]
    for page in pages:
        for name, content in page.files(mechanism).items():
            if name in WORTH_A_LINK:
                made[name] = content if isinstance(content, str) else content.decode()
    return made


def about(family: str) -> str:
    """A link to the page on a family, or on chains."""
    return "[Chains](../chains.md)" if family == Chain.name else f"Family [{family}](../{family}.md)"


def title_of(family: str) -> str:
    """The heading over the examples of a family."""
    return Chain.title if family == Chain.name else mw.host().family(family).title


def page_of(example: Example, motion: Iterable[str] = (), findings: Iterable[str] = ()) -> str:
    """The page of one example: what it is, how it moves, its file, and what its family finds."""
    rows = [f"# {example.name}", "", example.said, "", *motion]
    rows += [
        f"{about(example.family)} · [the file]({example.name}.toml)",
        "",
        f"    {example.command}",
        "",
        "```toml",
        example.text.strip(),
        "```",
        "",
        *proven.lines(example.name),
        *findings,
    ]
    return "\n".join(rows) + "\n"


def framed(name: str, pages: Iterable[str]) -> Iterator[str]:
    """Lines with the page on which it moves, in a frame, and links to the others."""
    yield f'<iframe class="moving" src="{name}/motion.html" title="{name} moves"></iframe>'
    more = [f"[{said}]({name}/{file})" for file, said in WORTH_A_LINK.items() if file in pages]
    yield from ("", " · ".join([f"[the moving page alone]({name}/motion.html)", *more]), "")


def listed(mechanism: mw.Mechanism) -> Iterator[str]:
    """Lines with what its family finds, as a table."""
    yield from ("## What the family finds", "", "| | | |", "| --- | --- | --- |")
    for one in mechanism.findings:
        words = escape(one.message).replace("|", "\\|")
        yield f"| {one.severity} | `{one.code}` | {words} |"


def _briefly(said: str) -> str:
    """The first sentence, or what stands before its colon, as plain HTML."""
    return escape(said.split(". ")[0].split(": ")[0].rstrip(".").replace("`", ""))


def _counted(programs: int) -> str:
    return f"{programs} program{'s' if programs > 1 else ''}"


def twenty(every: dict[str, Example]) -> list[str]:
    """Lines with a card for each mechanism whose page shows parts and proof as well."""
    shown = proven.entries()
    if not shown:
        return []
    programs = sum(len(one["programs"]) for one in shown.values())
    rows = [f"## {len(shown)} mechanisms with their parts and {programs} proven programs", ""]
    rows += ['<div class="cards" markdown>', ""]
    for name, one in shown.items():
        worst = max(program["leftover_um"] for program in one["programs"])
        minutes = sum(program["minutes"] for program in one["programs"])
        rows += [
            f'<a class="card" href="{name}.html#its-parts-and-their-proof">'
            f'<img src="{name}/still.svg" alt="{name}" loading="lazy">'
            f"<b>{name}</b><span>{_briefly(every[name].said)}. {_counted(len(one['programs']))}, "
            f"{minutes:.0f} min; at most {worst:g} µm left</span></a>",
            "",
        ]
    return [*rows, "</div>", ""]


def index(every: list[Example]) -> str:
    """The page with a card for every example."""
    rows = [
        "# Gallery",
        "",
        f"All {len(every)} example files of the project. Each design has a page on which it moves; what "
        " `mechwright build` makes of one besides stands on the [tour](../README.md).",
        "",
    ]
    rows += twenty({one.name: one for one in every})
    for family in FAMILIES:
        title = title_of(family)
        rows += [f"## {title}", "", '<div class="cards" markdown>', ""]
        for one in (one for one in every if one.family == family and not one.required):
            rows += [
                f'<a class="card" href="{one.name}.html">'
                f'<img src="{one.name}/still.svg" alt="{one.name}" loading="lazy">'
                f"<b>{one.name}</b><span>{_briefly(one.said)}</span></a>",
                "",
            ]
        rows += ["</div>", ""]
        wanted = [one for one in every if one.family == family and one.required]
        if wanted:
            rows += ["Requirements, for `mechwright synthesize`:", ""]
            rows += [
                f"* [{one.name}]({one.name}.md): {one.said.split('`')[0].strip().rstrip(':.')}"
                for one in wanted
            ]
            rows.append("")
    return "\n".join(rows)
