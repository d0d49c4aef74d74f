"""A design in the browser: what the server answers, to whom, and what it writes."""

import contextlib
import http.client
import json
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from mechwright.contracts.materials import MATERIALS
from mechwright.designs.design import load
from mechwright.errors import OutputError
from mechwright.plugins.host import host
from mechwright_cad.live import answers
from mechwright_cad.live.fields import fields_of
from mechwright_cad.live.server import bound
from mechwright_cad.live.session import Session

ROOT = Path(__file__).parents[2]


class Page:
    """What a page, or somebody who would like to be one, says to the server."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.process = subprocess.Popen(
            [sys.executable, "-m", "mechwright", "live", path, "--no-open"], stdout=subprocess.PIPE, text=True
        )
        said = self.process.stdout.readline()
        self.port, self.token = re.fullmatch(r".*: http://127\.0\.0\.1:(\d+)/(\S+)/\n", said).groups()
        assert "this machine alone" in self.process.stdout.readline()

    def end(self) -> None:
        self.process.send_signal(signal.SIGINT)
        said, _ = self.process.communicate(timeout=30)
        assert (said, self.process.returncode) == ("ended\n", 0)

    def send(self, method, what, body=b"", token=None, **headers):
        line = http.client.HTTPConnection("127.0.0.1", int(self.port), timeout=60)
        here = f"127.0.0.1:{self.port}"
        head = {"Host": here, **({"Origin": f"http://{here}"} if method == "POST" else {}), **headers}
        line.request(method, f"/{self.token if token is None else token}/{what}", body, head)
        with contextlib.closing(line), line.getresponse() as reply:
            return reply.status, reply.read(), reply.headers

    def get(self, what):
        status, body, _ = self.send("GET", what)
        assert status == 200
        return body

    def ask(self, what, **body):
        status, found, _ = self.send("POST", what, json.dumps(body).encode())
        assert status == 200, found
        return json.loads(found)


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    path = tmp_path_factory.mktemp("live") / "pair.toml"
    shutil.copy(ROOT / "examples" / "elliptic-pair.toml", path)
    found = Page(path)
    yield found
    found.end()


def test_the_page_loads_nothing_from_elsewhere(page):
    status, body, headers = page.send("GET", "")
    assert status == 200
    assert re.findall(rb'(?:src|href)="([^"]*)"', body) == [b"data:,", b"live.css", b"live.js"]
    assert "default-src 'none'" in headers["content-security-policy"]
    assert "frame-ancestors 'none'" in headers["content-security-policy"]
    assert headers["cache-control"] == "no-store"
    for file in ("live.js", "live.css"):
        assert not re.search(rb"https?://(?!www\.w3\.org)", page.get(file))


@pytest.mark.parametrize(
    ("method", "what", "headers"),
    [
        ("GET", "", {"token": "wrong"}),
        ("GET", "", {"token": ""}),
        ("GET", "", {"Host": "mechwright.example"}),
        ("POST", "save", {"Origin": "http://mechwright.example"}),
        ("POST", "save", {"Origin": "null"}),
        ("POST", "build", {"Origin": ""}),
        ("POST", "motion", {"token": "wrong"}),
    ],
)
def test_whoever_is_not_the_page_gets_nothing(page, method, what, headers):
    before = page.path.read_bytes()
    asked = {"change": {"parameters.eccentricity": 0.2}, "digest": page.ask("described", change={})["digest"]}
    status, _, _ = page.send(method, what, json.dumps(asked).encode(), **headers)
    assert status == 403
    assert page.path.read_bytes() == before
    assert not page.path.with_name("pair-build").exists()


def test_what_is_too_much_is_refused(page):
    assert page.send("POST", "motion", b"", **{"Content-Length": "99999999"})[0] == 413


@pytest.mark.parametrize(
    "body", [b"", b"[]", b"nonsense", b'{"change": 3}', b'{"change": {"family": "geneva"}}']
)
def test_a_question_that_is_none_is_told(page, body):
    status, found, _ = page.send("POST", "motion", body)
    assert status in {200, 400}
    assert json.loads(found)["error"]


def test_a_change_moves_the_mechanism(page):
    one = page.ask("motion", change={})["scene"]
    two = page.ask("motion", change={"parameters.eccentricity": 0.5})["scene"]
    assert one["bare"]
    most = [max(scene["channels"]["omega4"]["values"], key=abs) for scene in (one, two)]
    assert most[1] / most[0] == pytest.approx(3 / (1.4 / 0.6), rel=1e-3), "(1 + e) / (1 - e)"
    made = page.ask("parts", change={"parameters.eccentricity": 0.5})
    assert {layer["name"] for layer in made["scene"]["layers"]} == {"gear (gear-2)", "gear (gear-4)"}
    assert {one["severity"] for one in made["findings"]} == {"note"}


def test_what_is_drawn_while_one_drags_waits_for_no_frame():
    session = Session(ROOT / "examples" / "geneva-machine.toml", host())
    design = session.changed({"parameters.speed": 31.0}, settle=False)
    found = answers.motion(design)["scene"]
    assert "surroundings" not in vars(design), "a frame takes seconds"
    assert {layer["body"] for layer in found["layers"]} == {"", "driver", "wheel"}
    lines = [
        curve for curve in design.family.solve(design.params, 41).curves.values() if len(curve.points) > 99
    ]
    assert lines, "curves whose points inside are left out"
    left, bottom, width, height = found["window"]
    motion = design.family.solve(design.params, 41)
    for curve in lines:
        low, high = np.array([left, bottom]), np.array([left + width, bottom + height])
        moved = motion.poses[curve.body].transform(curve.points)[..., :2]
        assert (moved > low).all()
        assert (moved < high).all()


def test_the_mechanism_is_shown_before_its_frame():
    session = Session(ROOT / "examples" / "geneva-machine.toml", host())
    design = session.changed({"parameters.speed": 32.0}, settle=False)
    found = answers.mechanism(design)["scene"]
    assert "surroundings" not in vars(design), "a frame takes seconds"
    own = {part.name for part in design.family.parts(design.params)}
    assert {one["name"] for one in found["meshes"]} == own
    whole = answers.parts(design)["scene"]
    assert own < {one["name"] for one in whole["meshes"]}


def test_without_a_frame_all_parts_come_at_once():
    design = load(ROOT / "examples" / "elliptic-pair.toml", host())
    assert answers.mechanism(design) == {"scene": None}


def test_links_are_shown_where_no_plate_moves():
    design = load(ROOT / "examples" / "spherical-crank-rocker.toml", host())
    found = answers.parts(design)["scene"]
    assert found["bare"]
    assert {"crank", "coupler", "rocker"} <= {mesh["name"] for mesh in found["meshes"]}
    assert not answers.parts(load(ROOT / "examples" / "geneva-prototype.toml", host()))["scene"].get("bare")


def test_what_is_wrong_is_told_and_the_page_goes_on(page):
    assert "eccentricity" in page.ask("motion", change={"parameters.eccentricity": 2})["error"]
    assert "no_such" in page.ask("parts", change={"parameters.no_such": 2})["error"]
    found = page.ask("parts", change={"parameters.backlash": 0})
    assert "error" in {one["severity"] for one in found["findings"]}


def test_remedies_come_after_the_findings_and_work(page):
    change = {"parameters.bore": 48}
    assert not any(one["fix"] for one in page.ask("parts", change=change)["findings"])
    tried = page.ask("remedies", change=change)["findings"]
    (fix, *_) = [one["fix"] for one in tried if one["severity"] == "error"]
    left = page.ask("parts", change={**change, **fix})["findings"]
    assert not [one for one in left if one["severity"] == "error"]


def test_fields_are_those_of_the_file_with_bounds_and_units(page):
    known = {one["key"]: one for one in page.ask("described", change={})["fields"]}
    e = known["parameters.eccentricity"]
    assert (e["kind"], e["low"], e["high"], e["given"], e["first"]) == ("number", 0, 0.9, True, True)
    assert known["parameters.teeth"]["kind"] == "whole"
    assert known["parameters.thickness"]["unit"] == "mm"
    assert known["parameters.material"]["choices"] == sorted(MATERIALS)


@pytest.mark.parametrize(
    "example", ["geneva-cycloidal", "spherical-five-bar-refined", "crank-rocker-finished"]
)
def test_fields_of_every_kind_of_family(example):
    design = load(ROOT / "examples" / f"{example}.toml", host())
    for field in fields_of(design):
        json.dumps(field)
        assert field["about"], field["key"]
        if "reach" in field:
            low, high = field["reach"]
            assert low <= field["value"] <= high, field["key"]
            assert [low, high] == [field["low"], field["high"]] or max(-low, high) >= 10


def test_saving_keeps_comments_and_minds_what_others_wrote(tmp_path):
    path = tmp_path / "pair.toml"
    path.write_text('family = "elliptic-gears"\n[parameters]\neccentricity = 0.4  # of the ellipse\n')
    path.chmod(0o640)
    session = Session(path, host())
    known = session.design().digest
    session.save({"parameters.eccentricity": 0.3}, known)
    assert (
        path.read_text() == 'family = "elliptic-gears"\n[parameters]\neccentricity = 0.3  # of the ellipse\n'
    )
    assert path.stat().st_mode & 0o777 == 0o640
    with pytest.raises(OutputError, match="has changed on disk"):
        session.save({"parameters.eccentricity": 0.2}, known)
    assert session.design().params.eccentricity == 0.3
    session.save_as({"parameters.eccentricity": 0.1}, "other")
    assert "0.1  # of the ellipse" in (tmp_path / "other.toml").read_text()
    with pytest.raises(OutputError, match="is there already"):
        session.save_as({}, "other")
    with pytest.raises(Exception, match="cannot be a file name"):
        session.save_as({}, "../other")


def test_the_file_is_followed(page):
    text = page.path.read_text()
    known = page.ask("described", change={})["digest"]
    timer = threading.Timer(0.3, lambda: page.path.write_text(text + "\n# more\n"))
    timer.start()
    assert json.loads(page.get(f"news?known={known}"))["digest"] != known
    page.path.write_text("family = \n")
    assert "is no valid TOML" in page.ask("motion", change={})["error"]
    page.path.write_text(text)
    assert page.ask("described", change={})["digest"] == known


def test_a_build_is_of_the_file_alone_and_can_be_stopped(page):
    said = page.ask("build", change={"parameters.eccentricity": 0.3})
    assert said == {"error": "a build is made of the file: save first"}
    assert page.ask("build", change={})["state"] == "runs"
    assert page.ask("stop")["state"] == "failed"
    assert not page.path.with_name("pair-build").exists()


def test_a_port_in_use_is_refused_in_one_line():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        with pytest.raises(OutputError, match=r"--port \d+: cannot be had: .*; without --port a free one"):
            bound(taken.getsockname()[1])


def test_a_design_that_cannot_be_read_is_not_served(tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text("family = 3\n")
    done = subprocess.run(
        [sys.executable, "-m", "mechwright", "live", path, "--no-open"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
