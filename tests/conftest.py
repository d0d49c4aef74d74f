"""Fixtures that all tests share."""

import os
import shutil

import pytest
from hypothesis import HealthCheck, settings

REQUIRE_CLIENTS = "MECHWRIGHT_REQUIRE_CLIENTS"

# The machine's load must not decide whether a property holds.
settings.register_profile(
    "mechwright", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("mechwright")


def client(name: str, package: str) -> str:
    """Path of a real client; skips with the reason where it is missing, fails in CI."""
    path = shutil.which(name)
    if path is None:
        reason = f"{name} is not installed (Debian package {package})"
        if os.environ.get(REQUIRE_CLIENTS):
            pytest.fail(reason)
        pytest.skip(reason)
    return path


@pytest.fixture(scope="session")
def rs274() -> str:
    """LinuxCNC's interpreter."""
    return client("rs274", "linuxcnc-uspace")


@pytest.fixture(scope="session")
def ogrinfo() -> str:
    """GDAL's vector reader."""
    return client("ogrinfo", "gdal-bin")
