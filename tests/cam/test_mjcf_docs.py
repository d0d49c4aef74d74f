"""The page on simulation shows the file that is written."""

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from mechwright import host
from mechwright.designs.design import load
from mechwright_cad.exporters.simulation.mjcf import assembly

ROOT = Path(__file__).parents[2]
LOOKS = {"asset", "geom", "visual"}


def words(element):
    """Tags and attributes in order, without looks; numbers as such."""
    found = []
    for one in element:
        if one.tag in LOOKS:
            continue
        found.append(one.tag)
        for key, value in one.attrib.items():
            found.append(key)
            found += [float(x) if re.fullmatch(r"-?[\d.]+(e-?\d+)?", x) else x for x in value.split()]
        found += words(one)
    return found


def test_the_example_is_what_is_written():
    page = (ROOT / "docs/simulation.md").read_text()
    (shown,) = re.findall(r"```xml\n(.*?)```", page, re.DOTALL)
    (path,) = set(re.findall(r"`(examples/[\w-]+\.toml)`", page))
    design = load(ROOT / path, host())
    text = assembly(design.name, design.parts(), design.family.solve(design.params, 13))
    one, two = (words(ElementTree.fromstring(x)) for x in (shown, text))  # noqa: S314 - our own
    assert len(one) == len(two)
    for here, there in zip(one, two, strict=True):
        assert here == (there if isinstance(there, str) else pytest.approx(there, rel=1e-5, abs=1e-15))
