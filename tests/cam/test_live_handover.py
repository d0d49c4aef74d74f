"""How the browser that ``live`` opens gets in: what other users of the machine can read lets nobody in."""

import contextlib
import http.client
import os
import re
import shutil
import signal
import stat
import subprocess
import sys
import time
from pathlib import Path
from urllib.parse import urlencode, urlsplit
from urllib.request import url2pathname

import pytest
from by_night import by_night

from mechwright_cad.live.handover import COOKIE, SHORT, Handover

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals and rights of POSIX")
ROOT = Path(__file__).parents[2]
BROWSER = """\
#!/bin/sh
for one in /proc/[0-9]*/cmdline; do tr '\\0' ' ' < $one; echo; done > {folder}/lines 2> /dev/null
tr '\\0' '\\n' < /proc/self/environ > {folder}/environment 2> /dev/null
echo "$@" > {folder}/given.part && mv {folder}/given.part {folder}/given
"""


class Opened:
    """``live`` as a user starts it, with a browser that notes what every user can read."""

    def __init__(self, folder: Path) -> None:
        browser = folder / "browser"
        browser.write_text(BROWSER.format(folder=folder))
        browser.chmod(0o755)
        path = folder / "pair.toml"
        shutil.copy(ROOT / "examples" / "elliptic-pair.toml", path)
        (folder / "tmp").mkdir()
        self.folder = folder
        self.process = subprocess.Popen(
            [sys.executable, "-m", "mechwright", "live", path],
            env={**os.environ, "BROWSER": f"{browser} %s", "TMPDIR": str(folder / "tmp")},
            stdout=subprocess.PIPE,
            text=True,
        )
        assert self.process.stdout is not None
        said = self.process.stdout.readline()
        self.address = said.split(": ")[1].strip()
        self.token = urlsplit(self.address).path.strip("/")
        self.host = urlsplit(self.address).netloc
        end = time.monotonic() + 60
        while not (folder / "given").exists() and time.monotonic() < end:
            time.sleep(0.05)
        self.given = (folder / "given").read_text().strip()
        self.page = Path(url2pathname(urlsplit(self.given).path))

    def end(self) -> None:
        self.process.send_signal(signal.SIGINT)
        self.process.communicate(timeout=30)

    def send(self, method: str, path: str, body: str = "", **headers: str) -> tuple[int, str, dict[str, str]]:
        line = http.client.HTTPConnection(self.host, timeout=60)
        line.request(method, path, body, headers)
        with contextlib.closing(line), line.getresponse() as reply:
            return reply.status, reply.read().decode(), {k.lower(): v for k, v in reply.headers.items()}

    @property
    def code(self) -> str:
        found = re.search(r'name="code" value="([^"]+)"', self.page.read_text())
        assert found is not None
        return found.group(1)


@pytest.fixture
def opened(tmp_path: Path):
    found = Opened(tmp_path)
    yield found
    found.end()
    assert not list((tmp_path / "tmp").glob("mechwright-live-*")), "nothing stays behind"


def test_the_browser_gets_in_once_and_nobody_else(opened: Opened) -> None:
    code = opened.code
    for file in ("lines", "environment"):
        read = (opened.folder / file).read_text(errors="replace")
        assert str(opened.page) in read or file == "environment"
        assert opened.token not in read
        assert code not in read
    assert stat.S_IMODE(opened.page.stat().st_mode) == 0o600
    assert stat.S_IMODE(opened.page.parent.stat().st_mode) == 0o700
    page = opened.page.read_text()
    assert f'action="http://{opened.host}/enter"' in page
    assert opened.token not in page, "the browser's history has no token"

    form = urlencode({"code": code})
    assert opened.send("POST", "/enter", urlencode({"code": code[:-1] + "-"}))[0] == 403
    assert opened.send("POST", "/enter", form, Host="mechwright.example")[0] == 403
    assert opened.send("GET", f"/enter?{form}")[0] == 403
    assert opened.send("POST", "/enter", "code=" + "x" * (SHORT + 1))[0] == 403
    status, body, headers = opened.send("POST", "/enter", form, Origin="null")
    assert status == 200
    assert headers["referrer-policy"] == "no-referrer"
    secret, *kind = headers["set-cookie"].split("; ")
    place = re.search(r"url=(/[^/]+/)", body).group(1)
    assert kind == [f"Path={place}", "HttpOnly", "SameSite=Strict"]
    assert secret.partition("=")[2] not in body
    assert opened.send("POST", "/enter", form, Origin="null")[0] == 403, "good once"
    assert not opened.page.exists()

    assert opened.send("GET", place, Cookie=secret)[0] == 200
    own = {"Cookie": f"other=1; {secret}", "Origin": f"http://{opened.host}"}
    assert opened.send("POST", f"{place}described", '{"change": {}}', **own)[0] == 200
    for cookie in ("", f"{COOKIE}=", f"{COOKIE}={place.strip('/')}", secret[:-1], secret.upper()):
        assert opened.send("GET", place, Cookie=cookie)[0] == 403
    assert opened.send("GET", "/elsewhere/", Cookie=secret)[0] == 403
    foreign = {"Cookie": secret, "Origin": "http://mechwright.example"}
    assert opened.send("POST", f"{place}described", '{"change": {}}', **foreign)[0] == 403
    assert opened.send("GET", f"/{opened.token}/")[0] == 200, "the address on the terminal"


def test_an_entry_page_that_nobody_opens_goes_with_the_command(opened: Opened) -> None:
    assert opened.page.exists()
    assert opened.given.startswith("file://")


def test_a_second_entry_page_makes_the_first_void() -> None:
    one = Handover("http://127.0.0.1:1")
    try:
        first = one.entry_page()
        code = re.search(r'value="([^"]+)"', first.read_text()).group(1)
        second = one.entry_page()
        assert not first.exists()
        assert one.admitted(urlencode({"code": code}).encode()) is None
        assert one.admitted(b"code=") is None
        assert second.exists()
    finally:
        one.close()
    assert one.admitted(b"code=") is None
    assert not second.exists()


@by_night
def test_a_real_browser_comes_in_by_the_file(opened: Opened) -> None:
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if chromium is None:
        pytest.skip("no chromium here")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        page = browser.new_page()
        page.goto(opened.given)
        page.wait_for_selector("#picture path.part")
        assert opened.token not in page.url
        page.reload()
        page.wait_for_selector("#picture path.part")
        browser.close()
