"""Keys of ``[cut]`` that the chosen processes do not use."""

import pytest
from test_cut_rules import build_of, of

from mechwright_cut.cutting import Cutting
from mechwright_cut.rules.unused_keys import USED_BY
from mechwright_cut.settings.cut_settings import CutSettings


@pytest.mark.parametrize(
    ("process", "keys", "told"),
    [
        ("service", {"joints": "2", "lead": "2", "kerf": "0.2", "fits": '"ream"'}, ["joints", "lead"]),
        ("waterjet", {"tab": "2", "wire_rate": "50", "pierce": "0.5"}, ["tab"]),
        ("wire", {"overcut": "1", "passes": "2", "service": '"ponoko"'}, ["overcut"]),
        ("plasma", {"power": "60", "lead": "2"}, ["power"]),
    ],
)
def test_a_key_that_no_chosen_process_uses_is_told(tmp_path, process, keys, told):
    table = "".join(f"{key} = {value}\n" for key, value in keys.items())
    with build_of(tmp_path, process, table) as build:
        found = of("cut.unused", build.made(Cutting).findings)
    assert sorted(one.parameter for one in found) == sorted(f"cut.{key}" for key in told)
    assert all(one.proposed == ({one.parameter: None},) for one in found)


def test_every_key_of_some_processes_is_one_of_the_table():
    assert set(USED_BY) <= set(CutSettings.model_fields)
    assert set().union(*USED_BY.values()) == {"laser", "waterjet", "plasma", "wire", "service"}
