"""Systems, laws and excitations: the parts of a scenario as values.

Each is a small immutable value. The reader of scenario files checks systems and laws when they are made. A value becomes a part
of the text of a scenario when it is used. Pickles and copies hold the keys and values as they were given.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping

from . import _tables
from ._library import core
from ._scenario import plain, text_of


class _Part:
    """Keys and values of a section of a scenario."""

    _is_scenario_part = True
    __slots__ = ("_values",)

    def __init__(self, values):
        object.__setattr__(self, "_values", plain(values))

    def __setattr__(self, name, value):
        raise AttributeError(f"a {type(self).__name__} does not change; replace({name}=...) gives another one")

    def __getattr__(self, name):
        if not name.startswith("_") and name in self._values:
            return plain(self._values[name])
        # With the name and the object, Python itself adds a similar name, also of a method.
        raise AttributeError(f"this {type(self).__name__} has no {name!r}; its keys are: {', '.join(self._values)}", name=name, obj=self)

    def __dir__(self):
        return [*super().__dir__(), *self._values]

    def to_dict(self):
        """The keys and values, as in a scenario."""
        return plain(self._values)  # a deep copy, so that the part cannot be changed through it

    def __eq__(self, other):
        return type(self) is type(other) and self._values == other._values

    def __hash__(self):
        return hash((type(self), _hashable(self._values)))

    def __reduce__(self):
        return _restored, (type(self), self._values)

    def __copy__(self):
        return self

    def __deepcopy__(self, memo):
        return self


def _hashable(value):
    """Equal for plain values that are equal: dicts with the same keys in another order, 1 and 1.0."""
    if isinstance(value, dict):
        return frozenset((key, _hashable(item)) for key, item in value.items())
    if isinstance(value, list):
        return tuple(map(_hashable, value))
    return value


def _restored(kind, values):
    part = object.__new__(kind)
    _Part.__init__(part, values)
    return part


def _arguments(values):
    return ", ".join(f"{_tables.python_name(key)}={value!r}" for key, value in values.items())


def _check(system, excitation=None):
    """Lets the reader of scenario files check a system. Raises `InvalidScenario`."""
    scenario = {"system": system, "excitation": excitation, "analysis": {"type": "simulate", "duration": "1 s"}}
    core.resolved(core.Source(text_of(scenario), "scenario"))


class Law(_Part):
    """A friction law with its parameters. `law` makes one."""

    __slots__ = ()

    def replace(self, **parameters):
        """The same law with other values; None removes a parameter."""
        values = {**self._values, **parameters}
        return law(values.pop("law"), **values)

    def __repr__(self):
        values = dict(self._values)
        return f"law({values.pop('law')!r}{', ' if values else ''}{_arguments(values)})"


def law(name, **parameters):
    """A friction law.

    Parameters
    ----------
    name : str
        One of `laws`. ``print(dualdamp.laws)`` lists them; ``help(dualdamp.laws.lugre)`` shows the parameters of one.
    **parameters
        As in a scenario file: texts with units, or numbers in SI.

    Returns
    -------
    Law
        For the key ``friction`` of a `System`.

    Raises
    ------
    ValueError
        There is no such law.
    InvalidScenario
        A parameter is missing, unknown or out of range.

    Examples
    --------
    >>> import dualdamp as dd
    >>> dd.law("coulomb", kinetic="2 N", static="3 N")
    law('coulomb', kinetic='2 N', static='3 N')
    """
    _tables.entry("laws", name)
    values = {"law": name, **parameters}
    _check({"mass": 1.0, "stiffness": 1.0, "damping": 0.0, "friction": values})
    return _restored(Law, values)


class Excitation(_Part):
    """The excitation of an oscillator. `excitation` makes one."""

    __slots__ = ()

    def replace(self, **keys):
        """The same excitation with other values; None removes a key."""
        values = {**self._values, **keys}
        return excitation(values.pop("type"), **values)

    def __repr__(self):
        values = dict(self._values)
        return f"excitation({values.pop('type')!r}{', ' if values else ''}{_arguments(values)})"


def excitation(type, **keys):  # noqa: A002 - the key of the scenario file
    """What drives the oscillator.

    Parameters
    ----------
    type : str
        One of `excitations`; ``print(dualdamp.excitations)`` lists them, ``help(dualdamp.excitations.base_harmonic)`` shows the
        keys of one.
    **keys
        As in a scenario file: texts with units or SI numbers; a frequency always has a unit, or is ``"natural"`` or ``"damped"``.
        The key ``from`` is written ``from_``.

    Returns
    -------
    Excitation

    Raises
    ------
    ValueError
        There is no such excitation.

    Notes
    -----
    The names of the keys are checked at once, their values when a scenario is run: an analysis that varies the amplitude or the
    frequency does not need that key, or refuses it.

    Examples
    --------
    >>> import dualdamp as dd
    >>> dd.excitation("base_harmonic", amplitude="0.1 m", frequency="1.59 Hz")
    excitation('base_harmonic', amplitude='0.1 m', frequency='1.59 Hz')
    """
    keys = _tables.as_keys(keys)
    known = [key["name"] for key in _tables.entry("excitation", type)["keys"]]
    for key in keys:
        if key not in known:
            raise TypeError(f"excitation {type!r} has no key {key!r}; it has: {', '.join(known) or 'none'}")
    return _restored(Excitation, {"type": type, **keys})


class System(_Part):
    """A mass on a spring with viscous damping and friction."""

    __slots__ = ()

    def __init__(self, **keys):
        super().__init__(keys)
        _check(self)

    def replace(self, **keys):
        """The same system with other values; None removes a key."""
        return System(**{**self._values, **keys})

    def __repr__(self):
        return f"System({_arguments(self._values)})"

    def __getattr__(self, name):
        from . import _analyses

        if name in _analyses.OF_SYSTEMS:
            return lambda *arguments, **keys: _analyses.function(name)(self, *arguments, **keys)
        if name == "steady_state":
            from ._batches import steady_state

            return lambda *arguments, **keys: steady_state(self, *arguments, **keys)
        return super().__getattr__(name)

    def __dir__(self):
        from . import _analyses

        return [*super().__dir__(), *_analyses.OF_SYSTEMS, "steady_state"]


def quantity(values, unit):
    """Numbers as texts with a unit, for the values of a scenario.

    Parameters
    ----------
    values : float or array_like
        The numbers.
    unit : str
        Their unit: ``"Hz"``, ``"mm"``.

    Returns
    -------
    str or list of str

    Examples
    --------
    >>> import dualdamp as dd
    >>> dd.quantity([1, 2.5], "Hz")
    ['1 Hz', '2.5 Hz']
    """
    numbers = plain(values)
    if isinstance(numbers, list):
        return [quantity(number, unit) for number in numbers]
    if isinstance(numbers, bool) or not isinstance(numbers, (int, float)):
        raise TypeError(f"a quantity is made of a number or of several, not of {numbers!r}")
    return f"{numbers!r} {unit}"


def law_maker(item):
    """A function like `law` for one law, with the signature and docstring of that law."""

    def make(**parameters):
        return law(item["name"], **parameters)

    lines = [item["summary"][:1].upper() + item["summary"][1:] + ".", "", *item["equation"].splitlines()]
    if item["caution"]:
        lines += ["", f"Caution: {item['caution'].rstrip('.')}."]
    lines += _tables.section("Parameters", _tables.parameter_docs(item["keys"]))
    lines += _tables.section("Returns", ["Law"])
    lines += _tables.section("Notes", [f"Engine: {item['engine']}. Sources: {item['sources']} (docs/refs.bib)."])
    return _dressed(make, item["name"], _tables.signature_of(item["keys"]), lines)


def excitation_maker(item):
    """A function like `excitation` for one type, with the signature and docstring of that type."""

    def make(**keys):
        return excitation(item["name"], **keys)

    lines = [item["summary"][:1].upper() + item["summary"][1:] + "."]
    lines += _tables.section("Parameters", _tables.parameter_docs(item["keys"]))
    lines += _tables.section("Returns", ["Excitation"])
    return _dressed(make, item["name"], _tables.signature_of(item["keys"]), lines)


def _dressed(function, name, signature, lines):
    function.__name__ = function.__qualname__ = name
    function.__signature__ = signature
    function.__doc__ = "\n".join(lines) + "\n"
    return function


def as_mapping(value):
    """A part, or a mapping, as a dict."""
    if isinstance(value, _Part):
        return value.to_dict()
    if isinstance(value, Mapping):
        return dict(value)
    raise TypeError(f"a System, a Law, an Excitation or a dict is needed, not {type(value).__name__}")


def _system_docs():
    keys = _tables.tables()["system"][0]["keys"]
    lines = ["A mass on a spring with viscous damping and friction.", ""]
    lines += ["m x'' + c x' + k x + F = k y(t) + f(t), with the friction force F of one law, or of several in parallel."]
    lines += _tables.section("Parameters", _tables.parameter_docs(keys))
    lines += _tables.section("Raises", ["InvalidScenario", "    A key is missing, unknown or out of range."])
    lines += _tables.section(
        "Examples",
        [
            ">>> import dualdamp as dd",
            '>>> rig = dd.System(mass="1 kg", stiffness="100 N/m", damping_ratio=0.2, friction=dd.law("coulomb", kinetic="2 N"))',
            '>>> rig.free_decay(initial={"position": "0.3 m"}, peaks=3).peaks["x"].shape',
            "(3,)",
        ],
    )
    return "\n".join(lines) + "\n", inspect.Signature(_tables.signature_of(keys).parameters.values())


System.__doc__, System.__signature__ = _system_docs()
