"""The examples of the pages and of every docstring give what they say; signatures and stub follow the tables."""

import doctest
import functools
import inspect
import keyword
import re
import subprocess
import sys
from pathlib import Path

import dualdamp as dd
import pytest
from dualdamp import _analyses, _tables

ROOT = Path(__file__).resolve().parents[2]
OPTIONS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS


@pytest.fixture(scope="module", autouse=True)
def advice_once():
    """The page and the docstring ask for the same advice, which takes seconds: it is computed once for both."""
    compute, known = dd.next, {}

    @functools.wraps(compute)
    def advice(data, **options):
        key = repr(([(name, *map(float, column)) for name, column in data.items()], options))
        if key not in known:
            known[key] = compute(data, **options)
        return known[key]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(dd, "next", advice)
        yield


def run_examples(text, name):
    test = doctest.DocTestParser().get_doctest(text, {}, name, name, 0)
    report = []
    doctest.DocTestRunner(optionflags=OPTIONS, verbose=False).run(test, out=report.append)
    assert not report, "".join(report)
    return len(test.examples)


@pytest.mark.parametrize("page, least", [("python.md", 20), ("benchmark.md", 3)])
def test_the_pages(page, least):
    assert run_examples((ROOT / "docs" / page).read_text(), page) > least


@pytest.mark.parametrize("name", sorted(set(dd.__all__) - {"laws", "methods", "excitations"}))
def test_docstring(name):
    text = inspect.getdoc(getattr(dd, name))
    assert text and len(text.splitlines()) >= 1
    run_examples(text, name)


def test_the_reference_has_every_name():
    text = (ROOT / "docs/site/python-reference.rst").read_text()
    named = {line.split("::")[1].strip() for line in text.splitlines() if line.startswith(".. auto")}
    assert named == set(dd.__all__) - {"laws", "methods", "excitations"}


def test_there_are_examples():
    with_examples = [name for name in dd.__all__ if ">>>" in (inspect.getdoc(getattr(dd, name)) or "")]
    assert {"run", "identify", "System", "law", "excitation", "steady_state", "simulate", "xy_curve", "quantity"} <= set(with_examples)


def test_the_package_itself():
    assert run_examples(dd.__doc__, "dualdamp") == 4


@pytest.mark.parametrize("kind, names", [("laws", dd.laws), ("excitation", dd.excitations)], ids=["laws", "excitations"])
def test_signatures_and_docstrings_follow_the_tables(kind, names):
    for name in names:
        keys = [key["name"] for key in _tables.entry(kind, name)["keys"]]
        make = getattr(names, name)
        names_of_keys = [key + "_" if keyword.iskeyword(key) else key for key in keys]
        assert list(inspect.signature(make).parameters) == names_of_keys
        assert all(f"\n{key} : " in make.__doc__ for key in names_of_keys)


def test_keys_that_are_words_of_python_have_an_underscore(rig):
    chirp = dd.excitations.base_chirp(amplitude="1 mm", from_="1 Hz", to="2 Hz", duration="1 s")
    assert chirp.to_dict()["from"] == "1 Hz"
    assert eval(repr(chirp), {"excitation": dd.excitation}) == chirp
    drive = dd.excitation("base_harmonic", frequency="natural")
    curve = rig.xy_curve(drive, amplitudes=[0.1, 0.2], continue_="both")
    assert len(curve.points) == 4


def test_analyses_have_all_their_keys():
    for name in _analyses.OF_SYSTEMS:
        keys = {key["name"] for key in _tables.entry("analyses", name)["keys"]}
        names_of_keys = {key + "_" if keyword.iskeyword(key) else key for key in keys}
        assert names_of_keys < set(inspect.signature(getattr(dd, name)).parameters)


@pytest.mark.parametrize("name, analysis", [("identify", "identify"), ("next", "design"), ("fit", "fit")])
def test_docstrings_name_options_that_exist(name, analysis):
    text = inspect.getdoc(getattr(dd, name)).split("**options")[1].split("Returns")[0]
    named = re.findall(r"``(\w+)", text.split("analysis ``")[1].split("``", 1)[1])
    assert len(named) >= 2 and set(named) <= {key["name"] for key in _tables.entry("analyses", analysis)["keys"]}


def test_everything_is_where_the_package_says():
    for name in dd.__all__:
        assert getattr(dd, name) is not None
    assert sorted(dd.__all__) == dd.__all__ and set(dd.__all__) < set(dir(dd))
    with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
        dd.nothing


def test_the_stub_is_fresh():
    written = subprocess.run([sys.executable, ROOT / "scripts/lib/python_stubs.py"], capture_output=True, text=True, check=True).stdout
    assert written == (ROOT / "python/dualdamp/__init__.pyi").read_text(), "python3 scripts/lib/python_stubs.py > python/dualdamp/__init__.pyi"


GOOD = """
import dualdamp as dd
import numpy as np
rig = dd.System(mass="1 kg", stiffness=100, damping_ratio=0.2, friction=dd.law("coulomb", kinetic="2 N"))
drive = dd.excitation("base_harmonic", amplitude="0.1 m", frequency="natural")
result: dd.Result = rig.xy_curve(drive, amplitudes=[0.1, "20 cm"])
number: float = result.points["x"].max()
states: dd.SteadyStates = dd.steady_state(mass=1, stiffness=100, zeta=0.2, F0=np.zeros(3), Y=0.1)
law: dd.Law = dd.laws.lugre(kinetic=1, stribeck_velocity="1 mm/s", sigma0=1e5, sigma1=10)
found: dd.Result = dd.identify({"Y": [1.0], "x": [2.0]}, mass=1, stiffness=2, frequency="1 Hz", robust=True)
other: dd.Result = dd.steady_state(rig, drive)
"""
BAD = [
    'dd.law("coulomb")',
    'dd.law("kulomb", kinetic=1)',
    'dd.law("coulomb", kinetik=1)',
    "dd.System(mass=[1])",
    "dd.xy_curve(rig)",
    "dd.run(3)",
    'dd.identify("a.csv", frequency=3)',
]


def test_types(tmp_path):
    api = pytest.importorskip("mypy.api")
    (tmp_path / "lines.py").write_text(GOOD + "\n".join(BAD) + "\n")
    report, _, _ = api.run(["--strict", "--cache-dir", str(tmp_path / "cache"), str(tmp_path / "lines.py")])
    first = len(GOOD.splitlines()) + 1
    lines = {int(line.split(":")[1]) for line in report.splitlines() if ": error:" in line}
    assert lines == set(range(first, first + len(BAD))), report
