"""dualdamp: how far can a friction estimate be trusted when the friction is not what the estimator assumes?

The package runs scenarios of oscillators with friction, exactly from event to event, and identifies viscous damping and
Coulomb friction from measured or simulated data. All computations are those of the program `dualdamp`: the same libraries, the
same numbers to the last bit. Its guides hold here too; `docs/python.md` is the tutorial.

>>> import dualdamp as dd
>>> rig = dd.System(mass="1 kg", stiffness="100 N/m", damping="4 N.s/m", friction=dd.law("coulomb", kinetic="2 N"))
>>> drive = dd.excitation("base_harmonic", amplitude="0.1 m", frequency="natural")
>>> round(rig.steady_state(drive).amplitude, 4)
0.1861
"""

from importlib import import_module as _import_module

# What a user sees, and the module that defines it. Nothing is imported before it is used: `import dualdamp` takes a millisecond.
_PLACES = {
    "run": "_run",
    "check": "_run",
    "load_plugin": "_run",
    "Result": "_results",
    "Record": "_results",
    "System": "_systems",
    "Law": "_systems",
    "Excitation": "_systems",
    "law": "_systems",
    "excitation": "_systems",
    "quantity": "_systems",
    "friction_law": "_python_laws",
    "parameter": "_law_parts",
    "compile_law": "_python_laws",
    "include_directory": "_python_laws",
    "Instant": "_python_laws",
    "Parameter": "_law_parts",
    "identify": "_identification",
    "next": "_identification",
    "fit": "_fitting",
    "predict": "_fitting",
    "benchmark": "_contest",
    "Case": "_contest",
    "cases": "_contest",
    "stress_export": "_contest",
    "stress_score": "_contest",
    "steady_state": "_batches",
    "SteadyStates": "_batches",
    "laws": "_tables",
    "methods": "_tables",
    "excitations": "_tables",
    "simulate": "_analyses",
    "free_decay": "_analyses",
    "xy_curve": "_analyses",
    "frequency_response": "_analyses",
    "regime_map": "_analyses",
    "xy_branch": "_analyses",
    "frequency_branch": "_analyses",
    "DualdampError": "_errors",
    "InvalidScenario": "_errors",
    "Diagnostic": "_errors",
    "NumericalFailure": "_errors",
    "CheckFailed": "_errors",
    "OutputError": "_errors",
    "IncompleteResult": "_errors",
}
__all__ = sorted(_PLACES)

def __getattr__(name):
    if name == "__version__":
        return _import_module("._library", __name__).core.version
    if name not in _PLACES:
        raise AttributeError(f"module 'dualdamp' has no attribute {name!r}")
    value = getattr(_import_module("." + _PLACES[name], __name__), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted([*__all__, "__version__"])
