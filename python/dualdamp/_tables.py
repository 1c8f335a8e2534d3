"""The tables of the scenario format. Signatures and docstrings are made from them."""

from __future__ import annotations

import inspect
import json
import keyword as words
import textwrap
from functools import lru_cache

from ._library import core

_WIDTH = 110


@lru_cache(maxsize=1)
def tables():
    """Laws, excitations, analyses, methods and sections with their keys, from the reader of scenario files."""
    return json.loads(core.tables())


def forget():
    """To be called after a law was loaded: the tables are then read again."""
    tables.cache_clear()


def entry(kind, name):
    """The entry of that name in a list of the tables.

    Raises
    ------
    ValueError
        There is no such entry; the message lists the names.
    """
    for item in tables()[kind]:
        if item["name"] == name:
            return item
    singular = {"laws": "law", "analyses": "analysis", "methods": "method"}.get(kind, kind)
    raise ValueError(f"there is no {singular} {name!r}; there are: {', '.join(item['name'] for item in tables()[kind])}")


def python_name(key):
    """A key as the name of a parameter: ``from`` becomes ``from_``, since ``from`` is a keyword of Python."""
    return key + "_" if words.iskeyword(key) else key


def as_keys(arguments):
    """The arguments with the names of the scenario format: ``from_`` becomes ``from``."""
    return {name[:-1] if name.endswith("_") and words.iskeyword(name[:-1]) else name: value for name, value in arguments.items()}


def signature_of(keys, first=(), last=()):
    """The keys as keyword-only parameters; required ones have no default."""
    keyword = inspect.Parameter.KEYWORD_ONLY
    named = [
        inspect.Parameter(python_name(key["name"]), keyword, default=inspect.Parameter.empty if key["required"] else None)
        for key in keys
        if key["name"].isidentifier()
    ]
    return inspect.Signature([*first, *named, *last])


def parameter_docs(keys):
    """The section "Parameters" of a docstring, in NumPy format."""
    lines = []
    for key in keys:
        unit = f" [{key['unit']}]" if key.get("unit") not in (None, "", "1") else ""
        lines.append(f"{python_name(key['name'])} : {key['values']}{unit if unit.strip(' []') not in key['values'] else ''}" + ("" if key["required"] else ", optional"))
        meaning = key["meaning"] + (f"; default: {key['default']}" if key.get("default") and key["default"] != "required" else "")
        lines += textwrap.wrap(meaning, _WIDTH, initial_indent="    ", subsequent_indent="    ")
    return lines


def section(title, lines):
    return ["", title, "-" * len(title), *lines] if lines else []


class _Names:
    """The entries of one list of the tables as attributes. Its repr is a list with one line for each entry."""

    def __init__(self, kind, make):
        self._kind = kind
        self._make = make

    def __iter__(self):
        return iter([item["name"] for item in tables()[self._kind]])

    def __contains__(self, name):
        return any(name == item["name"] for item in tables()[self._kind])

    def __len__(self):
        return len(tables()[self._kind])

    def __dir__(self):
        return [item["name"] for item in tables()[self._kind]]

    def __getattr__(self, name):
        if name.startswith("_") or name not in self:
            raise AttributeError(f"there is no {name!r} here; there are: {', '.join(self)}")
        value = self._make(entry(self._kind, name))
        setattr(self, name, value)
        return value

    def __repr__(self):
        rows = [(item["name"], item["summary"]) for item in tables()[self._kind]]
        width = max(len(name) for name, _ in rows)
        return "\n".join(f"{name.ljust(width)}  {summary}" for name, summary in rows)


def _law_maker(item):
    from ._systems import law_maker

    return law_maker(item)


def _excitation_maker(item):
    from ._systems import excitation_maker

    return excitation_maker(item)


class Method(dict):
    """The table entry of an identification method; its repr is a text."""

    def __repr__(self):
        lines = [f"{self['name']}: {self['summary']}", f"  needs: {self['needs']}", f"  assumes: {self['assumes']}", f"  {self['equation']}"]
        lines += [f"  option {option['name']}: {option['values']}; {option['meaning']}" for option in self["options"]]
        return "\n".join(lines)


laws = _Names("laws", _law_maker)
excitations = _Names("excitation", _excitation_maker)
methods = _Names("methods", Method)
