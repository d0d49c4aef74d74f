"""The address of a scheduler, checked before anybody waits for an answer."""

import re

from mechwright.errors import DesignError

_ADDRESS = re.compile(
    r"(?:(?:tcp|tls|wss?)://)?(?P<host>\[[0-9A-Fa-f:.]+\]|[^\s:/@\[\]?#]+):(?P<port>[0-9]{1,5})"
)
_PORTS = 65535


def require_address(text: str, by: str) -> str:
    """The address; raises DesignError, which begins with ``by``, where a text is none.

    >>> require_address("tcp://host:8786", "--scheduler"), require_address("[::1]:8786", "--scheduler")
    ('tcp://host:8786', '[::1]:8786')
    >>> require_address("tcp://", "--scheduler")
    Traceback (most recent call last):
    mechwright.errors.DesignError: --scheduler: 'tcp://' is no address; give one such as tcp://host:8786
    """
    found = _ADDRESS.fullmatch(text)
    if found is None or not 0 < int(found["port"]) <= _PORTS or not _is_name(found["host"]):
        raise DesignError(f"{by}: {text!r:.300} is no address; give one such as tcp://host:8786")
    return text


def _is_name(host: str) -> bool:
    try:
        return bool(host.encode("idna"))
    except UnicodeError:  # an empty part, or one of more than 63 characters
        return False
