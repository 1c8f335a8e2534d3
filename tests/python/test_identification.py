"""Identification from files, arrays, dicts and data frames: the same numbers by every way."""

import warnings

import dualdamp as dd
import numpy as np
import pytest

RIG = {"mass": "1.042 kg", "stiffness": "1568 N/m", "frequency": "6.17 Hz"}
FILE = "scenarios/examples/my_rig.csv"


@pytest.fixture
def pairs():
    """Its numbers and the names of its columns."""
    lines = [line for line in open(FILE) if not line.startswith("#")]
    head = lines[0].strip().split(",")
    return np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]]), head


def test_as_the_program(program, tmp_path):
    import json

    status, text, _ = program("identify", FILE, "--mass", "1.042 kg", "--stiffness", "1568 N/m", "--frequency", "6.17 Hz", "--json", "--out", tmp_path)
    found = dd.identify(FILE, **RIG)
    assert found.status == status == 0
    assert found.result == json.loads(text)["result"]
    assert found.answer.zeta == found.result["answer"]["zeta"]
    assert found.estimates[0].interval95.zeta[0] < found.estimates[0].zeta


def test_every_kind_of_columns(pairs):
    methods = ["resonance_least_squares", "den_hartog_fit"]
    expected = dd.identify(FILE, methods=methods, **RIG).result
    numbers, head = pairs
    columns = {name: numbers[:, i] for i, name in enumerate(head)}
    structured = np.rec.fromarrays(list(columns.values()), names=head)
    kinds = [columns, structured]
    try:
        import pandas

        kinds.append(pandas.DataFrame(columns))
    except ImportError:
        pass
    for data in kinds:
        assert dd.identify(data, methods=methods, **RIG).result == expected, type(data)


def test_the_named_index_of_a_data_frame():
    """That of times, as after set_index."""
    pandas = pytest.importorskip("pandas")
    t = np.arange(0.0, 3.0, 0.005)
    columns = {"t [s]": t, "x [mm]": 10.0 * np.exp(-0.3 * t) * np.cos(10.0 * t)}
    rig = {"mass": "1 kg", "stiffness": "100 N/m", "methods": ["output_error"]}
    frame = pandas.DataFrame(columns)
    expected = dd.identify(columns, **rig).result
    assert dd.identify(frame.set_index("t [s]"), **rig).result == expected
    assert dd.identify(frame, **rig).result == expected


def test_a_phase_that_was_not_measured():
    """NaN or None in a column of phases; in another column it is refused."""
    rig = {"mass": "1 kg", "stiffness": "100 N/m"}
    states = [(0.05 + 0.01 * (i % 5), 9.0 + 0.5 * (i // 5)) for i in range(15)]
    found = [dd.steady_state(mass=1, stiffness=100, zeta=0.1, F0=2, Y=Y, omega=omega) for Y, omega in states]
    data = {"Y": [Y for Y, _ in states], "omega [rad/s]": [omega for _, omega in states], "x": [float(state.amplitude) for state in found]}
    phases = [float(state.phase) if i % 3 else None for i, state in enumerate(found)]
    gaps = np.array(phases, dtype=float)
    answers = [dd.identify({**data, "phase [rad]": column}, methods=["energy_balance"], **rig).estimates[0] for column in (phases, gaps)]
    assert answers[0].zeta == answers[1].zeta == pytest.approx(0.1, rel=0.01)
    assert [left["number"] for left in answers[0].diagnostics.excluded] == [1, 4, 7, 10, 13]
    with pytest.raises(dd.InvalidScenario, match="the field of column phase is not a finite number"):
        dd.identify({**data, "phase [rad]": np.full(15, np.nan)}, **rig)
    with pytest.raises(dd.InvalidScenario, match="the field of column x is not"):
        dd.identify({**data, "x": [None, *data["x"][1:]]}, **rig)


def test_labels_of_sweeps_and_bits(pairs):
    """Texts are labels, numbers keep their bits."""
    numbers, _ = pairs
    data = {"Y": numbers[:, 0] * 1e-3 / 3, "x": numbers[:, 1] * 1e-3 / 3, "sweep": np.array(["a", 'a, "b"'])[np.arange(len(numbers)) % 2]}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.IncompleteResult)
        found = dd.identify(data, methods=["resonance_least_squares"], **RIG)
    Y, x = data["Y"], data["x"]
    slope = np.polyfit(Y, x, 1)[0]
    assert found.estimates[0].zeta == pytest.approx(0.5 / slope, rel=1e-3)


def test_messages_name_the_row_of_an_array():
    with pytest.raises(dd.InvalidScenario, match="data:4") as caught:
        dd.identify({"Y": [0.1, 0.2, np.nan], "x": [0.1, 0.2, 0.3]}, **RIG)
    assert caught.value.diagnostics[0].line == 4


def test_wrong_arguments():
    with pytest.raises(ValueError, match="the columns differ in length: Y 1, x 2"):
        dd.identify({"Y": [1], "x": [1, 2]}, **RIG)
    with pytest.raises(TypeError, match="an array of data needs names"):
        dd.identify(np.zeros((3, 2)), **RIG)
    with pytest.raises(ValueError, match="has 2 dimensions"):
        dd.identify({"Y": np.zeros((3, 2))}, **RIG)
    with pytest.raises(dd.InvalidScenario, match="unknown key 'robst' in 'analysis' with type identify"):
        dd.identify(FILE, robst=True, **RIG)
    with pytest.raises(dd.InvalidScenario, match="frequency"):
        dd.identify(FILE, mass=1.042, stiffness=1568, frequency=6.17)


def test_texts_that_no_file_of_data_holds():
    data = {"Y": [0.1, 0.2], "x": [0.1, 0.2]}
    for name, cells, words in [
        ("sweep", ["up", "up\nand down"], "row 1 of the column 'sweep' has a line break: 'up.nand down'"),
        ("sweep", ["\ud800", "up"], "row 0 of the column 'sweep' has a lone surrogate"),
        ("force\n", [1, 2], "the name of a column has a line break"),
        ("\ud800", [1, 2], "the name of a column has a lone surrogate"),
    ]:
        with pytest.raises(ValueError, match=words):
            dd.identify({**data, name: cells}, **RIG)


def test_no_answer_is_said():
    """A bent line: there is a result, and no answer."""
    Y = np.linspace(0.03, 0.12, 12)
    with pytest.warns(dd.IncompleteResult):
        found = dd.identify({"Y": Y, "x": 2.5 * Y - 0.0637 - 6 * Y**2}, mass=1, stiffness=100, frequency="10 rad/s", methods=["den_hartog_fit"])
    assert found.status == 4 and found.answer is None and found.answer_reason


def test_a_round_trip(rig, drive):
    """Identification of a simulated curve gives the damping and friction of the system."""
    curve = rig.xy_curve(drive.replace(amplitude=None), amplitudes={"from": "0.04 m", "to": "0.2 m", "count": 12, "spacing": "linear"})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.IncompleteResult)
        found = dd.identify(curve.points[["Y", "x"]], mass=1, stiffness=100, frequency="10 rad/s", methods=["den_hartog_fit"])
    assert found.estimates[0].zeta == pytest.approx(0.2, abs=1e-9)
    assert found.estimates[0].F0 == pytest.approx(2, abs=1e-9)


RECORD = "scenarios/examples/free_run.csv"


def test_fit_as_the_program(program, tmp_path):
    import json

    status, text, message = program("fit", "coulomb", RECORD, "--mass", "1 kg", "--stiffness", "1000 N/m", "--no-profile", "--json", "--out", tmp_path)
    assert status == 0, message
    found = dd.fit("coulomb", RECORD, mass="1 kg", stiffness="1000 N/m", profile=False)
    assert found.result == json.loads(text)["result"]
    damping, kinetic = found.result.parameters[:2]
    assert (damping.name, kinetic.name) == ("damping", "kinetic")
    assert kinetic.value == pytest.approx(1, abs=0.01)
    assert dd.run(found.result.scenario).status == 0


def test_fit_of_arrays_and_prediction():
    rig = dd.System(mass="1 kg", stiffness="1000 N/m", damping="1 N.s/m", friction=dd.law("coulomb", kinetic="1 N"))
    records = [rig.simulate(initial={"position": start}, duration="1 s", sample_rate="200 Hz").history[["t", "x"]] for start in ("20 mm", "30 mm")]
    rng = np.random.default_rng(3)
    noisy = [{"t": record["t"], "x": record["x"] + 2e-6 * rng.standard_normal(len(record))} for record in records]
    found = dd.fit({"law": "coulomb"}, noisy[0], mass="1 kg", stiffness="1000 N/m", profile=False)
    assert [row.value for row in found.result.parameters[:2]] == pytest.approx([1, 1], abs=0.01)
    other = dd.predict(found, noisy[1])
    assert other.analysis == "predict" and other.status == 0
    with pytest.raises(TypeError, match="predict takes the result of a fit, not of predict"):
        dd.predict(other, noisy[1])


def test_prediction_by_a_fitted_phase():
    rig = dd.System(mass="1 kg", stiffness="1000 N/m", damping="1 N.s/m", friction=dd.law("coulomb", kinetic="1 N"))
    drives = [{"type": "base_harmonic", "amplitude": Y, "frequency": "4 Hz", "phase": -0.9} for Y in ("5 mm", "8 mm")]
    records = [rig.simulate(drive, duration="1 s", sample_rate="200 Hz").history[["t", "x"]] for drive in drives]
    rng = np.random.default_rng(3)
    first, second = [{"t": record["t"], "x": record["x"] + 2e-6 * rng.standard_normal(len(record))} for record in records]
    found = dd.fit("coulomb", first, mass="1 kg", stiffness="1000 N/m", frequency="4 Hz", amplitude="5 mm", free="phase", profile=False)
    phase = next(row.value for row in found.result.parameters if row.name == "phase")
    with_its_own = dd.predict(found, second, excitation={**drives[1], "phase": phase})
    assert with_its_own.result.validation.error < 1e-3
    repeated = {"t": first["t"], "x": first["x"] + 2e-6 * rng.standard_normal(len(first["t"]))}
    assert dd.predict(found, repeated).result.validation.error < 1e-3  # under the drive of the fit, with the fitted phase


def driven_table(rig, frequencies, column, count=1600, seed=5):
    """A response to forces of several frequencies, or to such a motion of the base, with noise."""
    t = np.arange(count) / 400
    values = sum(np.cos(2 * np.pi * f * t) for f in frequencies) * (2.0 if column == "force" else 2e-3)
    kind = "force_table" if column == "force" else "base_table"
    drive = {"type": kind, "times": t, "values": values, "interpolation": "cubic"}
    x = rig.simulate(drive, duration=f"{t[-1]} s", sample_rate="400 Hz").history["x"]
    return {"t [ms]": 1e3 * t, "x [mm]": 1e3 * (x + 2e-6 * np.random.default_rng(seed).standard_normal(len(x))), column: values}


def test_the_fitted_scenario_of_a_table_in_memory_runs():
    rig = dd.System(mass="1 kg", stiffness="1000 N/m", damping="1 N.s/m", friction=dd.law("coulomb", kinetic="1 N"))
    for column in ("y", "force"):
        table = driven_table(rig, [4.1, 6.3], column)
        found = dd.fit("coulomb", table, mass="1 kg", stiffness="1000 N/m", profile=False, drive=column)
        again = dd.run(found.result.scenario).history["x"]
        assert 1e3 * again == pytest.approx(table["x [mm]"], abs=0.02)
        other = dd.predict(found, driven_table(rig, [3.3, 5.9], column, seed=6), drive=column)
        assert not other.result.validation.wrong and other.result.validation.noise_units < 1.2


def test_a_drive_in_memory_beyond_the_limit_of_a_list(tmp_path):
    """The text says what to do: there, it runs."""
    rig = dd.System(mass="1 kg", stiffness="1000 N/m", damping="1 N.s/m", friction=dd.law("coulomb", kinetic="1 N"))
    table = driven_table(rig, [4.1, 6.3], "y", count=4000)
    table = {name: np.repeat(values, 3) for name, values in table.items()}
    table["t [ms]"] = np.arange(12000) * 1e3 / 1200
    table["y"], table["x [mm]"] = (np.interp(np.arange(12000) / 3, np.arange(4000), values[::3]) for values in (table["y"], table["x [mm]"]))
    found = dd.fit("coulomb", table, mass="1 kg", stiffness="1000 N/m", profile=False, starts=2, out=tmp_path)
    assert any("a scenario lists at most 10000 values of a drive, and this one has 12000" in line for line in found.warnings)
    text = found.result.scenario
    assert text.startswith("# The drive has too many samples for a list: give the fit a directory (out), and run this text beside drive.csv there.\n")
    (tmp_path / "as_said.yaml").write_text(text)
    assert len(dd.run(tmp_path / "as_said.yaml").history["x"]) == 12000


def test_a_table_that_was_fitted_is_no_prediction():
    rig = dd.System(mass="1 kg", stiffness="1000 N/m", damping="1 N.s/m", friction=dd.law("coulomb", kinetic="1 N"))
    table = driven_table(rig, [4.1, 6.3], "y")
    found = dd.fit("coulomb", table, mass="1 kg", stiffness="1000 N/m", profile=False)
    for same in (table, {"t": 1e-3 * table["t [ms]"], "x": 1e-3 * table["x [mm]"], "y": table["y"]}):
        with pytest.raises(dd.InvalidScenario, match="holds readings that were fitted"):
            dd.predict(found, same)


def test_what_is_free_is_a_text_a_list_or_a_tuple():
    found = [dd.fit("coulomb", RECORD, mass="1 kg", stiffness="1000 N/m", damping="1 N.s/m", free=free, profile=False).result.parameters
             for free in ("damping, kinetic", ["damping", "kinetic"], ("damping", "kinetic"))]
    assert found[0] == found[1] == found[2]
    assert {row.name for row in found[0][:2]} == {"damping", "kinetic"}
    pairs = {"Y [mm]": [4.5, 5.0, 5.5, 6.0, 6.5], "x [mm]": [4.70, 7.21, 9.76, 12.25, 14.82]}
    answers = [dd.identify(pairs, methods=methods, **RIG).result for methods in ("resonance_deming,den_hartog_fit", ("resonance_deming", "den_hartog_fit"))]
    assert answers[0] == answers[1]


def test_what_is_said_of_all_records():
    """As the options of the program; what a record itself states goes before it."""
    known = {"mass": "1 kg", "stiffness": "1000 N/m", "profile": False}
    found = dd.fit("coulomb", RECORD, sigma_x="2 um", **known)
    assert found.result == dd.fit("coulomb", RECORD, record={"sigma_x": "2 um"}, sigma_x="5 um", **known).result
    assert found.scenario.analysis.data[0].sigma_x == 2e-6
    with pytest.raises(TypeError, match="predict has no option 'sigma_y'; of records it takes: drive, loop"):
        dd.predict(found, RECORD, sigma_y="2 um")


def test_sweep_is_a_key_of_the_scenario(rig, drive):
    scenario = {"system": rig, "excitation": drive, "analysis": {"type": "steady_state"}, "sweep": {"excitation.amplitude": [0.1, 0.2]}}
    result = dd.run(scenario)
    assert [row.result.amplitude for row in result.result.sweep] == [rig.steady_state(drive.replace(amplitude=Y)).amplitude for Y in (0.1, 0.2)]
