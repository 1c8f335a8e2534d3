"""Odd but legitimate arguments give the right answer, all others a clear exception: nothing is taken for something else, nothing is ignored."""

import copy
import multiprocessing
import os
import threading

import dualdamp as dd
import numpy as np
import pytest

RIG = {"mass": 1.0, "stiffness": 100.0, "zeta": 0.2}
KNOWN = {"mass": "1.042 kg", "stiffness": "1568 N/m", "frequency": "6.17 Hz"}
PAIRS = {"Y [mm]": np.array([4.5, 5.0, 5.5, 6.0, 6.5]), "x [mm]": np.array([4.70, 7.21, 9.76, 12.25, 14.82])}
CURVE = "scenarios/examples/xy_curve.yaml"


def test_numpy_2_needs_a_pybind11_that_knows_it(monkeypatch):
    """An older one gave the first row of a table in every row."""
    import importlib

    from dualdamp import _arguments

    monkeypatch.setattr(np, "__version__", "2.4.6")
    monkeypatch.setattr(_arguments.core, "knows_numpy_2", False)
    with pytest.raises(ImportError, match="pybind11 older than 2.12"):
        importlib.reload(_arguments)
    monkeypatch.setattr(_arguments.core, "knows_numpy_2", True)
    importlib.reload(_arguments)


@pytest.fixture
def scenario(rig, drive):
    return {"system": rig, "excitation": drive, "analysis": {"type": "steady_state"}}


@pytest.mark.parametrize("mass, stiffness", [(10, 100), (3, 7), (120, 120)])
@pytest.mark.parametrize("kind", ["int8", "uint8", "int16", "float16", "float32", ">f8", "longdouble"])
def test_numbers_of_every_kind_are_computed_in_double_precision(kind, mass, stiffness):
    """m k would overflow in a byte, and zeta be rounded in single precision."""
    expected = dd.steady_state(mass=float(mass), stiffness=float(stiffness), zeta=0.25, F0=0.5, Y=0.125).amplitude
    kind = np.dtype(kind)
    scalars = dd.steady_state(mass=kind.type(mass), stiffness=kind.type(stiffness), zeta=0.25, F0=np.float32(0.5), Y=0.125)
    arrays = dd.steady_state(mass=np.array([mass], kind), stiffness=np.array([stiffness], kind), zeta=np.float16([0.25]), F0=0.5, Y=0.125)
    assert scalars.amplitude == arrays.amplitude[0] == expected


def test_layouts_of_memory():
    F0 = np.arange(6.0).reshape(2, 3) / 4
    expected = dd.steady_state(**RIG, F0=F0, Y=0.1).peak
    frozen = F0.copy()
    frozen.setflags(write=False)
    for same in (np.asfortranarray(F0), frozen, np.repeat(F0, 2, axis=1)[:, ::2], F0.tolist()):
        assert np.array_equal(dd.steady_state(**RIG, F0=same, Y=0.1).peak, expected)
    assert np.array_equal(dd.steady_state(**RIG, F0=F0[:, ::-1], Y=0.1).peak[:, ::-1], expected)
    assert type(dd.steady_state(**RIG, F0=np.array(2.0), Y=np.array(0.1)).amplitude) is float


def test_masked_values_are_not_taken_for_numbers():
    hidden = np.ma.array(PAIRS["x [mm]"], mask=[0, 0, 0, 0, 1])
    with pytest.raises(ValueError, match="F0 has masked values"):
        dd.steady_state(**RIG, F0=np.ma.array([1.0, 2.0], mask=[0, 1]), Y=0.1)
    for call in (dd.identify, dd.next):
        with pytest.raises(ValueError, match=r"the column 'x \[mm\]' has masked values"):
            call({**PAIRS, "x [mm]": hidden}, **KNOWN)
    with pytest.raises(TypeError, match="masked value"):
        dd.System(mass=1, stiffness=100, damping=4).xy_curve(dd.excitation("base_harmonic", frequency="1 Hz"), amplitudes=hidden)
    nothing_hidden = np.ma.array(PAIRS["x [mm]"], mask=False)
    hidden_and_plain = [dd.identify({**PAIRS, "x [mm]": x}, methods=["resonance_least_squares"], **KNOWN) for x in (nothing_hidden, PAIRS["x [mm]"])]
    assert hidden_and_plain[0].answer == hidden_and_plain[1].answer


def test_more_entries_than_can_be_counted():
    ones = [np.ones((65536,) + (1,) * i) for i in range(4)]
    with pytest.raises(ValueError, match="more entries than can be counted"):
        dd.steady_state(mass=ones[0], stiffness=100.0, damping=ones[1], F0=ones[2], Y=ones[3], omega=10.0)


@pytest.mark.parametrize(
    "arguments, words",
    [
        ({"threads": -1}, "0 .all cores. to 1024, not -1"),
        ({"threads": 2000}, "to 1024, not 2000"),
        ({"threads": 1.5}, "a whole number, not 1.5"),
        ({"threads": None}, "a whole number, not None"),
        ({"progress": 3}, "progress is True, False or a function of .done, all., not 3"),
        ({"out": ""}, "out is empty"),
        ({"out": "a\0b"}, "out holds a null character"),
        ({"resume": True}, "none is given"),
        ({"overwrite": True}, "for a stress test or a sweep; this scenario is neither"),
        ({"resume": True, "out": "nowhere"}, "for a stress test or a sweep; this scenario is neither"),
        ({"resume": True, "overwrite": True, "out": "nowhere"}, "one of resume and overwrite"),
        ({"changes": ["system.mass=2 kg"]}, "changes are a dict"),
        ({"changes": {"title": "\ud800"}}, "surrogates not allowed"),
        ({"changes": {"system.friction": None}}, "holds no None here"),
    ],
)
def test_arguments_of_a_run_that_mean_nothing(scenario, arguments, words):
    with pytest.raises((TypeError, ValueError), match=words):
        dd.run(scenario, **arguments)
    assert not os.path.exists("nowhere")


@pytest.mark.parametrize("words, part", [("surrogates not allowed", {"title": "\ud800"}), ("holds itself", {})])
def test_dicts_that_no_text_can_hold(scenario, words, part):
    broken = {**scenario, **part}
    if not part:
        broken["numerics"] = broken
    with pytest.raises(dd.InvalidScenario, match=words):
        dd.run(broken)


def test_columns_with_different_indexes():
    """They would be paired by position: the damping ratio was 0.72 instead of 0.099."""
    pandas = pytest.importorskip("pandas")
    Y, x = (pandas.Series(PAIRS[name]) for name in ("Y [mm]", "x [mm]"))
    with pytest.raises(ValueError, match="Series with different indexes"):
        dd.identify({"Y [mm]": Y, "x [mm]": x[::-1]}, **KNOWN)
    with pytest.raises(ValueError, match="'F0' and 'Y' are Series with different indexes"):
        dd.steady_state(**RIG, F0=x, Y=Y[::-1])


def test_threads_of_a_batch():
    assert dd.steady_state(**RIG, F0=[2, 1], Y=0.1, threads=np.int64(1)).shape == (2,)
    for threads in (-1, 2000, 1.5):
        with pytest.raises((TypeError, ValueError), match="threads is"):
            dd.steady_state(**RIG, F0=[2, 1], Y=0.1, threads=threads)


def test_no_argument_is_ignored(rig, drive):
    with pytest.raises(TypeError, match="takes an excitation with a system"):
        dd.steady_state(None, drive, **RIG, F0=2, Y=0.1)
    with pytest.raises(TypeError, match="a system or damper_to, not both"):
        dd.steady_state(rig, drive, damper_to="base")
    with pytest.raises(TypeError, match="steady_state has no option 'type'"):
        rig.steady_state(drive, type="simulate")
    with pytest.raises(TypeError, match="identify has no option 'type'"):
        dd.identify(PAIRS, type="fit", **KNOWN)
    record = rig.simulate(initial={"position": "0.3 m"}, duration="1 s", sample_rate="100 Hz").history[["t", "x"]]
    known = {"mass": 1, "stiffness": 100, "profile": False}
    for wrong in ({"amplitude": "5 mm"}, {"excitation": drive, "frequency": "2 Hz"}, {"excitation": drive, "amplitude": "2 mm"}):
        with pytest.raises(TypeError, match="state these or an excitation"):
            dd.fit("coulomb", record, **known, **wrong)
    with pytest.raises(TypeError, match="'record' is a mapping"):
        dd.fit("coulomb", record, record="sigma_x", **known)
    with pytest.raises(ValueError, match="there are 1 records, and 'record' says something of 2"):
        dd.fit("coulomb", record, record=[{}, {}], **known)
    with pytest.raises(TypeError, match="predict takes the result of a fit, not of 3"):
        dd.predict(3, record)


def test_what_is_said_of_each_record(rig):
    starts = ["0.3 m", "0.4 m", "0.5 m"]
    record, second, third = (rig.simulate(initial={"position": start}, duration="1 s", sample_rate="100 Hz").history[["t", "x"]] for start in starts)
    in_mm, kept = ({"t": one["t"], "x": 1e3 * one["x"]} for one in (second, third))
    known = {"mass": 1, "stiffness": 100, "profile": False}
    found = dd.fit("coulomb", [record, in_mm], validate=kept, record=[None, {"units": {"x": "mm"}}, {"units": {"x": "mm"}}], **known)
    assert [row.value for row in found.result.parameters[:2]] == pytest.approx([4, 2], rel=1e-3)
    assert [entry.get("units") for entry in found.scenario.analysis.data] == [None, {"x": "mm"}]
    assert found.scenario.analysis.validate[0].units == {"x": "mm"}


def test_equal_parts_have_equal_hashes():
    """Also with other types of numbers, and with the keys in another order."""
    systems = [
        dd.System(mass=1, stiffness=100, damping=0, friction=dd.law("coulomb", kinetic=2)),
        dd.System(mass=1.0, stiffness=np.float64(100), damping=0.0, friction=dd.law("coulomb", kinetic=2.0)),
        dd.System(friction={"kinetic": 2, "law": "coulomb"}, damping=0, stiffness=100, mass=1),
    ]
    drives = [dd.excitation("base_table", times=[0, 1], values=[0, 1]), dd.excitation("base_table", values=(0.0, 1.0), times=(0.0, 1.0))]
    for parts in (systems, drives):
        assert all(part == parts[0] for part in parts)
        assert len(set(parts)) == 1
    assert len({*systems, systems[0].replace(mass=2)}) == 2


def test_parts_do_not_change():
    friction = {"law": "coulomb", "kinetic": "2 N"}
    rig = dd.System(mass=1, stiffness=100, damping=4, friction=friction)
    friction["kinetic"] = "9 N"
    rig.to_dict()["friction"]["kinetic"] = "9 N"
    rig.friction["kinetic"] = "9 N"
    assert rig.friction == {"law": "coulomb", "kinetic": "2 N"}
    assert copy.deepcopy(rig) == rig


@pytest.mark.parametrize("value", [True, "5", None, object()])
def test_a_quantity_is_made_of_numbers(value):
    with pytest.raises(TypeError):
        dd.quantity(value, "Hz")


def test_the_text_that_check_returns_runs(scenario):
    assert dd.run(dd.check(scenario)).amplitude == dd.run(scenario).amplitude


def test_names_of_files(tmp_path):
    for name in ("scenarios/examples/xy_curve.yaml\0.bak", ""):
        with pytest.raises(ValueError, match="the name of a scenario"):
            dd.run(name)
    odd = os.fsdecode(os.fsencode(tmp_path) + b"/gr\xf6\xdfe \xc3\xa4")  # the first word is no UTF-8
    dd.run(CURVE, out=odd)
    dd.run(CURVE).save(odd)
    assert os.path.isfile(odd + "/curve.csv")
    with pytest.raises(dd.InvalidScenario, match="result.json"):
        dd.run(odd + "/result.json")


def test_progress_of_a_batch():
    seen = []
    count = 300_000
    dd.steady_state(**RIG, F0=2, Y=np.full(count, 0.1), progress=lambda done, of: seen.append((done, of)))
    assert len(seen) > 1 and seen[-1] == (count, count) and seen == sorted(seen)
    assert dd.steady_state(**RIG, F0=2, Y=0.1, progress=False).stops == 0

    def refuse(done, of):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        dd.steady_state(**RIG, F0=2, Y=np.full(count, 0.1), progress=refuse)


def test_a_bar_or_a_line(capfd, rig, drive):
    dd.steady_state(**RIG, F0=2, Y=np.full(300_000, 0.1), progress=True)
    assert "300" in capfd.readouterr().err
    assert rig.steady_state(drive, progress=True).status == 0


def test_an_error_in_a_callback_ends_its_own_run_alone(rig, drive):
    """Another thread's run goes on, and nobody has pressed Ctrl-C."""
    slow = rig.replace(friction=dd.law("lugre", kinetic=2, stribeck_velocity="1 mm/s", sigma0=1e5, sigma1=300))
    ended = {}

    def run_long():
        try:
            ended["long"] = len(slow.xy_curve(drive.replace(amplitude=None), amplitudes=np.linspace(0.05, 0.3, 40)).points)
        except BaseException as error:
            ended["long"] = repr(error)

    def refuse(done, of):
        raise RuntimeError("enough")

    thread = threading.Thread(target=run_long)
    thread.start()
    with pytest.raises(RuntimeError, match="enough"):
        dd.run("scenarios/stress/small.yaml", progress=refuse)
    times = 0
    while thread.is_alive():
        with pytest.raises(RuntimeError, match="enough"):
            dd.steady_state(**RIG, F0=2, Y=np.full(300_000, 0.1), progress=refuse)
        times += 1
    thread.join()
    assert times > 1 and ended == {"long": 40}


def sums(Y):
    curve = dd.System(mass=1, stiffness=100, damping=4, friction=dd.law("coulomb", kinetic=2)).xy_curve(
        dd.excitation("base_harmonic", frequency="natural"), amplitudes=[Y, 0.3]
    )
    return dd.steady_state(**RIG, F0=np.linspace(0, 2, 3000), Y=Y).peak.sum(), curve.points["x"].sum()


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes(method):
    """Also a child of a process whose threads have computed already."""
    expected = [sums(Y) for Y in (0.1, 0.2)]
    with multiprocessing.get_context(method).Pool(2) as pool:
        assert pool.map_async(sums, [0.1, 0.2]).get(timeout=120) == expected


def test_threads():
    expected = [sums(0.1 + 0.01 * i) for i in range(8)]
    found = [None] * 8

    def work(i):
        found[i] = sums(0.1 + 0.01 * i)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == expected
