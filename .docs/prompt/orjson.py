"""Stand in for orjson in the prompt: no build of it for the browser can be had. Only what sweeps ask of it is here."""

import json
from json import JSONDecodeError, loads
from math import isfinite
from typing import Any

from jkroll.text import spelled

__all__ = ["OPT_SERIALIZE_NUMPY", "JSONDecodeError", "dumps", "loads"]
OPT_SERIALIZE_NUMPY = 1


def dumps(value: Any, option: int = 0) -> bytes:  # noqa: ARG001
    """Return a number, a list or an array as JSON; nan and infinity are null."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, list):
        return b"[" + b",".join(map(dumps, value)) + b"]"
    if isinstance(value, float):
        return spelled(value).encode() if isfinite(value) else b"null"
    return json.dumps(value, ensure_ascii=False).encode()
