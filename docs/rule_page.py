"""Lists the rules that families declare: ``python docs/rule_page.py`` writes ``docs/reference/rules.md``."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mechwright import DesignRule, Family, Note, Rules
from mechwright.mechanics.strength.judging import StressRule
from mechwright.plugins.host import host

PAGE = Path(__file__).parent / "reference" / "rules.md"

HEAD = """# Rules

What families object to, in the order in which it is asked, as the families declare it. The same list gives
the findings of a check, the search for remedies, and what forbids the designs of a study. A value must be
what the third column says. An error stops its stage and the later ones. What a finding means, and what to do,
stands on the page of the family. Families that are not here have their findings in functions.

`python docs/rule_page.py` writes this page.
"""

TABLE = """
| finding | is | must be | unit | key |
| --- | --- | --- | --- | --- |
"""


def leaves(rules: Rules[Any]) -> Iterator[Any]:
    """Every rule of a list, in order."""
    for one in rules.every:
        if isinstance(one, Rules):
            yield from leaves(one)
        elif one.codes:
            yield one


def row(rule: Any) -> tuple[str, str, str, str, str]:
    """Code, severity and stage, comparison, unit, key of a rule."""
    code = ", ".join(f"`{one}`" for one in rule.codes)
    if isinstance(rule, Note):
        return code, "note", "", rule.unit, ""
    if isinstance(rule, StressRule):
        return code, f"error, warning or note: {rule.stage}", "at most what is allowed", "MPa", ""
    if not isinstance(rule, DesignRule):
        return code, "as found", "a procedure", "", ""
    plain = not callable(rule.limit) and rule.reported is None
    limit = f" {rule.limit:g}" if plain else " its limit"
    key = "" if callable(rule.parameter) else f"`{rule.parameter}`"
    unit = "" if callable(rule.unit) else rule.unit
    return code, f"{rule.severity}: {rule.stage}", f"{rule.must_be}{limit}", unit, key


def page() -> str:
    """The page."""
    text = [HEAD]
    for one in host().of(Family).values():
        family = one.item
        rules = list(leaves(family.rules()))
        if not rules:
            continue
        text.append(f"\n## {family.title}\n{TABLE}")
        rows = [row(rule) for rule in rules]
        text.extend(f"| {' | '.join(cells)} |\n" for k, cells in enumerate(rows) if cells not in rows[:k])
    return "".join(text)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
