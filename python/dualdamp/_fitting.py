"""Fitting of laws and constants to records, and prediction of other records by them."""

from __future__ import annotations

import os
from collections.abc import Mapping

from ._identification import in_memory
from ._library import core
from ._run import run_source, source_of
from ._scenario import flow, plain
from ._systems import as_mapping

# What each record has of its own; a prediction fits it anew.
_OF_RECORDS = ("position", "velocity", "offset", "release")


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
    """Fit a friction law, and the rig around it, to records.

    What is not stated is sought: mass, stiffness, damping and the required numbers of the law.

    Parameters
    ----------
    law : str, Law, mapping or list of str
        A law by its name; or with some of its numbers stated, ``{"law": "lugre", "sigma2": 0}``; several names fit each law by
        itself and compare them.
    data : path, DataFrame, structured array, mapping of str to array_like, or list of such
        One record or several of one rig, as for `identify`; docs/fit.md says what is compared.
    mass, stiffness, damping : str or float, optional
        Constants that are known.
    frequency, amplitude : str, optional
        Of the harmonic motion of the base: ``"4 Hz"``, ``"5 mm"``.
    excitation : Excitation or mapping, optional
        Another drive, in place of the two.
    initial : mapping, optional
        The state at the start of histories, where it is known.
    validate : like data, optional
        Records that are predicted with the fitted numbers, not fitted.
    record : mapping, optional
        What the data do not say of themselves, for each of them: ``{"units": {"x": "mm"}, "sigma_x": "2 um", "loop": True}``.
    out, threads
        As in `run`.
    **options
        Further keys of the analysis ``fit``: ``free="stiffness"``, ``bounds``, ``starts``, ``robust``, ``profile``.

    Returns
    -------
    Result
        ``parameters``, ``not_identifiable``, ``residual``, ``validation``, ``scenario``: the text of the fitted rig, which `run`
        takes as ``result.result.scenario``.

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
    texts = {}
    system = {"mass": mass, "stiffness": stiffness, "damping": damping}
    analysis = {"type": "fit", "data": _records(data, record, texts), **options}
    if validate is not None:
        analysis["validate"] = _records(validate, record, texts)
    if isinstance(law, (list, tuple)):
        analysis["laws"] = list(law)
    else:
        system["friction"] = {"law": law} if isinstance(law, str) else as_mapping(law)
    if excitation is None and frequency is not None:
        excitation = {"type": "base_harmonic", "frequency": frequency, "amplitude": amplitude}
    scenario = {"system": system, "excitation": excitation, "initial": initial, "analysis": analysis}
    return run_source(source_of(scenario, data=texts), out=out, threads=threads)


def predict(fitted, data, *, excitation=None, record=None, out=None, threads=0):
    """Predict other records of a rig by a fit, and say whether they contradict it.

    Parameters
    ----------
    fitted : Result
        Of `fit`.
    data, record
        As for `fit`.
    excitation : Excitation or mapping, optional
        The drive of these records, where it is another one.
    out, threads
        As in `run`.

    Returns
    -------
    Result
        The analysis ``predict``: errors, what is attainable, and the verdict.

    Raises
    ------
    InvalidScenario, NumericalFailure
        As `run`.
    """
    if fitted.analysis != "fit":
        raise TypeError(f"predict takes the result of a fit, not of {fitted.analysis}")
    found, texts = fitted.result, {}
    shared = [i for i, row in enumerate(found.parameters) if row["name"].split("[")[0] not in _OF_RECORDS]
    analysis = {"type": "predict", "data": _records(data, record, texts)}
    if shared:
        analysis["free"] = ", ".join(found.parameters[i]["name"] for i in shared)
        analysis["covariance"] = [found.covariance[i][j] for i in shared for j in shared]
    drive = fitted.scenario.get("excitation") if excitation is None else as_mapping(excitation)
    changes = {"analysis": analysis, **({} if drive is None else {"excitation": drive})}
    set_ = [f"{key}={flow(plain(value))}" for key, value in changes.items()]
    source = core.Source(found.scenario, "fit", data_anywhere=True, data=texts, set=set_)
    return run_source(source, out=out, threads=threads)


def _records(data, record, texts):
    """The value of the key `data`; what lies in memory goes to `texts`."""
    items = []
    for one in data if isinstance(data, (list, tuple)) else [data]:
        name = os.fspath(one) if isinstance(one, (str, os.PathLike)) else f"data {len(texts) + 1}"
        if not isinstance(one, (str, os.PathLike)):
            texts[name] = in_memory(one)
        items.append({"file": name, **(record if isinstance(record, Mapping) else {})})
    return items
