"""Texts of blocks that are numbered without gaps, as Klartext wants them."""

import re


def numbered(*blocks: str) -> str:
    """A text of blocks with their numbers; what stands behind ~ has none."""
    lines, count, joined = [], 0, False
    for block in blocks:
        lines.append(block if joined else f"{count} {block}")
        count += not joined
        joined = block.endswith("~")
    return "\n".join(lines) + "\n"


def anew(text: str) -> str:
    """A text that has been changed, with its blocks numbered anew, if it has numbers."""
    if not text.startswith("0 BEGIN PGM"):
        return text
    return numbered(
        *(re.sub(r"^[0-9]+ ", "", line).strip(" ") for line in text.removesuffix("\n").split("\n"))
    )
