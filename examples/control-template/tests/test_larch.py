import re
from dataclasses import replace

import pytest
from mechwright_larch.control import Larch

from mechwright import ProgramError, host
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.fanuc import Fanuc
from mechwright_cam.machining import machine
from mechwright_cam.pages.setup_sheet import setup_html, summary_html
from mechwright_cam.proof import prove
from mechwright_cam.shop.posting import Compensation
from mechwright_cam.testing import ControlContract, plate_job

LARCH = Larch()


class TestLarch(ControlContract):
    control = Larch


def made(way: Compensation = "control"):
    """A plate that is planned, posted for the Larch, and proven."""
    return machine(plate_job(control="larch", compensation=way), LARCH)


def test_it_is_registered():
    assert isinstance(host().get(Control, "larch"), Larch)


def test_a_program_is_fanuc_s_but_for_the_words_of_coolant():
    job = plate_job()
    program = made("computer").program
    fanuc = Fanuc().write(program).replace("FANUC", "LARCH 300")
    expected = re.sub(r"^M([89])$", r"M10\1", fanuc, flags=re.M)
    assert LARCH.write(program) == expected
    assert expected != fanuc
    assert prove(expected, job, LARCH).ok


def test_words_that_are_not_its_own_are_refused():
    one = made()
    with pytest.raises(
        ProgramError, match=r"^line \d+: M8 is no code that is read in programs for Larch 300"
    ):
        prove(one.text.replace("M108", "M8"), one.job, LARCH)
    with pytest.raises(ProgramError, match="M108 is no code that is read in programs for Fanuc"):
        prove(one.text, one.job, Fanuc())


def test_the_proof_advises_in_its_words():
    one = made()
    dry = prove(one.text.replace("M108\n", ""), one.job, LARCH).checks["coolant"]
    assert not dry.passed
    assert "write M108" in dry.message


def test_the_setup_sheet_asks_for_what_d_holds():
    one = made()
    assert "(D24 HOLDS THE RADIUS OF T24: 3 AS PLANNED, AT MOST 0.1 MORE OR LESS)" in one.text
    name, table = LARCH.offset_table(one.program.tools, one.job.settings)
    page = setup_html(one.job, one.program, one.proof.as_dict(), LARCH, tool_table=name)
    assert "<b>D24</b> = 3.000, the radius" in page
    assert "D24: enter the radius of T24 as measured (6 mm in diameter as planned)" in page
    assert "From 2.900 to 3.100 is proven" in page
    # The Larch has no setting of what D is, and no column of wear.
    for words in ("diameter as a", "parameter 5004", "Geometry and wear"):
        assert words not in page
    assert "Load larch.ofs on the offset page" in page
    assert "Load larch.ofs" in summary_html(
        [(one.job, one.program, None)], LARCH, name="job", tool_table=name
    )
    assert (name, table) == ("larch.ofs", "H024 0.000\nD024 3.000\n")


def test_its_d_is_no_setting_of_the_design_file():
    job = plate_job(control="larch", compensation="control", post={"d_value": "diameter"})
    text = LARCH.write(replace(made().program, posting=job.settings.post))
    assert "D24 HOLDS THE RADIUS OF T24: 3 " in text
    assert LARCH.offset_table(job.tools, job.settings)[1].endswith("D024 3.000\n")
