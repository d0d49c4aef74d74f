"""Where the files of the repository stand on the site, and the links between them.

The pages of ``docs`` are written for the repository: they link to examples, templates and each other by
relative paths, which lead somewhere there. On the site they have to lead to the pages made of those files.
"""

import posixpath
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
GALLERY, NOTEBOOKS = "gallery", "notebooks"
"""Folders of the site whose pages are made of ``examples``."""

PAGES = ("CHANGELOG.md", "CODE_OF_CONDUCT.md", "CONTRIBUTING.md", "SECURITY.md")
TOP = {name: name for name in PAGES} | {"LICENSE": "LICENSE.txt"}
"""Files beside ``docs`` to their places on the site."""

FENCED = re.compile(r"^```.*?^```$", re.M | re.S)
LINK = re.compile(r"(\]\()([^)\s]+)([^)]*\))")


def place(path: str) -> str | None:
    """The place on the site of a file of the repository, both as paths with ``/``; None if it has none.

    >>> place("docs/python.md"), place("examples/elliptic-pair.toml"), place("pyproject.toml")
    ('python.md', 'gallery/elliptic-pair.md', None)
    >>> place("examples/chains/figure-eight-chain.toml")
    'gallery/figure-eight-chain.md'
    """
    if path.startswith("docs/"):
        return path.removeprefix("docs/")
    if path.startswith("examples/notebooks/"):
        return f"{NOTEBOOKS}/{posixpath.basename(path).replace('.ipynb', '.md')}"
    if re.fullmatch(r"examples/((motion|chains|linkages)/)?[^/]+\.toml", path):
        return f"{GALLERY}/{posixpath.basename(path).replace('.toml', '.md')}"
    if path == "examples/motion/README.md":
        return f"{GALLERY}/README.md"
    if path.startswith("examples/"):
        return path
    return TOP.get(path)


def anchor(title: str, separator: str = "-") -> str:
    """The anchor of a heading, as the repository's own reader makes it, so that one link leads to both.

    >>> anchor("The example: H = 120 mm")
    'the-example-h--120-mm'
    """
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", separator)


def relinked(markdown: str, origin: str) -> str:
    """A page of the repository with its links as the site needs them; code blocks stay as they are.

    Parameters
    ----------
    markdown
        The page.
    origin
        Its path in the repository. Links to what the site does not hold stay, and fail as broken ones.

    Examples
    --------
    >>> relinked("[a](../examples/elliptic-pair.toml#top)", "docs/python.md")
    '[a](gallery/elliptic-pair.md#top)'
    >>> relinked("[a](geneva.md) [b](#here) [c](https://example.org)", "docs/python.md")
    '[a](geneva.md) [b](#here) [c](https://example.org)'
    """
    here = place(origin)
    if here is None:
        raise ValueError(f"{origin} is no page of the site")

    def changed(match: re.Match[str]) -> str:
        target, hash_, within = match[2].partition("#")
        if not target or re.match(r"[a-z]+:", target):
            return match[0]
        wanted = posixpath.normpath(posixpath.join(posixpath.dirname(origin), target))
        found = place(wanted) if (ROOT / wanted).is_file() else None
        if found is None:
            return match[0]
        return (
            f"{match[1]}{posixpath.relpath(found, posixpath.dirname(here) or '.')}{hash_}{within}{match[3]}"
        )

    pieces, last = [], 0
    for code in FENCED.finditer(markdown):
        pieces += [LINK.sub(changed, markdown[last : code.start()]), code[0]]
        last = code.end()
    return "".join([*pieces, LINK.sub(changed, markdown[last:])])
