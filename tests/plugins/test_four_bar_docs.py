"""The page of the four-bar says what the code does."""

from family_page import FamilyPage

from mechwright_four_bar.family import FourBars

PAGE = FamilyPage(
    FourBars,
    "mechwright_four_bar",
    ["four-bar", "path", "poles"],
    ["tracing/requirement.py"],
    ["four-bar.as-made"],
)


def test_every_finding_is_on_the_page_and_no_other() -> None:
    PAGE.assert_findings()


def test_every_parameter_is_on_the_page_with_its_default() -> None:
    PAGE.assert_parameters()


def test_the_requirements_are_described() -> None:
    PAGE.assert_requirements(["designs", "sense"])
