"""Data of a page inside its script element. Imports jinja2's markup."""

import json
from collections.abc import Mapping
from typing import Any

from markupsafe import Markup


def script_data(data: Mapping[str, Any]) -> Markup:
    r"""Plain data as the text of a script element; no name in it can end that element.

    >>> str(script_data({"name": "</script>"}))
    '{"name":"\\u003c/script>"}'
    """
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    return Markup(text.replace("<", "\\u003c"))  # noqa: S704 - nothing is left that opens a tag
