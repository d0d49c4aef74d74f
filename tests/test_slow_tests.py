"""The list of slow tests names tests that there are, and leaves every file something to do by day."""

import re
from pathlib import Path

import slow_tests

import mechwright.testing
import mechwright_cam.testing

TESTS = Path(__file__).parent
CONTRACTS = [Path(kit.__file__).parent for kit in (mechwright.testing, mechwright_cam.testing)]


def functions(*files):
    return {
        name for file in files for name in re.findall(r"def (test_\w+)", file.read_text(encoding="utf-8"))
    }


def test_every_slow_test_is_there():
    shared = functions(*(file for kit in CONTRACTS for file in kit.glob("*.py")))
    for name in slow_tests.listed():
        file, *_, test = name.partition("[")[0].split("::")
        assert test in functions(TESTS / file) | shared, f"take {name} out of {slow_tests.LIST.name}"


def test_the_fastest_case_and_one_test_of_a_file_stay():
    times = [("a.py::test[1]", 9.0), ("a.py::test[2]", 0.01), ("a.py::other", 2.0), ("b.py::test", 30.0)]
    assert slow_tests.slow(times) == ["a.py::other", "a.py::test[1]", "b.py::test"]
    assert slow_tests.slow([*times, ("b.py::one", 1.5)]) == ["a.py::other", "a.py::test[1]", "b.py::test"]


def test_a_report_is_read(tmp_path):
    report = tmp_path / "report.xml"
    report.write_text(
        """<testsuites><testsuite>
        <testcase classname="tests.cam.test_a.TestB" name="test_c[1.5]" time="0.25" />
        <testcase classname="tests.test_d" name="test_e" time="3.0"><skipped /></testcase>
        <testcase classname="core.mechwright.units" name="mechwright.units.convert" time="1.0" />
        </testsuite></testsuites>"""
    )
    assert slow_tests.read(report) == [("cam/test_a.py::TestB::test_c[1.5]", 0.25)]
