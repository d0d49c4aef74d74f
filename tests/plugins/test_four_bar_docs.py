"""The pages of the four-bar say what the code does."""

from family_page import FamilyPage

from mechwright_four_bar.family import FourBars

PAGE = FamilyPage(
    FourBars,
    "mechwright_four_bar",
    ["four-bar", "path", "poles"],
    ["tracing/requirement.py"],
    ["four-bar.as-made"],
    ["four-bar-paths", "four-bar-synthesis"],
)


def test_every_finding_is_on_the_page_and_no_other() -> None:
    PAGE.assert_findings()


def test_keys_of_the_page_are_those_of_the_family() -> None:
    PAGE.assert_parameters()


def test_the_requirements_are_described() -> None:
    PAGE.assert_requirements()
