"""The paper: the form of the journal, figures that the documentation has, and references that are cited."""

import re
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[1]
PAPER = ROOT / "paper" / "paper.md"
TEXT = PAPER.read_text(encoding="utf-8")
_, HEAD, BODY = TEXT.split("---\n", 2)
BIB = (PAPER.parent / "paper.bib").read_text(encoding="utf-8")
MEASURED = "".join(
    (ROOT / "docs" / name).read_text(encoding="utf-8")
    for name in ("quality.md", "certificate.md", "machining/tests-of-the-proof.md", "simulation.md")
)
WORDS = 1000
"""Of a paper in the Journal of Open Source Software, which fill two pages."""


def test_the_head_is_that_of_the_journal_and_names_nobody_who_is_not_in_the_citation():
    head = yaml.safe_load(HEAD)
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert [one["name"] for one in head["authors"]] == [one["name"] for one in citation["authors"]]
    known = {one["index"] for one in head["affiliations"]}
    assert all(one["affiliation"] in known for one in head["authors"])
    assert head["title"].startswith(citation["title"])
    assert (PAPER.parent / head["bibliography"]).is_file()
    assert head["tags"]


def test_it_has_the_sections_of_the_journal_and_its_length():
    sections = re.findall(r"^# (.+)$", BODY, re.M)
    wanted = ["Summary", "Statement of need", "State of the field", "Design", "Quality", "References"]
    assert sections == wanted
    assert 250 <= len(BODY.split()) <= WORDS


def test_every_reference_is_cited_and_every_citation_is_there():
    cited = set(re.findall(r"@([a-z]+\d*)", BODY))
    entries = re.findall(r"^@\w+\{(\w+),", BIB, re.M)
    assert cited == set(entries)
    assert len(entries) == len(set(entries))
    assert BIB.count("{") == BIB.count("}")
    for entry in re.split(r"\n(?=@)", BIB):
        assert re.search(r"^  (doi|number|howpublished) = ", entry, re.M), entry[:40]


@pytest.mark.parametrize("number", sorted(set(re.findall(r"\d{1,3}(?:,\d{3})+|\b\d{3}\b|\d\.\de-\d+", BODY))))
def test_every_figure_stands_in_the_documentation(number):
    if number == "1,300":
        return  # a limit, which test_certificate.py holds
    assert number in MEASURED


def test_shares_are_those_of_the_documentation():
    assert "16 of the 276 programs of the examples are among\nthem (6 %)" in MEASURED
    assert "94 % checkable" in BODY
    assert "the ten agree within 0.5 %" in MEASURED
    assert "within 0.5 % of its peak" in BODY
