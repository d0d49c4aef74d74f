"""Which tests wait for the night because they are slow: ``python tests/slow_tests.py REPORT.xml`` lists them anew.

REPORT.xml is what ``MECHWRIGHT_NIGHT=1 pytest -n 2 --junitxml=REPORT.xml`` writes on an idle machine. Of each test
function the fastest case stays by day where it is fast enough, and of each file the fastest test.
"""

import sys
from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path
from xml.etree import ElementTree

LIST = Path(__file__).with_name("slow_tests.txt")
"""Names of tests, one a line, as pytest gives them after ``tests/``."""

SLOW, SLOW_ALONE, SLOW_FILE = 0.1, 0.3, 2.0
"""Seconds from which a case waits for the night, the fastest case of a function, and the fastest test of a file."""

BY_DAY = (
    "test_cli.py::test_a_build_is_complete_and_the_same_every_time",
    "test_python.py::test_the_lines_of_the_readme_run",
)
"""Slow tests that are run by day all the same: whole builds."""


def listed() -> frozenset[str]:
    """The names of all tests that wait for the night."""
    return frozenset(LIST.read_text(encoding="utf-8").splitlines())


def slow(times: Iterable[tuple[str, float]]) -> list[str]:
    """The names among tests with their seconds that wait for the night.

    >>> slow([("a.py::test[1]", 0.3), ("a.py::test[2]", 0.1), ("b.py::test[1]", 0.4), ("b.py::test[2]", 9.0)])
    ['a.py::test[1]', 'b.py::test[2]']
    """
    cases, files = defaultdict(list), defaultdict(list)
    for name, seconds in times:
        cases[name.partition("[")[0]].append((seconds, name))
        files[name.partition("::")[0]].append((seconds, name))
    found = []
    for several in cases.values():
        first, *rest = sorted(several)
        found += [name for seconds, name in [first] if seconds >= SLOW_ALONE]
        found += [name for seconds, name in rest if seconds >= SLOW]
    fastest = {name for seconds, name in map(min, files.values()) if seconds < SLOW_FILE}
    return sorted(set(found) - set(BY_DAY) - fastest)


def read(report: Path) -> list[tuple[str, float]]:
    """Names and seconds of the tests of a report that were run."""
    found = []
    for case in ElementTree.parse(report).iter("testcase"):  # noqa: S314 - pytest wrote it
        place = case.attrib["classname"].split(".")
        if place[0] != "tests" or case.find("skipped") is not None:
            continue
        count = next((n for n, part in enumerate(place, 1) if part.startswith("test_")), 0)
        if not count:  # an example in a docstring
            continue
        file = "/".join(place[1:count]) + ".py"
        found.append(("::".join([file, *place[count:], case.attrib["name"]]), float(case.attrib["time"])))
    return found


if __name__ == "__main__":
    LIST.write_text("\n".join(slow(read(Path(sys.argv[1])))) + "\n", encoding="utf-8")
