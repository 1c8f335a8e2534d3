"""Fitting of laws and constants to records, and prediction of other records."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping

from ._arguments import path_text, refuse_twice
from ._identification import in_memory
from ._library import core
from ._run import run_source, source_of
from ._scenario import flow, plain
from ._systems import as_mapping

# What may be said of a record, as keywords of `fit` and `predict`: of all records.
OF_RECORDS = ("drive", "loop", "units", "columns", "scale", "decimal", "no_header", "sample_rate", "sigma_x", "sigma_v", "sigma_a", "sigma_force", "sigma_phase")


def fit(
    law,
    data,
    *,
    mass=None,
    stiffness=None,
    damping=None,
    frequency=None,
    amplitude=None,
    excitation=None,
    initial=None,
    validate=None,
    record=None,
    out=None,
    threads=0,
    **options,
):
    """Fit the parameters of a friction law and of the rig to records.

    The fit seeks every parameter that is not stated: mass, stiffness, damping and the required parameters of the law.

    Parameters
    ----------
    law : str, Law, mapping or list of str
        The name of a law; or a law with some of its parameters stated, ``{"law": "lugre", "sigma2": 0}``. A list of names fits
        each of these laws separately and compares them.
    data : path, DataFrame, structured array, mapping of str to array_like, or list of such
        One or several records of one rig, as in `identify`. docs/fit.md says what is compared.
    mass, stiffness, damping : str or float, optional
        Known constants.
    frequency, amplitude : str, optional
        Frequency and amplitude of the harmonic motion of the base: ``"4 Hz"``, ``"5 mm"``.
    excitation : Excitation or mapping, optional
        Another drive, in place of `frequency` and `amplitude`. If no drive is stated, the motion ``y`` in a record is
        its drive.
    initial : mapping, optional
        The state at the start of the histories, if it is known.
    validate : like data, optional
        Records that are not fitted, but predicted with the fitted parameters.
    record : mapping or list of mapping, optional
        Statements about the records: ``{"units": {"x": "mm"}, "sigma_x": "2 um", "loop": True}``; ``{"drive": "force"}`` for a
        record that its column ``force`` drives. One mapping applies to all records.
        A list has one mapping for each record, first those of `data`, then those of `validate`. Its keys may also stand alone, for all
        records that do not state them: ``drive="force"``, ``loop=True``, ``sigma_x="2 um"``.
    out, threads
        As in `run`.
    **options
        Further keys of the analysis ``fit``: ``free=["mass", "stiffness"]``, ``bounds``, ``stated``, ``starts``, ``robust``, ``profile``.

    Returns
    -------
    Result
        ``parameters``, ``not_identifiable``, ``residual``, ``validation``, ``scenario``. The last one is the text of the fitted rig;
        write ``result.result.scenario`` for it, since ``result.scenario`` is the scenario of the fit. `run` takes this text.

    Raises
    ------
    InvalidScenario, NumericalFailure
        As `run`.

    Examples
    --------
    >>> import dualdamp as dd
    >>> found = dd.fit("coulomb", "scenarios/examples/free_run.csv", mass="1 kg", stiffness="1000 N/m", profile=False)
    >>> [(row["name"], round(row["value"], 2)) for row in found.result.parameters[:2]]
    [('damping', 1.0), ('kinetic', 1.0)]
    """
    refuse_twice("fit", options, ("type", "laws"))
    if excitation is None and frequency is not None:
        excitation = {"type": "base_harmonic", "frequency": frequency, "amplitude": amplitude}
    elif frequency is not None or amplitude is not None:
        raise TypeError("frequency, perhaps with amplitude, is a drive by itself: state these or an excitation")
    texts = {}
    system = {"mass": mass, "stiffness": stiffness, "damping": damping}
    fitted, kept = _listed(data), _listed(validate)
    for_all = {name: options.pop(name) for name in OF_RECORDS if name in options}
    records = _records(fitted + kept, record, for_all, texts)
    analysis = {"type": "fit", "data": records[: len(fitted)], **options}
    if validate is not None:
        analysis["validate"] = records[len(fitted) :]
    if isinstance(law, (list, tuple)):
        analysis["laws"] = list(law)
    else:
        system["friction"] = {"law": law} if isinstance(law, str) else as_mapping(law)
    scenario = {"system": system, "excitation": excitation, "initial": initial, "analysis": analysis}
    return run_source(source_of(scenario, data=texts), out=out, threads=threads)


def predict(fitted, data, *, excitation=None, record=None, out=None, threads=0, **options):
    """Predict other records of a rig with the parameters of a fit, and say whether they contradict the fit.

    Parameters
    ----------
    fitted : Result
        The result of `fit`.
    data, record
        As in `fit`.
    excitation : Excitation or mapping, optional
        The drive of these records. Without it the motion ``y`` in a record is its drive, else that of the fit. The
        drive of the fit is refused where the records show that they had another one; ``{"type": "none"}`` states that they
        had none.
    out, threads
        As in `run`.
    **options
        Keys of `record` that hold for all records, as in `fit`: ``drive="force"``.

    Returns
    -------
    Result
        Result of the analysis ``predict``: the error, the attainable error, and a statement whether the law is wrong.

    Raises
    ------
    InvalidScenario
        As `run`; also for a record that was fitted: the fit describes it, and predicts nothing.
    NumericalFailure
        As `run`.
    """
    for name in options:
        if name not in OF_RECORDS:
            raise TypeError(f"predict has no option {name!r}; of records it takes: {', '.join(OF_RECORDS)}")
    if getattr(fitted, "analysis", None) != "fit":
        raise TypeError(f"predict takes the result of a fit, not of {getattr(fitted, 'analysis', repr(fitted))}")
    texts = {}
    analysis = {**json.loads(core.prediction_keys(fitted._run)), "data": _records(_listed(data), record, options, texts)}
    if excitation is None:
        analysis["drive_of_fit"] = True
    changes = {"analysis": analysis, **({} if excitation is None else {"excitation": as_mapping(excitation)})}
    set_ = [f"{key}={flow(plain(value))}" for key, value in changes.items()]
    source = core.Source(fitted.result.rig, "fit", data_anywhere=True, data=texts, set=set_)
    return run_source(source, out=out, threads=threads)


def _listed(data):
    """One record or several, as a list; None: no record."""
    return [] if data is None else list(data) if isinstance(data, (list, tuple)) else [data]


def _records(data, record, for_all, texts):
    """The value of the key `data`. The text of data in memory is added to `texts`. `for_all`: what is said of all records."""
    said = list(record) if isinstance(record, (list, tuple)) else [record] * len(data)
    if len(said) != len(data):
        raise ValueError(f"there are {len(data)} records, and 'record' says something of {len(said)}")
    items = []
    for one, more in zip(data, said):
        if not isinstance(more or {}, Mapping):
            raise TypeError(f"'record' is a mapping such as {{'sigma_x': '2 um'}}, or a list of them, not {more!r}")
        if isinstance(one, (str, os.PathLike)):
            name = path_text(one, "the name of a data file")
        else:
            name = f"data {len(texts) + 1}"
            texts[name] = in_memory(one)
        refuse_twice("record", more or {}, ("file",))
        items.append({"file": name, **for_all, **(more or {})})
    return items
