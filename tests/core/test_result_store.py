"""Results on disk: found again by content alone, never wrong, never in the way."""

import errno
import functools
import os
import random
import signal
import subprocess
import sys
import time
import warnings
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
import pytest
import shapely
from by_night import NIGHT
from hypothesis import given
from hypothesis import strategies as st

from mechwright.cli import failure
from mechwright.contracts.part import Part
from mechwright.contracts.shape import Shape, ring
from mechwright.contracts.tolerance_settings import ToleranceSettings
from mechwright.errors import UserNote
from mechwright.pipeline.result_store import STORE, result_store
from mechwright.plugins.host import Host, Registered
from mechwright.worker_pool.content import KNOWN, NoContentError, content_digest
from mechwright.worker_pool.sharing import shared
from mechwright.worker_pool.store import ResultStore

PLAIN = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text() | st.binary(),
    lambda inner: st.lists(inner) | st.tuples(inner) | st.dictionaries(st.text(), inner),
    max_leaves=8,
)


@dataclass(frozen=True)
class Bar:
    length: float
    holes: frozenset[str] = frozenset()

    @cached_property
    def half(self) -> float:
        return self.length / 2


@pytest.fixture(autouse=True)
def _known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mechwright.worker_pool.content.KNOWN", {*KNOWN, __name__.partition(".")[0]})


def doubled(bar: Bar) -> tuple[Bar, float]:
    return bar, 2 * bar.length


def counted(number: int) -> int:
    with Path(os.environ["COUNTED"]).open("a", encoding="utf-8") as file:
        file.write(".")
    return number * number


def store_in(folder: Path, stamp: bytes = b"one", most: int = 2**20) -> ResultStore:
    return ResultStore(folder / "results", stamp, most)


def spelled(thing: object) -> str:
    """A text that tells types apart: 1, 1.0 and True, 0.0 and -0.0."""
    if isinstance(thing, dict):
        return f"dict {sorted((spelled(k), spelled(v)) for k, v in thing.items())}"
    if isinstance(thing, list | tuple):
        return f"{type(thing).__name__} {[spelled(one) for one in thing]}"
    return f"{type(thing).__name__} {thing!r}"


@given(PLAIN, PLAIN)
def test_content_is_equal_exactly_where_things_are(one: object, two: object) -> None:
    assert (content_digest(one) == content_digest(two)) == (spelled(one) == spelled(two))


def test_fields_count_and_what_is_kept_beside_them_does_not() -> None:
    bar, other = Bar(3.0), Bar(3.0)
    assert bar.half == 1.5
    assert content_digest(bar) == content_digest(other) != content_digest(replace(bar, length=3.1))
    assert content_digest(np.eye(2)) != content_digest(np.eye(2, dtype=np.float32))
    assert (
        content_digest(shapely.Point(1, 2))
        == content_digest(shapely.Point(1, 2))
        != content_digest(shapely.Point(1, 3))
    )
    assert content_digest(functools.partial(doubled, bar)) != content_digest(
        functools.partial(doubled, Bar(4.0))
    )
    disc = Part("disc", None, 0.0, "steel", build=Shape((ring(2, 6, 1),)))
    assert (
        content_digest(disc)
        == content_digest(replace(disc))
        != content_digest(replace(disc, material="brass"))
    )


def test_a_value_that_a_file_states_is_not_one_that_it_leaves_out() -> None:
    """Results may differ by it: a process gives its tolerances in place of a grade that is left out."""
    left_out, stated = ToleranceSettings(), ToleranceSettings(general="proof")
    assert left_out.model_dump() == stated.model_dump()
    assert content_digest(left_out) == content_digest(ToleranceSettings())
    assert content_digest(left_out) != content_digest(stated)
    assert content_digest(stated) != content_digest(ToleranceSettings(general="fine"))


def test_what_has_no_content_is_not_kept() -> None:
    for thing in (lambda: 1, (one for one in ()), memoryview(b"")):
        with pytest.raises(NoContentError):
            content_digest(thing)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("mechwright.worker_pool.content.KNOWN", KNOWN)
        for thing in (Bar(1.0), doubled):
            with pytest.raises(NoContentError, match="has no name that tells what it does"):
                content_digest(thing)
    loop: list[object] = []
    loop.append(loop)
    with pytest.raises(NoContentError, match="holds itself"):
        content_digest(loop)


def test_content_is_the_same_in_every_process() -> None:
    code = (
        "from mechwright.worker_pool.content import content_digest as d;"
        "print(d({'b': {'x', 'y', 'zz'}, 'a': frozenset('hole')}).hex())"
    )
    said = {
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONHASHSEED": str(seed)},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in (1, 2, 3)
    }
    assert said == {content_digest({"b": {"x", "y", "zz"}, "a": frozenset("hole")}).hex() + "\n"}


def test_a_result_refers_to_the_objects_that_are_here(tmp_path: Path) -> None:
    bar, again = Bar(3.0, frozenset({"a", "b"})), Bar(3.0, frozenset({"b", "a"}))
    store = store_in(tmp_path)
    place = store.kept(doubled, bar, lambda item: [item])
    assert place.read() == []
    place.write(doubled(bar))
    (found,) = store.kept(doubled, again, lambda item: [item]).read()
    assert found == (again, 6.0)
    assert found[0] is again
    assert store.kept(doubled, Bar(3.0, frozenset({"a"})), lambda item: [item]).read() == []
    assert store.kept(counted, again, lambda item: [item]).read() == []
    assert store_in(tmp_path, b"two").kept(doubled, again, lambda item: [item]).read() == []


def test_work_is_done_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COUNTED", str(tmp_path / "count"))
    items = [1, 2, 3]
    for _ in range(2):
        assert shared(counted, items, [0.0] * 3, store=store_in(tmp_path)) == [1, 4, 9]
    assert shared(counted, [3, 4], [0.0] * 2, store=store_in(tmp_path)) == [9, 16]
    assert (tmp_path / "count").read_text() == "...."
    assert shared(counted, items, [0.0] * 3) == [1, 4, 9]
    assert (tmp_path / "count").read_text() == "......."


def test_a_damaged_result_counts_as_none(tmp_path: Path) -> None:
    store = store_in(tmp_path)
    rng = random.Random(5)  # noqa: S311
    for _ in range(60):
        place = store.kept(doubled, Bar(1.0))
        place.write(doubled(Bar(1.0)))
        (file,) = store.folder.glob("*/*")
        body = bytearray(file.read_bytes())
        if rng.random() < 0.3:
            del body[rng.randrange(len(body)) :]
        else:
            body[rng.randrange(len(body))] ^= 1 << rng.randrange(8)
        file.write_bytes(body)
        assert place.read() == []
        assert not file.exists()


def test_it_holds_no_more_than_its_bound(tmp_path: Path) -> None:
    store = store_in(tmp_path, most=20_000)
    store._written = 0
    left = store.folder / "left.part"
    left.write_bytes(b"x")
    os.utime(left, (0, 0))
    for number in range(12):
        store.kept(doubled, Bar(float(number))).write(bytes(3_000))
        if number == 10:
            assert store.kept(doubled, Bar(0.0)).read() == [bytes(3_000)]
        time.sleep(0.01)
    store._shrink()
    held = [file.stat().st_size for file in store.folder.glob("*/*")]
    assert 0.5 * 20_000 < sum(held) <= 20_000
    assert not left.exists()
    assert store.kept(doubled, Bar(0.0)).read() == [bytes(3_000)]  # it has been used last but one
    assert store.kept(doubled, Bar(1.0)).read() == []
    store.kept(doubled, Bar(50.0)).write(bytes(30_000))
    assert store.kept(doubled, Bar(50.0)).read() == []


def test_a_store_that_cannot_be_used_says_so_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    in_the_way = tmp_path / "results"
    in_the_way.write_text("a file")
    with pytest.warns(UserWarning, match="results are not kept in .*results: "):
        store = store_in(tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert shared(doubled, [Bar(1), Bar(2)], [0.0] * 2, store=store) == [(Bar(1), 2), (Bar(2), 4)]
    open_to_all = tmp_path / "open" / "results"
    open_to_all.mkdir(parents=True)
    open_to_all.chmod(0o777)
    with pytest.warns(UserWarning, match="others may write there; make it yours alone with chmod 700"):
        store_in(tmp_path / "open").kept(doubled, Bar(1.0)).write(1)

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    store = store_in(tmp_path / "full")
    monkeypatch.setattr(Path, "replace", full)
    with pytest.warns(UserWarning, match="No space left on device"):
        store.kept(doubled, Bar(1)).write(doubled(Bar(1)))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        store.kept(doubled, Bar(2)).write(doubled(Bar(2)))
    assert list(store.folder.glob("**/*.part")) == []


def test_commands_say_once_and_plainly_that_nothing_is_kept(capsys: pytest.CaptureFixture[str]) -> None:
    with failure.errors_in_lines():
        for category in (UserNote, type("UserNote", (UserWarning,), {})):  # the second is that of a worker
            failure.warned("results are not kept in x: it is full", category, "store.py", 3)
    assert capsys.readouterr().err == "mechwright: warning: results are not kept in x: it is full\n"


def test_kills_leave_it_sound(tmp_path: Path) -> None:
    """Processes that are killed while they write: whatever is there afterwards is whole."""
    code = (
        "import sys; from pathlib import Path; from mechwright.worker_pool.store import ResultStore\n"
        "store = ResultStore(Path(sys.argv[1]), b'one', 2**24); print('up', flush=True)\n"
        "for number in range(10**6): store.kept(len, number % 50).write(bytes([number % 50]) * 200_000)"
    )
    folder, rng = tmp_path / "results", random.Random(7)  # noqa: S311
    for _ in range(100 if NIGHT else 8):
        with subprocess.Popen([sys.executable, "-c", code, str(folder)], stdout=subprocess.PIPE) as process:
            assert process.stdout is not None
            process.stdout.readline()
            time.sleep(rng.uniform(0.0, 0.05))
            process.send_signal(signal.SIGKILL)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        store = ResultStore(folder, b"one", 2**24)
        found = {number: store.kept(len, number).read() for number in range(50)}
    assert all(result in ([], [bytes([number]) * 200_000]) for number, result in found.items())
    assert any(found.values())


def test_the_switch_and_the_code_of_others(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert result_store.__wrapped__() is None  # the tests run without
    monkeypatch.setenv(STORE, str(tmp_path / "mine"))
    store = result_store.__wrapped__()
    assert store is not None
    assert store.folder == tmp_path / "mine"
    others = Host({Part: {"rod": Registered("rod", "rods", "rod")}})  # type: ignore[dict-item]
    monkeypatch.setattr("mechwright.pipeline.result_store.host", lambda: others)
    assert result_store.__wrapped__() is None
