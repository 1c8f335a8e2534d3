"""Results, their attributes, arrays, pickles, files and charts."""

import copy
import json
import pickle

import dualdamp as dd
import numpy as np
import pytest

CURVE = "scenarios/examples/xy_curve.yaml"


def test_the_three_forms_of_a_scenario(rig, drive):
    as_dict = {"system": rig, "excitation": drive, "analysis": {"type": "steady_state"}}
    as_text = """
schema: dualdamp/1
system: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: {law: coulomb, kinetic: 2 N}}
excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}
analysis: {type: steady_state}
"""
    results = [dd.run(as_dict), dd.run(as_text), rig.steady_state(drive)]
    assert len({result.amplitude for result in results}) == 1
    assert results[0].result == results[1].result


def test_attributes_are_the_result(rig, drive):
    result = rig.steady_state(drive)
    assert result.amplitude == result.result["amplitude"] == result.result.amplitude
    assert result.energy.input == pytest.approx(result.energy.friction + result.energy.viscous)
    assert result.scenario.system.mass == 1
    with pytest.raises(AttributeError, match="a result of steady_state has no 'amplitud'; it has: peak, trough, amplitude"):
        result.amplitud
    assert "orbit" in dir(result)


def test_tables_are_structured_arrays():
    result = dd.run(CURVE)
    points = result.points
    assert points is result.tables["curve"] or np.array_equal(points, result.tables["curve"])
    assert [row["x"] for row in result.result["points"]] == points["x"].tolist()
    assert points.dtype["stops"] == np.int64 and points.dtype["stable"] == np.bool_
    assert result.units["curve"]["Y"] == "m"


def test_a_missing_number_is_nan():
    result = dd.run(
        {
            "system": {"mass": 1, "stiffness": 100, "damping": 0, "friction": {"law": "coulomb", "kinetic": 2}},
            "excitation": {"type": "base_harmonic", "frequency": "natural"},
            "analysis": {"type": "xy_curve", "amplitudes": [0.001, 0.1]},
        }
    )
    points = result.points
    assert np.isfinite(points["x"][0]) and np.isnan(points["x"][1])
    assert points["reason"][0] == "" and "grow" in points["reason"][1]
    assert points.dtype["stops"].kind == "f"


def test_columns_are_not_copied():
    result = dd.run(CURVE)
    column = result.columns("curve")["x"]
    assert not column.flags.owndata and not column.flags.writeable
    assert np.array_equal(column, result.points["x"])
    del result
    assert np.isfinite(column).all()  # the column keeps the memory of the result
    with pytest.raises(KeyError, match="there is no table 'nothing'; there are: curve"):
        dd.run(CURVE).columns("nothing")


def test_history_of_a_simulation(rig, drive):
    result = rig.simulate(drive, cycles=2, sample_rate="1 kHz")
    assert result.history["t"][1] == pytest.approx(1e-3)
    assert set(result.events["kind"]) <= {"reversal", "stop", "release", "grazing", "switching"}
    last = result.history[-1]
    assert result.final.x == pytest.approx(last["x"] + last["v"] * (result.final.t - last["t"]), abs=1e-4)


def test_changes_are_laid_over(rig, drive):
    scenario = {"system": rig, "excitation": drive, "analysis": {"type": "steady_state"}}
    changed = dd.run(scenario, {"system.friction.kinetic": "1 N", "excitation.amplitude": np.float64(0.2)})
    assert changed.scenario.system.friction.kinetic == 1
    assert changed.amplitude == rig.replace(friction=dd.law("coulomb", kinetic=1)).steady_state(drive.replace(amplitude=0.2)).amplitude
    assert changed.document.provenance.set == ["system.friction.kinetic=\"1 N\"", "excitation.amplitude=0.2"]


def test_verification():
    assert dd.run(CURVE, verify=True).document.verification.agrees


def test_pickles_and_copies(rig, drive, tmp_path):
    result = dd.run(CURVE)
    stored = pickle.loads(pickle.dumps(result))
    assert stored.document == result.document
    assert np.array_equal(stored.points, result.points)
    assert (stored.status, stored.analysis, stored.scenario) == (0, "xy_curve", result.scenario)
    stored.save(tmp_path)
    written = json.loads((tmp_path / "result.json").read_text())
    assert list(written["provenance"].pop("tables")) == ["curve.csv"]
    assert written == result.document
    assert pickle.loads(pickle.dumps(stored)).units == result.units
    assert copy.deepcopy(result) is result


def test_saved_files_are_those_of_the_program(program, tmp_path):
    dd.run(CURVE, out=tmp_path / "here")
    program("run", CURVE, "--out", tmp_path / "there", "--quiet")
    assert sorted(path.name for path in (tmp_path / "here").iterdir()) == sorted(path.name for path in (tmp_path / "there").iterdir())
    tables = [(tmp_path / place / "curve.csv").read_text().splitlines() for place in ("here", "there")]
    assert [line for line in tables[0] if line[0] != "#"] == [line for line in tables[1] if line[0] != "#"]


def test_the_page_in_a_notebook():
    result = dd.run(CURVE)
    page = result.report()
    assert page.startswith("<!DOCTYPE html>") and '"analysis":"xy_curve"' in page
    assert result._repr_html_().startswith('<iframe srcdoc="&lt;!DOCTYPE html&gt;')


def test_data_frame():
    pandas = pytest.importorskip("pandas")
    result = dd.run(CURVE)
    frame = result.to_pandas()
    assert isinstance(frame, pandas.DataFrame)
    assert frame["x"].tolist() == result.points["x"].tolist()
    assert frame.attrs["units"]["x"] == "m"


def test_chart():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    ax = dd.run(CURVE).plot()
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("Y [mm]", "x [mm]")
    assert np.array_equal(ax.lines[0].get_ydata(), 1e3 * dd.run(CURVE).points["x"])
    stored = pickle.loads(pickle.dumps(dd.run(CURVE))).plot()
    assert (stored.get_xlabel(), stored.get_ylabel()) == ("Y [mm]", "x [mm]")
    with pytest.raises(ValueError, match="has no table 'nothing'; tables: curve"):
        dd.run(CURVE).plot("nothing")


def test_representation(rig, drive):
    assert repr(dd.run(CURVE)) == "<dualdamp xy_curve: curve: 91 rows>"
    assert "amplitude=0.186078" in repr(rig.steady_state(drive))


def test_a_campaign_reports_its_progress(tmp_path):
    seen = []
    result = dd.run("scenarios/stress/small.yaml", progress=lambda done, of: seen.append((done, of)), out=tmp_path)
    assert seen[-1][0] == seen[-1][1] > 0
    assert (tmp_path / "cases.jsonl").is_file()
    assert len(result.ranking) > 0


def test_cases_of_an_earlier_run(tmp_path):
    first = dd.run("scenarios/stress/small.yaml", out=tmp_path)
    assert dd.run("scenarios/stress/small.yaml", out=tmp_path, resume=True).result.cases == first.result.cases
    another = ("scenarios/stress/small.yaml", {"analysis.seeds": 3, "expect": [{"value": "cases.all", "equals": 30}]})
    with pytest.raises(dd.DualdampError, match="of another campaign: overwrite=True begins anew, another out keeps them apart"):
        dd.run(*another, out=tmp_path)
    assert dd.run(*another, out=tmp_path, overwrite=True).result.cases.failed == 0


def test_a_campaign_without_a_directory_leaves_nothing(tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    dd.run("scenarios/stress/small.yaml")
    assert list(tmp_path.iterdir()) == []


def test_an_error_in_the_callback_ends_the_run(tmp_path):
    def refuse(done, of):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        dd.run("scenarios/stress/small.yaml", progress=refuse)
    assert dd.run(CURVE).status == 0  # the next run is not cancelled
