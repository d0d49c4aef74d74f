"""Files as nobody should write them are read, or refused by name, in bounded time and memory."""

import sys

import pytest
from by_night import examples

if sys.platform == "win32":
    pytest.skip("limits of POSIX", allow_module_level=True)

from fuzzing import CORPUS, READ, REFUSED, cases, corpus, outcome, readers
from hypothesis import given, settings
from hypothesis import strategies as st

NAMES = sorted(readers())


def test_every_control_has_a_reader_and_every_corpus_too() -> None:
    assert {name for name in NAMES if name.startswith("program-")} == {
        f"program-{name}"
        for name in ("fanuc", "grbl", "haas", "heidenhain-tnc", "linuxcnc", "mach3", "siemens-840d")
    }
    assert {folder.name for folder in CORPUS.iterdir()} <= set(NAMES)
    assert all(reader.seeds for reader in readers().values())


@pytest.mark.parametrize("name", NAMES)
def test_seeds_are_read(name: str) -> None:
    suffix, data = readers()[name].seeds[0]
    assert outcome(name, suffix, data) == READ


@pytest.mark.parametrize("name", NAMES)
def test_finds_stay_mended(name: str) -> None:
    for path in corpus(name):
        assert outcome(name, path.suffix, path.read_bytes()) in {READ, REFUSED}, path


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=examples(6, 300))
@given(data=st.data())
def test_changed_files_are_read_or_refused_by_name(name: str, data: st.DataObject) -> None:
    suffix, case = data.draw(cases(name))
    assert outcome(name, suffix, case) in {READ, REFUSED}


def test_a_find_is_told_by_its_place(monkeypatch: pytest.MonkeyPatch) -> None:
    import fuzzing

    def broken(_: object) -> None:
        raise KeyError("x")

    def loops(_: object) -> None:
        while True:
            pass

    for take, words in ((broken, "KeyError at test_fuzzing.py:"), (loops, "slow: ")):
        monkeypatch.setattr(fuzzing, "SECONDS", 0.1)
        monkeypatch.setattr(fuzzing, "readers", lambda take=take: {"x": fuzzing.Reader(take, ())})
        assert outcome("x", ".x", b"").startswith(words)
