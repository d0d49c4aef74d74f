"""The page of the five-bar says what the code does."""

from family_page import FamilyPage

from mechwright_five_bar.family import FiveBars

PAGE = FamilyPage(FiveBars, "mechwright_five_bar", ["five-bar", "path"])


def test_every_finding_is_on_the_page_and_no_other() -> None:
    PAGE.assert_findings()


def test_keys_of_the_page_are_those_of_the_family() -> None:
    PAGE.assert_parameters()


def test_the_requirements_are_described() -> None:
    PAGE.assert_requirements()
