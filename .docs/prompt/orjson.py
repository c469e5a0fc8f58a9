"""Replace orjson, which has no build for browsers, in the prompt. Only the functions that sweeps need are here."""

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
