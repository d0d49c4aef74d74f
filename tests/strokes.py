"""A small study of strokes, swept by the command, and the bytes that came of it."""

import pytest
from typer.testing import CliRunner

from mechwright.cli.app import make_app

TEXT = """
family = "slider-crank"
name = "strokes"
[study]
count = 24
batch = 8
stage = "motion"
front = 0
{more}
[study.ranges]
crank = {{ least = 20, greatest = 40 }}
rod = {{ least = 60, greatest = 160 }}
[study.objectives]
stroke = "greatest"
least_transmission_angle = "greatest"
"""


def swept(folder, *more, text=""):
    pytest.importorskip("pyarrow", reason="pip install 'mechwright[scale]'")
    path = folder.parent / "strokes.toml"
    path.write_text(TEXT.format(more=text))
    return swept_file(path, folder, *more)


def swept_file(path, folder, *more):
    return CliRunner().invoke(make_app(), ["sweep", str(path), "-o", str(folder), *more])


def bytes_of(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }
