"""The text of a scenario, as the libraries read it, from a dict."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping

from ._arguments import is_unicode
from ._errors import InvalidScenario

SCHEMA = "dualdamp/1"
_PLAIN_KEY = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\Z")


# The reader refuses less. A dict or a list that holds itself has no end.
_DEEPEST = 50


def plain(value, depth=0):
    """The value as plain dicts, lists and scalars. Arrays become lists; keys whose value is None are left out."""
    if depth > _DEEPEST:
        raise InvalidScenario("error: the scenario is nested too deeply, or a dict or a list of it holds itself")
    if hasattr(value, "to_dict") and not isinstance(value, Mapping) and hasattr(type(value), "_is_scenario_part"):
        return plain(value.to_dict(), depth + 1)
    if isinstance(value, Mapping):
        return {str(key): plain(item, depth + 1) for key, item in value.items() if item is not None}
    if isinstance(value, (str, bool, int, float)):
        # numpy.float64 is a float, but its repr is another one.
        return float(value) if isinstance(value, float) else value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):  # a masked value becomes None there
        return plain(value.tolist(), depth + 1)
    if isinstance(value, (list, tuple, range)):
        return [plain(item, depth + 1) for item in value]
    if value is None:
        raise TypeError("a scenario holds no None here; a masked value of an array is one, too")
    raise TypeError(f"a scenario holds no {type(value).__name__}: {value!r}; it holds texts, numbers, True, False, lists and dicts")


def flow(value):
    """A plain value as YAML on one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(key)}: {flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(flow, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    return repr(value)


def _key(key):
    return key if _PLAIN_KEY.match(key) else json.dumps(key, ensure_ascii=False)


def _lines(value, margin):
    for key, item in value.items():
        if isinstance(item, dict) and item:
            yield f"{margin}{_key(key)}:"
            yield from _lines(item, margin + "  ")
        elif isinstance(item, list) and item and all(isinstance(part, dict) for part in item):
            yield f"{margin}{_key(key)}:"
            yield from (f"{margin}  - {flow(part)}" for part in item)
        else:
            yield f"{margin}{_key(key)}: {flow(item)}"


def refuse_surrogates(text):
    """Refuses a text that cannot be encoded."""
    if not is_unicode(text):
        at = next(i for i, character in enumerate(text) if not is_unicode(character))
        raise InvalidScenario(f"error: surrogates not allowed: {text[max(at - 20, 0) : at + 20]!r} holds half a character")


def text_of(scenario):
    """The text of a scenario from a mapping.

    Parameters
    ----------
    scenario : mapping
        Keys and values as in a scenario file (docs/scenario-reference.md). ``schema`` may be left out. Values may be texts with
        units, numbers, arrays, `System`, `Law` and `Excitation`; a key whose value is None is left out.

    Returns
    -------
    str
        YAML, one key a line. Messages about a dict give places in this text.

    Examples
    --------
    >>> print(text_of({"analysis": {"type": "simulate", "cycles": 3}}))
    schema: "dualdamp/1"
    analysis:
      type: "simulate"
      cycles: 3
    <BLANKLINE>
    """
    text = "\n".join(_lines({"schema": SCHEMA, **plain(scenario)}, "")) + "\n"
    refuse_surrogates(text)
    return text
