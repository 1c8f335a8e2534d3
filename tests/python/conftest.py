"""What the tests of the Python package share: the program that it is compared with, and the source tree.

usage: DUALDAMP_PROGRAM=build/ci/cli/dualdamp PYTHONPATH=build/ci/python pytest tests/python
"""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(autouse=True)
def in_source_tree(monkeypatch):
    """Scenarios are named as in the pages: from the root of the tree."""
    monkeypatch.chdir(ROOT)


@pytest.fixture(autouse=True)
def no_law_stays():
    """Laws that a test adds are gone behind it."""
    import dualdamp as dd
    from dualdamp import _tables

    before = set(dd.laws)
    yield
    for name in set(dd.laws) - before:
        _tables.core.remove_law(name)
        vars(dd.laws).pop(name, None)
    _tables.forget()


@pytest.fixture
def program():
    """Runs the program; returns (status, stdout, stderr)."""
    path = os.environ.get("DUALDAMP_PROGRAM")
    if path is None:
        pytest.skip("DUALDAMP_PROGRAM names no program to compare with")

    def call(*arguments, **options):
        done = subprocess.run([path, *map(str, arguments)], capture_output=True, text=True, **options)
        return done.returncode, done.stdout, done.stderr

    return call


@pytest.fixture
def rig():
    import dualdamp as dd

    return dd.System(mass="1 kg", stiffness="100 N/m", damping="4 N.s/m", friction=dd.law("coulomb", kinetic="2 N"))


@pytest.fixture
def drive():
    import dualdamp as dd

    return dd.excitation("base_harmonic", amplitude="0.1 m", frequency="10 rad/s")
