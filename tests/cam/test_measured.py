"""One measured place for several programs: their plates have to be alike in thickness, and in X0 Y0."""

import pytest
from planning_parts import bore, job, part, plate, rounded_box

from mechwright.contracts.finding import Severity
from mechwright_cam.setup.measured import check_measured

PLACE = {"x": -300.0, "y": -200.0, "z": -380.0}


def laid(of, **more):
    return job(of, "mill-6", **{"measured": PLACE, "post": {"offsets": True}, **more})


def wide():
    return part(rounded_box(90, 60, 6), bore(12))


@pytest.mark.parametrize(
    ("jobs", "severity"),
    [
        ([laid(plate()), laid(plate(thickness=8))], Severity.ERROR),
        ([laid(plate()), laid(plate(thickness=8), work_offset="G55")], None),
        ([laid(plate()), laid(plate(thickness=8), measured={**PLACE, "z": -378.0})], None),
        ([laid(plate(), post={}), laid(plate(thickness=8), post={})], None),
        ([laid(plate(), measured={}), laid(plate(thickness=8), measured={})], None),
        ([laid(plate()), laid(plate())], None),
        ([laid(plate()), laid(wide())], Severity.WARNING),
        ([laid(plate(), origin="corner"), laid(wide(), origin="corner")], None),
        ([laid(plate(bore(12)), hold={"method": "bore", "clamp_diameter": 14})], None),
        ([laid(wide(), hold={"method": "bore"}), laid(plate(bore(12)), hold={"method": "bore"})], None),
    ],
)
def test_programs_share_a_measured_place_only_where_it_fits_both(jobs, severity) -> None:
    found = list(check_measured(jobs))
    assert [finding.severity for finding in found] == ([severity] if severity else [])
    assert all(f.remedy.startswith("measure plate for itself in [cam.part.plate.measured]") for f in found)
