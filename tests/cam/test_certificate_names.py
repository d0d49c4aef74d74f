"""Files that a certificate names twice: a drawing that a design reads may be called as the one that is written."""

import hashlib

import pytest
from certificates import checked, written

OTHER = b"0\nEOF\n"


@pytest.fixture
def certificate(tmp_path):
    """A certificate that binds two drawings of one name; the written one lies beside it."""

    def change(content):
        drawn = hashlib.sha256((tmp_path / "drawing.dxf").read_bytes()).hexdigest()
        read = hashlib.sha256(OTHER).hexdigest()
        content["bound"] = [
            {"what": "drawing", "name": "drawing.dxf", "sha256": drawn},
            {"what": "input", "name": "drawing.dxf", "sha256": read},
        ]

    written(tmp_path, "profile-outside", "grbl")
    return written(tmp_path, "profile-outside", "grbl", change)


def test_either_of_two_drawings_of_one_name_is_the_right_one(certificate, capsys):
    assert checked(capsys, certificate)[0] == 0
    (certificate.parent / "drawing.dxf").write_bytes(OTHER)
    assert checked(capsys, certificate)[0] == 0


def test_a_third_one_is_refuted(certificate, capsys):
    (certificate.parent / "drawing.dxf").write_bytes(OTHER + b"\n")
    code, said = checked(capsys, certificate)
    assert code == 1
    assert "drawing.dxf is not the drawing that the certificate is of: its hash is another" in said


def test_a_program_takes_no_other_hash(certificate, capsys):
    program = next(certificate.parent.glob("*.nc"))
    program.write_bytes(program.read_bytes() + b"(x)\n")
    code, said = checked(capsys, certificate)
    assert code == 1
    assert f"{program.name} is not the program" in said


def test_a_program_is_no_input_of_its_name(tmp_path, capsys):
    """A certificate that binds another text under the program's name does not let it pass as the program."""

    def change(content):
        name = content["files"][0]["name"]
        other = (tmp_path / name).read_bytes() + b"(x)\n"
        content["bound"].append({"what": "input", "name": name, "sha256": hashlib.sha256(other).hexdigest()})

    written(tmp_path, "profile-outside", "grbl")
    certificate = written(tmp_path, "profile-outside", "grbl", change)
    program = next(tmp_path.glob("*.nc"))
    program.write_bytes(program.read_bytes() + b"(x)\n")
    code, said = checked(capsys, certificate)
    assert code == 1
    assert f"{program.name} is not the program that the certificate is of" in said
