"""Saves at the same time: of those that know one state of a file, one is written, and the others are told."""

import json
import shutil
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from by_night import by_night
from test_live import Page

from mechwright.designs.change import rewritten
from mechwright.designs.files import digest_of
from mechwright.errors import OutputError
from mechwright.output import staging
from mechwright.output.folder import ChangedError, rewrite, write_new
from mechwright.plugins.host import host
from mechwright_cad.live.building import Building
from mechwright_cad.live.session import Session

ROOT = Path(__file__).parents[2]
AT_ONCE = 8


def together(*calls: Callable[[], Any]) -> list[Any]:
    """What several calls give or raise that begin at the same time."""
    begin = threading.Barrier(len(calls))

    def one(call: Callable[[], Any]) -> Any:
        begin.wait()
        try:
            return call()
        except OutputError as error:
            return error

    with ThreadPoolExecutor(len(calls)) as pool:
        return list(pool.map(one, calls))


def test_one_of_several_saves_wins_over_two_servers(tmp_path: Path) -> None:
    path = tmp_path / "pair.toml"
    shutil.copy(ROOT / "examples" / "elliptic-pair.toml", path)
    pages = [Page(path), Page(path)]
    try:
        for turn in range(3):
            digest = pages[0].ask("described", change={})["digest"]

            def save(number: int, digest: str = digest, turn: int = turn) -> Any:
                change = {"parameters.eccentricity": round(0.2 + 0.01 * number + 0.001 * turn, 3)}
                return change, pages[number % 2].ask("save", change=change, digest=digest)

            found = together(*(partial(save, number) for number in range(AT_ONCE)))
            (written,) = [change for change, said in found if "said" in said]
            others = [said for _, said in found if "error" in said]
            assert len(others) == AT_ONCE - 1
            text = path.read_text(encoding="utf-8")
            assert f"eccentricity = {written['parameters.eccentricity']}" in text
            for said in others:
                assert "has changed on disk since; look at it first" in said["error"]
                assert said["changed"] == {"text": text, "digest": digest_of(text)}
        assert {one.name for one in tmp_path.iterdir()} == {"pair.toml"}
    finally:
        for page in pages:
            page.end()


CLIENTS, SAVES = 10, 20


@by_night
def test_two_hundred_saves_of_ten_clients_follow_one_another(tmp_path: Path) -> None:
    """Each client saves whenever it likes: what was called saved is one chain of states, up to the file."""
    path = tmp_path / "pair.toml"
    shutil.copy(ROOT / "examples" / "elliptic-pair.toml", path)
    first = path.read_text(encoding="utf-8")
    pages = [Page(path), Page(path)]
    try:

        def client(number: int) -> list[tuple[str, dict[str, float], dict[str, str]]]:
            page, found = pages[number % 2], []
            digest = page.ask("described", change={})["digest"]
            for turn in range(SAVES):
                change = {"parameters.eccentricity": round(0.2 + 0.01 * number + 0.0001 * turn, 4)}
                said = page.ask("save", change=change, digest=digest)
                found.append((digest, change, said))
                digest = json.loads(page.get("news?known="))["digest"]
            return found

        tries = [one for some in together(*(partial(client, n) for n in range(CLIENTS))) for one in some]
        assert len(tries) == CLIENTS * SAVES
        saved = [(digest, change) for digest, change, said in tries if "said" in said]
        following = dict(saved)
        assert len(following) == len(saved), "two saves of one state"
        text = first
        for _ in saved:
            text = rewritten(text, following.pop(digest_of(text)))
        assert text == path.read_text(encoding="utf-8")
        assert all("has changed on disk since" in said["error"] for *_, said in tries if "said" not in said)
    finally:
        for page in pages:
            page.end()


def test_one_of_several_rewrites_of_one_state_is_written(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    for _ in range(20):
        path.write_text("0")
        found = together(*(partial(rewrite, path, str(n), known=digest_of("0")) for n in range(1, 9)))
        assert sum(one is None for one in found) == 1
        assert sum(isinstance(one, ChangedError) for one in found) == 7


def test_one_of_several_new_files_of_one_name_is_written(tmp_path: Path) -> None:
    for number in range(20):
        path = tmp_path / f"{number}.toml"
        found = together(*(partial(write_new, path, str(n)) for n in range(8)))
        assert sum(one is None for one in found) == 1
        assert path.read_text() == str(found.index(None))


def test_what_an_editor_writes_at_the_last_moment_stands(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It knows no lock: the file is looked at again when the new one is whole."""
    path = tmp_path / "pair.toml"
    shutil.copy(ROOT / "examples" / "elliptic-pair.toml", path)
    session = Session(path, host())
    known, real = session.digest(), staging.to_disk

    def meanwhile(file: Any) -> None:
        real(file)
        path.write_text("# the editor's\n")

    monkeypatch.setattr(staging, "to_disk", meanwhile)
    with pytest.raises(ChangedError, match="has changed on disk since"):
        session.save({"parameters.eccentricity": 0.3}, known)
    assert path.read_text() == "# the editor's\n"
    assert {one.name for one in tmp_path.iterdir()} == {"pair.toml"}


def test_a_file_for_its_owner_alone_is_so_at_every_moment(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.toml"
    path.write_text("0")
    path.chmod(0o600)
    seen, real = [], staging.to_disk

    def look(file: Any) -> None:
        seen.append(Path(file.name).stat().st_mode & 0o777)
        real(file)

    monkeypatch.setattr(staging, "to_disk", look)
    rewrite(path, "1", known=digest_of("0"))
    assert seen == [0o600]
    assert path.stat().st_mode & 0o777 == 0o600


def test_two_pages_that_ask_for_a_build_at_once_get_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun = []

    def begin(building: Building) -> None:
        threading.Event().wait(0.05)
        begun.append(building)

    monkeypatch.setattr(Building, "_begin", begin)
    monkeypatch.setattr(Building, "runs", property(lambda _: bool(begun)))
    building = Building(tmp_path / "pair.toml")
    together(*[building.start] * 4)
    assert len(begun) == 1


def test_a_page_gets_the_text_of_a_file_that_is_another(tmp_path: Path) -> None:
    path = tmp_path / "pair.toml"
    shutil.copy(ROOT / "examples" / "elliptic-pair.toml", path)
    session = Session(path, host())
    asked = {"change": {"parameters.eccentricity": 0.3}, "digest": session.digest()}
    path.write_text(path.read_text() + "# more\n")
    said = json.loads(json.dumps(session.asks["save"](asked)))
    assert said["changed"] == {"text": path.read_text(), "digest": session.digest()}
    assert said["error"]
