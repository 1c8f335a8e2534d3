"""Many steady states at once: shapes, closed forms, the numbers of scenarios, outcomes."""

import dualdamp as dd
import numpy as np
import pytest

RIG = {"mass": 1.0, "stiffness": 100.0, "damping": 4.0}


def test_the_numbers_of_scenarios():
    """Every engine by its own code: batches in packs, scenarios one by one; also where the mass sticks."""
    forces, amplitudes = [0.5, 2.0, 3.0], [0.04, 0.1, 0.3]
    states = dd.steady_state(**RIG, F0=np.array(forces)[:, None], Y=amplitudes)
    for i, force in enumerate(forces):
        rig = dd.System(**RIG, friction=dd.law("coulomb", kinetic=force))
        for j, amplitude in enumerate(amplitudes):
            one = rig.steady_state(dd.excitation("base_harmonic", amplitude=amplitude, frequency="10 rad/s"))
            assert states.amplitude[i, j] == pytest.approx(one.amplitude, rel=1e-10)
            assert states.stops[i, j] == one.stops_per_cycle
            assert np.cos(states.phase[i, j] - one.phase) == pytest.approx(1, abs=1e-9)
    assert (states.stops > 0).any() and (states.stops == 0).any()


def test_a_linear_oscillator():
    """Without friction |x| = k Y / sqrt((k - m w^2)^2 + (c w)^2); the same for a force k Y; the damper to the base adds c w Y."""
    omega = np.linspace(2, 30, 40)
    k, m, c, Y = 100.0, 1.0, 4.0, 0.1
    whole = k * Y / np.hypot(k - m * omega**2, c * omega)
    assert dd.steady_state(**RIG, F0=0, Y=Y, omega=omega).amplitude == pytest.approx(whole, rel=1e-10)
    assert dd.steady_state(**RIG, F0=0, force=k * Y, omega=omega).amplitude == pytest.approx(whole, rel=1e-10)
    moved = whole * np.hypot(1, c * omega / k)
    assert dd.steady_state(**RIG, F0=0, Y=Y, omega=omega, damper_to="base").amplitude == pytest.approx(moved, rel=1e-10)


def test_every_shape_is_that_of_numpy():
    rng = np.random.default_rng(1)
    F0 = rng.uniform(0, 1, (3, 1, 4))
    Y = rng.uniform(0.1, 0.3, (5, 1))
    mass = rng.uniform(0.8, 1.2, 4)
    states = dd.steady_state(mass=mass, stiffness=100, zeta=0.2, F0=F0, Y=Y)
    assert states.shape == states.amplitude.shape == (3, 5, 4)
    whole = np.broadcast_arrays(mass, F0, Y)
    for place in [(0, 0, 0), (2, 4, 3), (1, 3, 2)]:
        m, force, amplitude = (array[place] for array in whole)
        assert states.peak[place] == dd.steady_state(mass=m, stiffness=100, zeta=0.2, F0=force, Y=amplitude).peak
    # Also arrays that are no blocks of memory, and more oscillators than one chunk.
    step = np.linspace(0.1, 0.3, 120_001)[::3]
    many = dd.steady_state(**RIG, F0=[[0.5], [1.0]], Y=step)
    assert many.shape == (2, 40_001)
    assert many.peak[1, -1] == dd.steady_state(**RIG, F0=1.0, Y=step[-1]).peak
    assert many.peak[0, 35_000] == dd.steady_state(**RIG, F0=0.5, Y=step[35_000]).peak
    assert dd.steady_state(**RIG, F0=np.zeros(0), Y=0.1).shape == (0,)
    with pytest.raises(ValueError, match="cannot be broadcast to one shape: lengths 2 and 3"):
        dd.steady_state(**RIG, F0=np.zeros(2), Y=np.zeros(3))


def test_the_same_bits_on_any_number_of_threads():
    Y = np.linspace(0.03, 0.3, 5000)
    one, two = (dd.steady_state(**RIG, F0=2, Y=Y, threads=threads) for threads in (1, 2))
    assert np.array_equal(one.peak, two.peak) and np.array_equal(one.phase, two.phase)


def test_no_steady_state():
    """Without damping at resonance the motion grows once Y > 4 F0/(pi k)."""
    Y = np.array([0.02, 0.1])
    states = dd.steady_state(mass=1, stiffness=100, damping=0, F0=2, Y=Y)
    assert states.outcome.tolist() == ["done", "no_steady_state"]
    assert np.isfinite(states.amplitude[0]) and np.isnan(states.amplitude[1])
    with pytest.raises(dd.NumericalFailure, match="no_steady_state"):
        dd.steady_state(mass=1, stiffness=100, damping=0, F0=2, Y=0.1)


def test_wrong_values():
    with pytest.raises(dd.InvalidScenario, match="'mass.1.' is out of range\n  allowed: > 0 kg\n  found: -1 kg"):
        dd.steady_state(mass=[1, -1], stiffness=100, damping=0, F0=2, Y=0.1)
    with pytest.raises(dd.InvalidScenario, match="'static' is out of range\n  allowed: >= 2 N"):
        dd.steady_state(**RIG, F0=2, static=1, Y=0.1)
    for name in ("mass", "stiffness"):
        for value in (-1, 0, [1, -1], [0.0, 1.0]):
            with pytest.raises(dd.InvalidScenario, match=f"^error: '{name}"):
                dd.steady_state(**{"mass": 1, "stiffness": 100, name: value}, zeta=0.2, F0=2, Y=0.1)
    for value in ("1 mm", ["1 mm", "2 mm"], 1j, True):
        with pytest.raises(TypeError, match="Y is a number or an array of numbers, in SI"):
            dd.steady_state(**RIG, F0=2, Y=value)
    for wrong, words in [
        ({"Y": 0.1}, "steady_state needs F0"),
        ({"F0": 1}, "steady_state needs Y or force"),
        ({"F0": 1, "Y": 0.1, "force": 1}, "one of Y and force"),
        ({"F0": 1, "Y": 0.1, "zeta": 0.2}, "one of damping and zeta"),
        ({"F0": 1, "Y": 0.1, "amplitude": 1}, "no parameter 'amplitude'"),
    ]:
        with pytest.raises(TypeError, match=words):
            dd.steady_state(**RIG, **wrong)
    with pytest.raises(TypeError, match="takes a system or Y, not both"):
        dd.steady_state(dd.System(**RIG), Y=0.1)


def test_a_bad_value_is_named_with_its_index():
    Y = np.full(10_000, 0.1)
    Y[7777] = -1
    for name, value, words in [
        ("Y", Y, "'Y[7777]' is out of range\n  allowed: >= 0 m\n  found: -1 m"),
        ("zeta", [0.1, np.nan], "'zeta[1]' is out of range\n  allowed: any finite value\n  found: nan"),
        ("zeta", np.nan, "'zeta' is out of range\n  allowed: any finite value\n  found: nan"),
        ("omega", [[1.0], [0.0]], "'omega[1, 0]' is out of range\n  allowed: > 0 rad/s\n  found: 0 rad/s"),
        ("F0", [1, 3, 0], "'static' is out of range\n  allowed: >= 3 N\n  found: 2 N"),
        ("static", [3, 0.5], "'static[1]' is out of range\n  allowed: >= 1 N\n  found: 0.5 N"),
    ]:
        with pytest.raises(dd.InvalidScenario) as caught:
            dd.steady_state(**{"mass": 1, "stiffness": 100, "zeta": 0.2, "F0": 1, "static": 2, "Y": 0.1, "omega": 1, name: value})
        assert str(caught.value) == "error: " + words
        assert [problem.message for problem in caught.value.diagnostics] == [words.split("\n")[0]]
    with pytest.raises(dd.InvalidScenario, match="'mass.0.'.*\n.*\n.*\n.*'F0.2.'"):
        dd.steady_state(mass=[-1, 1, 1], stiffness=100, zeta=0.2, F0=[1, 1, np.nan], Y=0.1)
    with pytest.raises(dd.InvalidScenario, match="system.damping"):
        dd.steady_state(mass=1, stiffness=1e300, zeta=1e308, F0=1, Y=0.1)


def test_data_frame():
    pandas = pytest.importorskip("pandas")
    frame = dd.steady_state(**RIG, F0=2, Y=[0.1, 0.2]).to_pandas()
    assert isinstance(frame, pandas.DataFrame) and frame["outcome"].tolist() == ["done", "done"]


def test_import_is_quick():
    import subprocess
    import sys

    code = "import time; t = time.perf_counter(); import dualdamp; print(time.perf_counter() - t, 'numpy' in __import__('sys').modules)"
    times = [subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split() for _ in range(3)]
    assert min(float(seconds) for seconds, _ in times) < 0.2
    assert {has_numpy for _, has_numpy in times} == {"False"}
