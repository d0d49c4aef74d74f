import json

import pytest

from mechwright.contracts.finding import Finding, Severity, errors, refuse
from mechwright.errors import DesignError

UNDERCUT = Finding(
    "gear.undercut",
    Severity.ERROR,
    "teeth",
    "flank 3 is undercut",
    value=12,
    limit=17,
    unit="",
    remedy="use 17 teeth or more",
)


def test_one_line_says_all():
    assert str(UNDERCUT) == "error [gear.undercut] teeth: flank 3 is undercut; use 17 teeth or more"
    assert str(Finding("a.b", Severity.NOTE, "", "so it is")) == "note [a.b] so it is"


def test_as_data_it_survives_json():
    data = json.loads(json.dumps(UNDERCUT.as_dict()))
    assert data["severity"] == "error"
    assert Finding(**{**data, "severity": Severity(data["severity"])}) == UNDERCUT


def test_only_errors_forbid_building():
    warning = Finding("a.b", Severity.WARNING, "teeth", "look", remedy="think")
    assert errors([warning, UNDERCUT, warning]) == [UNDERCUT]
    assert errors([]) == []


def test_the_first_error_is_raised_as_one_line():
    warning = Finding("a.b", Severity.WARNING, "teeth", "look", remedy="think")
    refuse([warning])
    with pytest.raises(DesignError, match="teeth: flank 3 is undercut; use 17 teeth or more"):
        refuse([warning, UNDERCUT])
