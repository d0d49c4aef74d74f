import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright.designs.change import changed, rewritten
from mechwright.errors import DesignError

FILE = """\
# a linkage for the press
format = 1
family = "four-bar"  # plane

[parameters]
crank = "1 in"   # as measured
# coupler = 80  # left out
ground = 9.0

rim = 4

[cam.hold]
tabs = 4  # enough
"""


def test_comments_order_and_blank_lines_stay():
    new = rewritten(FILE, {"parameters.ground": 11, "cam.hold.tabs": 3})
    assert new == FILE.replace("ground = 9.0", "ground = 11").replace("tabs = 4", "tabs = 3")


def test_what_is_not_there_is_added_to_its_table():
    new = rewritten(FILE, {"parameters.pin": 5, "cam.corner_mill": 1, "tolerances.seed": 2})
    assert tomllib.loads(new) == changed(
        tomllib.loads(FILE), {"parameters.pin": 5, "cam.corner_mill": 1, "tolerances.seed": 2}
    )
    kept = [line for line in FILE.splitlines() if line]
    assert [line for line in new.splitlines() if line in kept] == kept


def test_a_key_is_left_out_and_one_that_is_not_there_is_no_matter():
    assert rewritten(
        FILE, {"parameters.rim": None, "parameters.no": None, "new.table.key": None}
    ) == FILE.replace("rim = 4\n", "")


@pytest.mark.parametrize(
    "text",
    [
        "parameters = {crank = 3, ground = 9}\n",
        "parameters.crank = 3\nparameters.ground = 9\n",
        "[parameters]\r\ncrank = 3 # c\r\nground = 9\r\n[cam]\r\n",
        'family = "x"',
    ],
)
def test_every_layout_says_the_same_afterwards(text):
    change = {"parameters.ground": 11.5, "parameters.rim": 2, "cam.climb": False}
    new = rewritten(text, change)
    assert tomllib.loads(new) == changed(tomllib.loads(text), change)
    assert ("\r\n" in new) == ("\r\n" in text)
    assert new.count("\n") == new.count("\r\n") or "\r\n" not in text


@given(
    st.dictionaries(st.sampled_from(["parameters.a", "parameters.b", "cam.c", "cam.hold.d"]), st.integers())
)
def test_a_change_is_what_the_file_then_says(change):
    assert tomllib.loads(rewritten(FILE, change)) == changed(tomllib.loads(FILE), change)


@pytest.mark.parametrize("text", ["crank = ", "a = 1\na = 2\n"])
def test_what_is_no_toml_is_refused(text):
    with pytest.raises(DesignError, match="cannot be written"):
        rewritten(text, {"parameters.ground": 1})


def test_a_key_below_a_number_is_refused():
    with pytest.raises(DesignError, match="ground is no table"):
        changed({"parameters": {"ground": 9}}, {"parameters.ground.x": 1})


def test_the_given_content_stays():
    content = {"parameters": {"ground": 9}}
    changed(content, {"parameters.ground": 11})
    assert content == {"parameters": {"ground": 9}}
