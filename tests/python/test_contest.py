"""Methods written in Python in the benchmark: cases as exported, scores as of the program."""

import shutil
import warnings

import dualdamp as dd
import numpy as np
import pytest

SMALL = "scenarios/stress/small.yaml"
INSIDE = "resonance_least_squares"


def again(case):
    """A method of the program by way of the package."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.IncompleteResult)
        found = case.identify(methods=[INSIDE])
    estimate = found.result.estimates[0]
    if estimate.get("zeta") is None:
        return None
    interval = estimate.get("interval95") or {}
    ends = {f"{name}_{end}": limit for name in ("zeta", "F0") if interval.get(name) for end, limit in zip(("low", "high"), interval[name])}
    lack = estimate.diagnostics.lack_of_fit
    return {"zeta": estimate.zeta, "F0": estimate.F0, **ends, "p_value": lack.p_value, "usable": not lack.fired}


def test_a_truth_may_be_a_number():
    from dualdamp._contest import _row

    assert [_row(1, {"usable": value})[-1] for value in (1, 0, 1.0, np.int64(1), np.bool_(False), True, None)] == ["yes", "no", "yes", "yes", "no", "yes", ""]
    assert [_row(1, {"usable": word})[-1] for word in ("yes", "no")] == ["yes", "no"]
    assert _row(1, {"zeta": 1, "F0": float("nan")})[1:3] == ["1.0", ""]


def test_a_method_of_the_program_scores_as_itself():
    """In each cell of the campaign: two records of each tell as much as four, since the scores are the same numbers."""
    changes = {"analysis.seeds": 2, "expect": [{"value": "cases.all", "equals": 20}]}
    scored = dd.benchmark(SMALL, {"again": again}, changes=changes, seed=11)
    inside, outside = ({k: v for k, v in row.items() if k != "method"} for name in (INSIDE, "again") for row in scored.result.ranking if row.method == name)
    assert inside == outside


def test_the_export_of_the_program(program, tmp_path):
    assert dd.stress_export(SMALL, tmp_path / "here", seed=7) == 40
    assert program("stress", "export", SMALL, "--seed", 7, "--out", tmp_path / "there")[0] == 0
    files = sorted(path.relative_to(tmp_path / "here") for path in (tmp_path / "here").rglob("*.*"))
    assert len(files) == 42
    for file in files:
        assert (tmp_path / "here" / file).read_bytes() == (tmp_path / "there" / file).read_bytes()
    cases = list(dd.cases(tmp_path / "here"))
    assert [case.number for case in cases] == list(range(1, 41))
    assert cases[0].record.dtype.names[:2] == ("Y", "x")
    text = np.genfromtxt(tmp_path / "here/cases/000003.csv", delimiter=",", skip_header=1)
    assert np.array_equal(cases[2].record["x"], text[:, 1])
    assert cases[0].decay is None and cases[0].random is None


def test_cases_with_decays(tmp_path):
    changes = {"analysis.decay": {"displacement": "20 mm", "peaks": 6}, "analysis.seeds": 1}
    dd.stress_export(SMALL, tmp_path, seed=7, changes=changes)  # of another seed the first may be a contact, which stiffens as it dies
    case = next(dd.cases(tmp_path))
    assert case.decay.dtype.names == ("t", "x") and np.ptp(np.diff(case.decay["t"])) < 0.02


def test_answers_from_a_file_and_from_columns(tmp_path):
    dd.stress_export(SMALL, tmp_path, seed=7)
    numbers = np.arange(1, 41)
    columns = {"case": numbers, "zeta": numbers / 400, "F0": np.full(40, 4.0), "usable": numbers > 20}
    (tmp_path / "answers.csv").write_text("case,zeta,F0,usable\n" + "".join(f"{n},{n / 400},4,{'yes' if n > 20 else 'no'}\n" for n in numbers))
    scored = dd.stress_score(SMALL, tmp_path / "key.json", {"file": tmp_path / "answers.csv", "columns": columns}, out=tmp_path / "out")
    rows = {row.method: {k: v for k, v in row.items() if k != "method"} for row in scored.result.ranking}
    assert rows["file"] == rows["columns"]
    assert (tmp_path / "out/ranking.csv").exists()


@pytest.mark.parametrize(
    "answer, error, message",
    [
        ({"beta": 1}, TypeError, "has no 'beta'"),
        (3, TypeError, "a mapping or None, not int"),
        ({"zeta": "much"}, dd.InvalidScenario, "case 1: 'zeta' is no number: 'much'"),
        ({"zeta": True}, dd.InvalidScenario, "case 1: 'zeta' is no number: True"),
        ({"F0": float("inf")}, dd.InvalidScenario, "case 1: 'F0' is out of range: inf"),
        ({"zeta_low": 0.1}, dd.InvalidScenario, "case 1: the interval of 'zeta' has one end"),
        ({"F0_low": 3, "F0_high": 2}, dd.InvalidScenario, "case 1: the interval of 'F0' ends below its start: 3.0 > 2.0"),
        ({"p_value": 2}, dd.InvalidScenario, "case 1: 'p_value' is out of range: 2.0"),
        ({"usable": 2}, dd.InvalidScenario, "case 1: 'usable' is True, False, 'yes' or 'no', not 2"),
        ({"usable": float("nan")}, dd.InvalidScenario, "case 1: 'usable' is True, False, 'yes' or 'no', not nan"),
    ],
)
def test_an_invalid_answer_ends_the_benchmark_at_its_case(answer, error, message):
    with pytest.raises(error, match=message) as caught:
        dd.benchmark(SMALL, {"mine": lambda case: answer}, seed=1)
    assert caught.value.__notes__ == ["in case 1 of the method 'mine'"]


def test_a_case_through_resonance_is_identified_at_its_own_frequencies(tmp_path):
    dd.stress_export("scenarios/stress/response.yaml", tmp_path, seed=7, changes={"analysis.laws": ["detuning"], "analysis.severities": [0.01]})
    case = next(dd.cases(tmp_path))
    assert np.ptp(case.record["omega"]) > 1
    found = case.identify(methods=["receptance"])
    assert found.result.estimates[0].zeta > 0


def test_a_case_without_readings_is_an_empty_record(tmp_path):
    changes = {"analysis.rigs": {"count": 2, "friction_ratio": {"from": 0.5, "to": 1.5}}, "analysis.laws": ["dahl"], "analysis.seeds": 1}
    dd.stress_export(SMALL, tmp_path, seed=7, changes=changes)
    lengths = [len(case.record) for case in dd.cases(tmp_path)]
    assert 0 in lengths and 5 in lengths


def test_an_earlier_export_is_removed_only_on_demand(tmp_path):
    dd.stress_export(SMALL, tmp_path, seed=7, changes={"analysis.decay": {"displacement": "20 mm", "peaks": 6}})
    with pytest.raises(dd.OutputError, match="holds an earlier export"):
        dd.stress_export(SMALL, tmp_path, seed=8)
    dd.stress_export(SMALL, tmp_path, seed=8, overwrite=True)
    assert all(case.decay is None for case in dd.cases(tmp_path))
    assert not list(tmp_path.rglob("*~"))
    (tmp_path / "key.json").write_text("mine")
    with pytest.warns(UserWarning, match="key.json that was there is kept as"):
        dd.stress_export(SMALL, tmp_path, seed=8, overwrite=True)


def test_refusals(tmp_path):
    with pytest.raises(TypeError, match="methods need names"):
        dd.benchmark(SMALL, {"": lambda case: None})
    with pytest.raises(dd.InvalidScenario, match="asks for no stress test"):
        dd.benchmark("scenarios/examples/coulomb.yaml", {})
    with pytest.raises(TypeError, match="methods need names"):
        dd.benchmark(SMALL, {"\ud800": lambda case: None})
    called = []
    with pytest.raises(dd.InvalidScenario, match=f"^two entries have the same name: '{INSIDE}' is a method of the program"):
        dd.benchmark(SMALL, {"mine": called.append, INSIDE: called.append})
    assert not called
    dd.stress_export(SMALL, tmp_path, seed=7)
    with pytest.raises(dd.InvalidScenario, match="that of another stress test"):
        dd.stress_score(SMALL, tmp_path / "key.json", {}, changes={"analysis.seeds": 5})
    for name in (INSIDE, "mine"):  # names of files need not be UTF-8
        with pytest.raises(dd.InvalidScenario, match="two entries" if name == INSIDE else "cannot be opened"):
            dd.stress_score(SMALL, tmp_path / "key.json", {name: tmp_path / "\udc80"})
    with pytest.raises(dd.InvalidScenario, match="analysis.seed"):
        dd.stress_export(SMALL, tmp_path, seed=-1)


def test_next_as_the_program(program, tmp_path):
    import json

    laws = "asymmetry, base_distortion, bouc_wen, contact_compliance, dahl, elasto_plastic, film_beside_damper, free_play, friction_lag"
    laws += ", generalized_maxwell_slip, iwan, lugre, normal_vibration, partial_play, reset_integrator, static_friction, wide_stribeck"
    shutil.copy("scenarios/examples/my_rig.csv", tmp_path)
    (tmp_path / "mine.yaml").write_text(f"""schema: dualdamp/1
system: {{mass: 1.042 kg, stiffness: 1568 N/m}}
excitation: {{type: base_harmonic, frequency: 6.17 Hz}}
analysis: {{type: design, data: my_rig.csv, sigma_x: 5 um, without: "{laws}"}}
""")
    status, text, _ = program("next", tmp_path / "mine.yaml", "--json", "--out", tmp_path / "results")
    assert status == 0
    known = {"mass": "1.042 kg", "stiffness": "1568 N/m", "frequency": "6.17 Hz", "sigma_x": "5 um", "without": laws}
    assert dd.next("scenarios/examples/my_rig.csv", **known).result == json.loads(text)["result"]
    with pytest.raises(dd.InvalidScenario, match="these are a free vibration"):
        dd.next("scenarios/examples/free_run.csv", mass=1.0, stiffness=1000.0)
