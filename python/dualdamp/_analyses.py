"""A function for each analysis, with signature and docstring from the table of the analysis."""

from __future__ import annotations

import inspect
from functools import lru_cache

from . import _tables
from ._arguments import refuse_twice
from ._run import run
from ._systems import _dressed, as_mapping

# Analyses of one system under one excitation.
OF_SYSTEMS = ("simulate", "free_decay", "xy_curve", "frequency_response", "regime_map", "xy_branch", "frequency_branch")

_COMMON = [
    {"name": "initial", "values": "mapping", "required": False, "meaning": "the state at t = 0: {'position': '1 mm', 'velocity': 0}"},
    {"name": "numerics", "values": "mapping", "required": False, "meaning": "tolerance, solver and verification, as in a scenario file"},
    {"name": "title", "values": "str", "required": False, "meaning": "a title in one line"},
    {"name": "out", "values": "path", "required": False, "meaning": "directory for the files that the program writes"},
    {"name": "threads", "values": "int", "required": False, "meaning": "largest number of threads; default: all cores, or one for a friction law written in Python"},
    {"name": "progress", "values": "callable or True", "required": False, "meaning": "as in `run`"},
]
_EXAMPLES = {
    "simulate": ('rig.simulate(drive, cycles=3, sample_rate="100 Hz").events["kind"][0]', "'reversal'"),
    "free_decay": ('len(rig.free_decay(initial={"position": "0.3 m"}, peaks=4).peaks)', "4"),
    "xy_curve": ('rig.xy_curve(drive.replace(amplitude=None), amplitudes=[0.1, 0.2]).points["x"].round(4)', "array([0.1861, 0.4361])"),
    "frequency_response": ('rig.frequency_response(drive.replace(frequency=None), frequencies=["1 Hz", "2 Hz"]).points["x"].size', "2"),
    "regime_map": (
        'len(rig.regime_map(dd.excitation("base_harmonic"), frequencies=["1 Hz", "2 Hz"], amplitudes=[0.1, 0.2]).points)',
        "4",
    ),
}


def _run_analysis(name, system, excitation, keys):
    refuse_twice(name, keys, ("type",))
    options = {key: keys.pop(key) for key in ("out", "threads", "progress") if key in keys}
    common = {key: keys.pop(key) for key in ("initial", "numerics", "title") if key in keys}
    scenario = {"system": as_mapping(system), "analysis": {"type": name, **keys}, **common}
    if excitation is not None:
        scenario["excitation"] = as_mapping(excitation)
    return run(scenario, **{key: value for key, value in options.items() if value is not None})


def docs_of(item, example=None):
    """The lines of the docstring of an analysis."""
    keys = [key for key in item["keys"]]
    lines = [item["summary"][:1].upper() + item["summary"][1:] + "."]
    lines += _tables.section(
        "Parameters",
        [
            "system : System or mapping",
            "    The oscillator.",
            "excitation : Excitation or mapping, optional",
            "    The excitation; default: none.",
            *_tables.parameter_docs([*keys, *_COMMON]),
        ],
    )
    results = [f"``{field['path']}``" + (f" [{field['unit']}]" if field["unit"] not in ("", "1") else "") + f": {field['meaning']}" for field in item["results"]]
    lines += _tables.section("Returns", ["Result", *[f"    {line}" for line in results]])
    lines += _tables.section("Raises", ["InvalidScenario, NumericalFailure, CheckFailed", "    As in `run`."])
    if example is not None:
        lines += _tables.section(
            "Examples",
            [
                ">>> import dualdamp as dd",
                '>>> rig = dd.System(mass="1 kg", stiffness="100 N/m", damping="4 N.s/m", friction=dd.law("coulomb", kinetic="2 N"))',
                '>>> drive = dd.excitation("base_harmonic", amplitude="0.1 m", frequency="natural")',
                ">>> " + example[0],
                example[1],
            ],
        )
    return lines


@lru_cache(maxsize=None)
def function(name):
    """The function that runs this analysis."""
    item = _tables.entry("analyses", name)

    def analyse(system, excitation=None, **keys):
        return _run_analysis(name, system, excitation, _tables.as_keys(keys))

    # If an analysis has a common key itself, such as `initial` of a free decay, its own key is used.
    known = {key["name"] for key in item["keys"]}
    common = [key for key in _COMMON if key["name"] not in known]
    either = inspect.Parameter.POSITIONAL_OR_KEYWORD
    first = [inspect.Parameter("system", either), inspect.Parameter("excitation", either, default=None)]
    return _dressed(analyse, name, _tables.signature_of([*item["keys"], *common], first), docs_of(item, _EXAMPLES.get(name)))


def __getattr__(name):
    if name in OF_SYSTEMS:
        return function(name)
    raise AttributeError(name)
