"""Errors are exceptions with the program's located messages; Ctrl-C ends a run; other threads run meanwhile."""

import errno
import os
import pickle
import resource
import signal
import sys
import threading
import time
import warnings
from pathlib import Path

import dualdamp as dd
import pytest

ROOT = Path(__file__).resolve().parents[2]
INVALID = sorted([*(ROOT / "tests/invalid").glob("*.yaml"), *(ROOT / "tests/invalid_text").glob("*.yaml")])
LONG = "scenarios/examples/identify_intervals.yaml"


def test_hierarchy():
    assert issubclass(dd.InvalidScenario, (dd.DualdampError, ValueError))
    assert issubclass(dd.NumericalFailure, dd.DualdampError) and issubclass(dd.NumericalFailure, ArithmeticError)
    assert issubclass(dd.CheckFailed, dd.DualdampError) and issubclass(dd.OutputError, OSError)


@pytest.mark.parametrize("path", INVALID, ids=lambda path: path.stem)
def test_refused_as_by_the_program(path, program):
    path = path.relative_to(ROOT)
    status, _, message = program("check", path)
    if status == 0:  # an expectation that turns out to be wrong at the end of the run only
        status, _, message = program("run", path, "--out", "/tmp/dualdamp-refused", "--quiet")
    assert status == 3
    with pytest.raises(dd.InvalidScenario) as caught:
        dd.run(path)
    assert str(caught.value).strip() == message.strip().replace("with --plugin LIB", "with load_plugin(LIB)")


def test_diagnostics():
    with pytest.raises(dd.InvalidScenario) as caught:
        dd.run({"system": {"mass": "-1 kg", "stifness": 1}, "analysis": {"type": "simulate", "duration": 1}})
    problems = caught.value.diagnostics
    assert len(problems) == 4
    mass = next(problem for problem in problems if "mass" in problem.message)
    assert (mass.file, mass.line, mass.column, mass.text, mass.allowed, mass.found) == ("scenario", 3, 9, '  mass: "-1 kg"', "> 0 kg", "-1 kg")
    assert any(problem.suggestion == "stiffness" for problem in problems)
    restored = pickle.loads(pickle.dumps(caught.value))
    assert str(restored) == str(caught.value) and restored.diagnostics == problems


def test_a_part_is_checked_when_it_is_made():
    with pytest.raises(dd.InvalidScenario, match="did you mean 'kinetic'"):
        dd.law("coulomb", kinetik=2)
    with pytest.raises(dd.InvalidScenario, match="'system.mass' is out of range"):
        dd.System(mass=0, stiffness=1, damping=0)
    with pytest.raises(ValueError, match="there is no law 'kulomb'; there are: .*bouc_wen"):
        dd.law("kulomb")
    with pytest.raises(TypeError, match="excitation 'base_harmonic' has no key 'amplitud'; it has: amplitude"):
        dd.excitation("base_harmonic", amplitud=1)


def test_python_proposes_a_method_that_is_spelt_wrongly(capsys):
    with pytest.raises(AttributeError, match="this System has no 'steadystate'; its keys are: mass, stiffness, damping") as caught:
        dd.System(mass=1, stiffness=1, damping=0).steadystate
    sys.__excepthook__(caught.type, caught.value, caught.tb)
    assert "Did you mean: 'steady_state'?" in capsys.readouterr().err


def test_no_scenario():
    with pytest.raises(dd.InvalidScenario, match="nothing.yaml: error: cannot be opened"):
        dd.run("nothing.yaml")
    with pytest.raises(TypeError, match="a scenario is a dict, a text or a path, not int"):
        dd.run(3)
    with pytest.raises(TypeError, match="a scenario holds no object"):
        dd.run({"system": object()})


def test_a_file_names_no_data_outside_and_a_dict_may(tmp_path):
    data = tmp_path / "pairs.csv"
    data.write_text("Y,x\n0.02,0.0186\n0.04,0.0686\n0.06,0.1186\n0.08,0.1686\n")
    scenario = {
        "system": {"mass": 1, "stiffness": 100},
        "excitation": {"type": "base_harmonic", "frequency": "10 rad/s"},
        "analysis": {"type": "identify", "data": data, "methods": ["resonance_least_squares"]},
    }
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.IncompleteResult)
        assert dd.run(scenario).estimates[0].zeta == pytest.approx(0.2, rel=1e-3)
    text = dd.check(scenario).replace("{", "{\n", 1)
    with pytest.raises(dd.InvalidScenario, match="must stay inside the scenario's directory"):
        dd.run(text)


def test_numerical_failure_holds_the_run(rig, drive):
    undamped = dd.System(mass=1, stiffness=100, damping=0)
    with pytest.raises(dd.NumericalFailure) as caught:
        undamped.steady_state(drive)
    assert "steady" in str(caught.value) or "grow" in str(caught.value)
    assert caught.value.result.status == 4 and caught.value.result.result is None


def test_check_failed_holds_the_result(rig, drive):
    scenario = {"system": rig, "excitation": drive, "analysis": {"type": "steady_state"}}
    with pytest.raises(dd.CheckFailed, match="amplitude is 0.186.*, expected 1") as caught:
        dd.run({**scenario, "expect": [{"value": "amplitude", "equals": 1, "within": 0.1}]})
    assert caught.value.result.checks[0].difference == pytest.approx(-0.8139, abs=1e-4)


def test_no_place_for_the_result(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(dd.OutputError, match="file"):
        dd.run("scenarios/examples/xy_curve.yaml", out=tmp_path / "file")


def test_a_file_that_the_system_does_not_open(tmp_path):
    scenario = tmp_path / "rig.yaml"
    scenario.write_text((ROOT / "scenarios/examples/xy_curve.yaml").read_text())
    dd.check(scenario)  # what is read once
    before = resource.getrlimit(resource.RLIMIT_NOFILE)
    first_free = os.dup(0)
    os.close(first_free)
    resource.setrlimit(resource.RLIMIT_NOFILE, (first_free, before[1]))
    try:
        with pytest.raises(OSError, match="rig.yaml: cannot be opened: Too many open files") as fault:
            dd.check(scenario)
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, before)
    assert fault.value.errno == errno.EMFILE


@pytest.fixture
def interruptible():
    """Python's own handler; a process in the background of a shell may begin without one."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_interrupt(interruptible):
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        dd.run(LONG)
    assert time.monotonic() - begin < 5
    assert dd.run("scenarios/examples/xy_curve.yaml").status == 0  # the next run is not cancelled


def test_interrupt_reaches_the_users_handler():
    class Stop(Exception):
        pass

    def handler(number, frame):
        raise Stop

    before = signal.signal(signal.SIGINT, handler)
    try:
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        with pytest.raises(Stop):
            dd.run(LONG)
        assert signal.getsignal(signal.SIGINT) is handler
    finally:
        signal.signal(signal.SIGINT, before)


def test_other_threads_run_meanwhile():
    count = 0
    done = threading.Event()

    def run():
        dd.run("scenarios/examples/output_error.yaml")
        done.set()

    thread = threading.Thread(target=run)
    thread.start()
    while not done.wait(0.001):
        count += 1
    thread.join()
    assert count > 20  # with the lock held it would be one or two


def test_interrupt_of_a_batch(interruptible):
    """Before 740 MB of results are touched; the computation would last seconds."""
    import numpy as np

    threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        dd.steady_state(mass=1.0, stiffness=100.0, zeta=0.2, F0=np.linspace(0, 2, 40_000)[:, None], Y=np.linspace(0.1, 0.5, 1000))
    assert time.monotonic() - begin < 2
