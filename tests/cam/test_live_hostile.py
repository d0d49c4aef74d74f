"""What the server of ``live`` does with clients that mean it ill, asked from outside by plain sockets."""

import contextlib
import json
import shutil
import socket
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import uvicorn
from by_night import by_night
from test_live import Page

from mechwright_cad.live import patience
from mechwright_cad.live.guard import MOST
from mechwright_cad.live.patience import MANY, PATIENCE
from mechwright_cad.live.server import bound

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def page(tmp_path_factory) -> Iterator[Page]:
    path = tmp_path_factory.mktemp("live") / "pair.toml"
    shutil.copy(ROOT / "examples" / "elliptic-pair.toml", path)
    found = Page(path)
    yield found
    found.end()


@pytest.fixture(autouse=True)
def nothing_changes(page) -> Iterator[None]:
    """Whatever was tried, the file is as before, and the page is served to whoever may have it."""
    before = page.path.read_bytes()
    yield
    assert page.path.read_bytes() == before
    assert page.ask("described", change={})["digest"]


def line(page: Page) -> socket.socket:
    return socket.create_connection(("127.0.0.1", int(page.port)), timeout=PATIENCE + 30)


def head(page: Page, *more: str, method: str = "POST", what: str = "motion", host: str = "") -> bytes:
    here = f"127.0.0.1:{page.port}"
    rows = [
        f"{method} /{page.token}/{what} HTTP/1.1",
        f"Host: {host or here}",
        f"Origin: http://{here}",
        *more,
    ]
    return ("\r\n".join(rows) + "\r\n\r\n").encode()


def answer(open_line: socket.socket) -> bytes:
    """All that is said until the line is closed, or has been silent for too long."""
    found = b""
    with contextlib.suppress(ConnectionResetError):
        while part := open_line.recv(65536):
            found += part
    return found


def status(said: bytes) -> int:
    return int(said.split(b" ", 2)[1])


def chunk(data: bytes) -> bytes:
    return f"{len(data):x}\r\n".encode() + data + b"\r\n"


def test_a_body_without_a_stated_length_has_the_same_bound(page):
    with line(page) as one:
        one.sendall(head(page, "Transfer-Encoding: chunked"))
        with contextlib.suppress(BrokenPipeError, ConnectionResetError):
            for _ in range(MOST // 50_000 + 2):
                one.sendall(chunk(b"x" * 50_000))
        assert status(answer(one)) == 413


def test_a_question_in_pieces_is_answered(page):
    with line(page) as one:
        one.sendall(head(page, "Transfer-Encoding: chunked", "Connection: close", what="described"))
        for piece in (b'{"cha', b'nge": {}', b"}"):
            one.sendall(chunk(piece))
        one.sendall(b"0\r\n\r\n")
        said = answer(one)
    assert status(said) == 200
    assert json.loads(said.partition(b"\r\n\r\n")[2])["digest"]


@by_night  # it waits as long as the server does
def test_slow_clients_are_not_waited_for(page):
    """One that sends no body, one with half a head, one that says nothing at all: together, as each takes its time."""
    began = time.monotonic()
    with line(page) as bodiless, line(page) as half, line(page) as silent, line(page) as again:
        bodiless.sendall(head(page, "Content-Length: 100") + b"{")
        half.sendall(head(page)[:-10])
        again.sendall(head(page, method="GET", what="live.css") + head(page)[:30])
        assert status(answer(bodiless)) == 408
        assert answer(half) == b""
        assert answer(silent) == b""
        assert status(answer(again)) == 200
    assert PATIENCE - 1 < time.monotonic() - began < PATIENCE + 20


@by_night  # it waits as long as the server does
def test_a_row_of_questions_is_not_waited_for(page):
    """Of 20 questions for news, each of which would be kept for 20 s, one is answered."""
    digest = page.ask("described", change={})["digest"]
    began = time.monotonic()
    with line(page) as news, line(page) as pages:
        news.sendall(head(page, method="GET", what=f"news?known={digest}") * 20)
        pages.sendall(head(page, method="GET", what="live.js") * 200)
        assert answer(pages).count(b"HTTP/1.1 200") == 1
        assert answer(news).count(b"HTTP/1.1 200") == 1
    assert time.monotonic() - began < 30


def test_a_client_that_does_not_read_is_let_go(monkeypatch):
    """A server of answers that are larger than what a system keeps for a client."""
    monkeypatch.setattr(patience, "PATIENCE", 0.5)

    async def large(scope, receive, send):
        await send({"type": "http.response.start", "status": 200, "headers": []})
        for _ in range(40):
            await send({"type": "http.response.body", "body": bytes(1 << 20), "more_body": True})
        await send({"type": "http.response.body"})

    with contextlib.closing(bound(0)) as taken:
        server = uvicorn.Server(
            uvicorn.Config(large, http=patience.Impatient, lifespan="off", log_level="critical")
        )
        thread = threading.Thread(target=server.run, args=([taken],))
        thread.start()
        try:
            with socket.create_connection(taken.getsockname(), timeout=20) as one:
                one.sendall(b"GET / HTTP/1.1\r\nHost: here\r\n\r\n")
                time.sleep(3)
                assert not server.server_state.connections
        finally:
            server.should_exit = True
            thread.join()


def test_more_connections_than_a_browser_has_are_turned_away_and_forgotten(page):
    with contextlib.ExitStack() as kept:
        for _ in range(MANY):
            kept.enter_context(line(page))
        with line(page) as one:
            one.sendall(head(page, "Connection: close", method="GET", what="live.css"))
            assert status(answer(one)) == 503
    for _ in range(50):  # as soon as the others have gone
        with line(page) as one:
            one.sendall(head(page, "Connection: close", method="GET", what="live.css"))
            if status(answer(one)) == 200:
                break
        time.sleep(0.1)
    else:
        pytest.fail("the page is not served any more")


@pytest.mark.parametrize(
    ("rows", "host"),
    [
        ((), "mechwright.example"),
        ((), "127.0.0.1"),
        ((), "127.0.0.1.mechwright.example:80"),
        (("Origin: http://mechwright.example",), ""),
        (("Host: mechwright.example",), ""),
    ],
)
def test_other_names_and_second_heads_get_nothing(page, rows, host):
    with line(page) as one:
        one.sendall(head(page, *rows, "Content-Length: 2", "Connection: close", host=host) + b"{}")
        assert status(answer(one)) in {400, 403}


@pytest.mark.parametrize("name", ["Origin", "Host", "Cookie"])
def test_of_two_heads_none_counts(page, name):
    """The first is another page's, the second the page's own: a browser and a server may each take either."""
    own = head(page, "Content-Length: 2", "Connection: close", "Cookie: b=2", what="described") + b"{}"
    first, _, rest = own.partition(b"\r\n")
    with line(page) as one:
        one.sendall(first + b"\r\n" + f"{name}: http://mechwright.example\r\n".encode() + rest)
        assert status(answer(one)) == 400


@pytest.mark.parametrize(
    "text",
    [
        b"GET / HTTP/9.9\r\n\r\n",
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + b"\0" * 200 + b"\r\n\r\n",
        b"GET /" + b"x" * 100_000 + b" HTTP/1.1\r\n\r\n",
        b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 30_000 + b"\r\n",
    ],
    ids=["version", "encrypted", "address", "rows"],
)
def test_what_is_no_request_is_refused_and_forgotten(page, text):
    with line(page) as one:
        with contextlib.suppress(BrokenPipeError, ConnectionResetError):
            one.sendall(text)
        said = answer(one)
    assert not said or status(said) in {400, 403, 431}


@pytest.mark.parametrize("method", ["PUT", "DELETE", "OPTIONS", "TRACE", "HEAD"])
def test_other_methods_do_nothing(page, method):
    with line(page) as one:
        one.sendall(head(page, "Connection: close", method=method, what="save"))
        assert status(answer(one)) in {403, 404, 405}


@pytest.mark.parametrize("what", ["../save", "%2e%2e/save", "save/../../x", "..%2f..%2fetc/passwd", "\\save"])
def test_no_address_leads_out_of_what_is_served(page, what):
    with line(page) as one:
        one.sendall(head(page, "Connection: close", method="GET", what=what))
        assert status(answer(one)) in {400, 404, 405}


@pytest.mark.parametrize(
    "body",
    [
        b"[" * 100_000,
        b'{"change": ' + b'{"a": ' * 50_000,
        b'{"change": {"parameters.speed": ' + b"9" * 6000 + b"}}",
        b'{"change": {"parameters.speed": NaN}}',
        b'{"change": {"' + b"x" * 1_000_000 + b'": 1}}',
        b"\xff\xfe{}",
    ],
    ids=["lists", "tables", "digits", "nan", "name", "bytes"],
)
@pytest.mark.parametrize("what", ["motion", "described"])
def test_hostile_questions_are_told_in_a_few_words(page, what, body):
    code, found, _ = page.send("POST", what, body)
    assert code in {200, 400}
    assert len(found) < 3_000_000
    assert "please report" not in found.decode()


LONG = {
    "parts": {".".join("a" * 100_000): 1},
    "parts-below": {f"parameters.{'.'.join('a' * 20_000)}": 1},
    "keys": {f"parameters.{'.'.join([f'k{number}'] * 60)}": 1 for number in range(1000)},
    "list": {"parameters.eccentricity": [1] * 600_000},
    "tables": {"parameters.eccentricity": [{"a": 1}] * 150_000},
    "depth": {"parameters.eccentricity": json.loads("[" * 300 + "]" * 300)},
    "text": {"parameters.material": "x" * 1_900_000},
    "key-within": {"parameters.eccentricity": {".".join("a" * 500_000): 1}},
    "digits": {"parameters.eccentricity": int("9" * 4000)},
}


@pytest.mark.parametrize("what", ["motion", "save", "save-as"])
@pytest.mark.parametrize("change", LONG.values(), ids=LONG)
def test_what_is_long_to_answer_is_refused_at_once(page, change, what):
    """A key of 100,000 parts took 11 s, a list of 600,000 numbers more than a minute."""
    digest = page.ask("described", change={})["digest"]
    began = time.monotonic()
    found = page.ask(what, change=change, digest=digest, name="other")
    assert found["error"]
    assert "please report" not in found["error"]
    assert len(found["error"]) < 3000
    assert time.monotonic() - began < 8
    assert not page.path.with_name("other.toml").exists()


def test_the_file_is_looked_at_before_it_is_saved_over(page):
    """What somebody has put there since has the same bounds."""
    before = page.path.read_bytes()
    try:
        page.path.write_text('"\\"".' * 100_000 + "a = 1\n")
        began = time.monotonic()
        digest = json.loads(page.get("news?known="))["digest"]
        found = page.ask("save", change={"parameters.eccentricity": 0.2}, digest=digest)
        assert "a key with more than 64 parts" in found["error"]
        assert time.monotonic() - began < 8
    finally:
        page.path.write_bytes(before)


def test_the_keyboard_ends_it_while_answers_are_under_way(tmp_path):
    """Some take half a minute each; nobody waits for them."""
    path = tmp_path / "pair.toml"
    shutil.copy(ROOT / "examples" / "elliptic-pair.toml", path)
    page = Page(path)
    asked = json.dumps({"change": {"parameters.teeth": 590}}).encode()
    with contextlib.ExitStack() as kept:
        for _ in range(12):
            kept.enter_context(line(page)).sendall(
                head(page, f"Content-Length: {len(asked)}", what="parts") + asked
            )
        time.sleep(0.5)
        began = time.monotonic()
        page.end()
        assert time.monotonic() - began < 15


@pytest.mark.parametrize("key", ["k", "paramters.teeth", "units", "a.b.c"])
@pytest.mark.parametrize("what", ["motion", "parts", "described"])
def test_no_key_is_taken_and_not_heeded(page, key, what):
    assert "error" in page.ask(what, change={key: 1})
