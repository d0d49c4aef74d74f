"""The contract of families for those that come with the project: of alike builds, one is tried by day."""

from collections.abc import Collection, Mapping
from typing import ClassVar

import pytest
from by_night import IN_CI, NIGHT

from mechwright.testing import FamilyContract


class DayContract(FamilyContract):
    """The contract, whose builds of an example wait for the night where another by day shows the same."""

    night: ClassVar[Mapping[str, Collection[int]]] = {}
    """Test to the places in ``examples`` that it takes by night only."""
    nights: ClassVar[Collection[str]] = ()
    """Tests that wait for the night as a whole: the family's own tests by day show the same."""
    compiles: ClassVar[bool] = False
    """Whether many designs at once are evaluated by kernels that take longer to compile than to run: by day
    ``test_plain_kernels.py`` runs them without the compiler."""

    ci: ClassVar[Collection[str]] = ()
    """Tests that CI runs besides the README's command."""

    @pytest.fixture(autouse=True)
    def _by_day(self, request):
        if self.compiles and not IN_CI and request.function.__name__ == "test_evaluate":
            pytest.skip("compiled in CI besides, with MECHWRIGHT_CI=1")
        if request.function.__name__ in self.ci and not IN_CI:
            pytest.skip("in CI besides, with MECHWRIGHT_CI=1")
        if request.function.__name__ in self.nights and not NIGHT:
            pytest.skip("by night, with MECHWRIGHT_NIGHT=1")
        waits = self.night.get(request.function.__name__, ())
        if waits and not NIGHT and self.examples.index(request.getfixturevalue("design")) in waits:
            pytest.skip("by night, with MECHWRIGHT_NIGHT=1")
