"""Friction laws written in Python and compiled from C: the numbers of the built-in law with the same formula."""

import math
import shutil
import subprocess
import tempfile
import threading

import dualdamp as dd
import pytest
from dualdamp import _python_laws

RIG = {"mass": "1 kg", "stiffness": "100 N/m", "damping": "4 N.s/m"}
VALUES = {"limit": "2 N", "stiffness": "2000 N/m"}


def dahl_class():
    """Dahl's law, the program's `dahl` with exponent 1: F = stiffness z, z' = v - stiffness |v| z/limit."""

    class python_dahl:
        """Dahl's law in Python."""

        equation = "F = k z; z' = v - k |v| z/limit"
        states = 1
        parameters = {
            "limit": dd.parameter("N", "force limit", above=0, is_limit=True),
            "stiffness": dd.parameter("N/m", "stiffness of the bristles", above=0),
            "bias": dd.parameter("N", "constant force", default=0.0),
        }

        def __init__(self, limit, stiffness, bias):
            if bias > limit:
                raise ValueError("a bias above the limit moves the mass by itself")
            self.limit, self.stiffness, self.bias = limit, stiffness, bias

        def scales(self):
            return [self.limit / self.stiffness]

        def respond(self, now, states):
            (z,) = states
            force = self.stiffness * z
            return force + self.bias, [now.v - now.direction * now.v * force / now.limit(self.limit)]

    return python_dahl


def dahl():
    return dd.law("dahl", kinetic="2 N", sigma0="2000 N/m")


def test_layout_is_that_of_the_header(tmp_path):
    """Sizes and offsets as the C compiler has them."""
    compiler = shutil.which("cc") or pytest.skip("there is no C compiler")
    structures = {"dualdamp_instant": _python_laws.Instant, "dualdamp_parameter": _python_laws._Parameter, "dualdamp_law_table": _python_laws._Table}
    lines = [f'printf("%zu\\n", sizeof(struct {name}));' for name in structures]
    expected = [_python_laws.c.sizeof(kind) for kind in structures.values()]
    for name, kind in structures.items():
        for field in kind._fields_:
            lines.append(f'printf("%zu\\n", offsetof(struct {name}, {field[0]}));')
            expected.append(getattr(kind, field[0]).offset)
    (tmp_path / "layout.c").write_text('#include <stddef.h>\n#include <stdio.h>\n#include "dualdamp_law.h"\nint main(void) {' + "\n".join(lines) + "return 0; }")
    subprocess.run([compiler, f"-I{dd.include_directory()}", "layout.c", "-o", "layout"], cwd=tmp_path, check=True)
    found = subprocess.run([tmp_path / "layout"], capture_output=True, text=True, check=True).stdout.split()
    assert [int(number) for number in found] == expected


def test_a_law_of_python_moves_as_the_built_in_one(drive):
    dd.friction_law(dahl_class())
    assert "python_dahl" in dd.laws and "\nbias : " in dd.laws.python_dahl.__doc__
    ours = dd.System(**RIG, friction=dd.law("python_dahl", **VALUES)).steady_state(drive)
    theirs = dd.System(**RIG, friction=dahl()).steady_state(drive)
    assert ours.amplitude == pytest.approx(theirs.amplitude, rel=1e-9)
    assert ours.phase == pytest.approx(theirs.phase, rel=1e-9)
    (plugin,) = ours.document.provenance.plugins
    assert plugin.law == "python_dahl" and plugin.file.endswith("test_laws.py")


def test_threads_call_a_law_of_python(drive):
    """A curve is computed by several threads, which take the interpreter's lock in turn."""
    dd.friction_law(dahl_class())
    amplitudes = [0.05, 0.1, 0.15, 0.2]
    ours = dd.System(**RIG, friction=dd.law("python_dahl", **VALUES)).xy_curve(drive.replace(amplitude=None), amplitudes=amplitudes)
    theirs = dd.System(**RIG, friction=dahl()).xy_curve(drive.replace(amplitude=None), amplitudes=amplitudes)
    assert ours.points["x"] == pytest.approx(theirs.points["x"], rel=1e-9)


def test_modifiers_act_on_a_law_of_python(drive):
    dd.friction_law(dahl_class())
    rig = dd.System(**RIG, friction=dd.law("python_dahl", **VALUES, drift="0.01 1/s"))
    theirs = dd.System(**RIG, friction=dahl().replace(drift="0.01 1/s"))
    last = [system.simulate(drive, cycles=3, sample_rate="50 Hz").history["x"][-1] for system in (rig, theirs)]
    assert last[0] == pytest.approx(last[1], rel=1e-7)


def test_a_law_that_makes_the_mass_stick(drive):
    @dd.friction_law
    class python_coulomb:
        """Coulomb's law in Python."""

        equation = "F = level sgn v"
        parameters = {"level": dd.parameter("N", "kinetic and static force", at_least=0, is_limit=True)}

        def __init__(self, level):
            self.level = level

        def force(self, now):
            return now.direction * now.limit(self.level)

        def static_limit(self, now):
            return now.limit(self.level)

    small = drive.replace(amplitude="0.03 m")
    ours = dd.System(**RIG, friction=dd.law("python_coulomb", level=2)).steady_state(small)
    theirs = dd.System(**RIG, friction=dd.law("coulomb", kinetic=2)).steady_state(small)
    assert theirs.stops_per_cycle > 0 and len(theirs.sticks) > 0
    assert ours.amplitude == pytest.approx(theirs.amplitude, rel=1e-8)
    assert ours.stops_per_cycle == theirs.stops_per_cycle


def test_values_are_checked():
    dd.friction_law(dahl_class())
    with pytest.raises(dd.InvalidScenario, match="> 0 N"):
        dd.law("python_dahl", limit=-1, stiffness=1)
    with pytest.raises(dd.InvalidScenario, match="the plugin refuses these values: a bias above the limit moves the mass by itself"):
        dd.law("python_dahl", limit=1, stiffness=1, bias=2)


def force(self, now):
    return 0.0


def respond(self, now, states):
    return 0.0, [0.0]


def law_class(name="whole", doc="A law.", **parts):
    return type(name, (), {"__doc__": doc, "equation": "F = 0", **parts})


LEVEL = dd.parameter("N", "a level")


@pytest.mark.parametrize(
    "parts, words",
    [
        ({}, "the class has no function force\\(self, now\\), which a law without states needs"),
        ({"force": 3}, "'force' is no function: 3"),
        ({"states": 1, "respond": respond}, "the class has no function scales\\(self\\)"),
        ({"states": 1, "scales": force}, "the class has no function respond\\(self, now, states\\)"),
        ({"states": 1, "force": force}, "no function scales.*\n.*no function respond"),
        ({"states": 1.5, "force": force}, "'states' is no number of states: 1.5"),
        ({"states": -1, "force": force}, "'states' is no number of states: -1"),
        ({"force": force, "static_limit": 2.0}, "'static_limit' is no function: 2.0"),
        ({"force": force, "doc": None}, "the class has no docstring"),
        ({"force": force, "equation": None}, "the class has no 'equation'"),
        ({"force": force, "equation": 3}, "the 'equation' of the class is no text: 3"),
        ({"force": force, "equation": "F = \ud800"}, "the 'equation' of the class is not one line of printable ASCII"),
        ({"force": force, "sources": 3}, "the 'sources' of the class is no text: 3"),
        ({"force": force, "caution": "a\0b"}, "the 'caution' of the class is not one line of printable ASCII"),
        ({"force": force, "parameters": ["level"]}, "'parameters' is no dict of name and dualdamp.parameter"),
        ({"force": force, "parameters": {"level": "N"}}, "the parameter 'level' is no dualdamp.parameter\\(...\\): 'N'"),
        ({"force": force, "parameters": {3: LEVEL}}, "the name of a parameter is no key of a scenario: 3"),
        ({"force": force, "parameters": {"level": dd.parameter("N", "a\0b")}}, "the meaning of the parameter 'level' is not one line"),
        ({"force": force, "parameters": {"level": dd.parameter("", "a level")}}, "the parameter 'level' has no unit"),
        ({"force": force, "parameters": {"level": LEVEL}}, "__init__ does not take the values of 'parameters'"),
    ],
)
def test_a_class_that_lacks_a_part_of_a_law_is_refused(parts, words):
    with pytest.raises(dd.InvalidScenario, match="error: law 'whole' refused: .*" + words) as caught:
        dd.friction_law(law_class(**parts))
    assert len(caught.value.diagnostics) == str(caught.value).count("error: ") and "whole" not in dd.laws


def test_only_a_class_is_a_law():
    with pytest.raises(TypeError, match="a friction law is a class, not 3"):
        dd.friction_law(3)


def test_parameters_of_laws_are_checked():
    for numbers in ({"above": 1, "at_least": 3}, {"above": 0, "at_least": 0}):
        with pytest.raises(TypeError, match="a parameter has one lower limit"):
            dd.parameter("N", "a level", **numbers)
    for unit, meaning, more, words in [
        (3, "a level", {}, "the unit of a parameter is a text, not 3"),
        ("N", None, {}, "the meaning of a parameter is a text, not None"),
        ("N", "a level", {"at_least": "1"}, "the lower limit of a parameter is a number, not '1'"),
        ("N", "a level", {"at_most": "1"}, "the upper limit of a parameter is a number, not '1'"),
        ("N", "a level", {"default": True}, "the default of a parameter is a number, not True"),
    ]:
        with pytest.raises(TypeError, match=words):
            dd.parameter(unit, meaning, **more)
    with pytest.raises(dd.InvalidScenario, match="has an empty range"):
        dd.friction_law(law_class(force=force, __init__=lambda self, level: None, parameters={"level": dd.parameter("N", "a level", above=1, at_most=0)}))


def test_a_class_whose_name_is_no_name_of_a_law():
    class Capital:
        """A law."""

        equation = "F = 0"
        force = force

    with pytest.raises(dd.InvalidScenario, match="the law's name is no key of a scenario"):
        dd.friction_law(Capital)

    class coulomb:
        """A law."""

        equation = "F = 0"
        force = force

    with pytest.raises(dd.InvalidScenario, match="there is a law 'coulomb' already"):
        dd.friction_law(coulomb)


def test_a_law_is_replaced_by_the_next_of_its_name(drive):
    def define(factor):
        @dd.friction_law
        class changing:
            """A viscous law."""

            equation = "F = factor v"

            def force(self, now):
                return factor * now.v

        return dd.System(**RIG, friction=dd.law("changing")).steady_state(drive).amplitude

    # Viscous damping of 4 N.s/m and as much again, at resonance: x = k Y / (c w).
    assert define(0.0) == pytest.approx(0.25, rel=1e-9)
    assert define(4.0) == pytest.approx(0.125, rel=1e-9)


def test_a_refused_law_does_not_replace_an_earlier_one(drive):
    dd.friction_law(law_class("lasting", force=lambda self, now: 4.0 * now.v))
    level = {"level": dd.parameter("furlong", "a level", default=1.0)}
    with pytest.raises(dd.InvalidScenario, match="a unit that is not known, or not SI"):
        dd.friction_law(law_class("lasting", force=force, parameters=level, __init__=lambda self, level: None))
    assert dd.System(**RIG, friction=dd.law("lasting")).steady_state(drive).amplitude == pytest.approx(0.125, rel=1e-9)


def test_an_exception_of_the_law_is_the_cause(drive):
    @dd.friction_law
    class failing:
        """A law that fails once it is fast."""

        equation = "F = sqrt(1 - v)"

        def force(self, now):
            return math.sqrt(0.5 - now.v)

    said = "law 'failing' of a plugin: respond\\(\\) returned status 1: ValueError: math domain error"
    with pytest.raises(dd.NumericalFailure, match=said) as caught:
        dd.System(**RIG, friction=dd.law("failing")).steady_state(drive)
    assert isinstance(caught.value.__cause__, ValueError)


def failing_class(name, error):
    def force(self, now):
        raise error(name)

    return dd.friction_law(law_class(name, force=force))


def test_the_cause_is_that_of_the_own_thread(drive):
    """Two threads run two laws that fail, each with another exception."""
    errors = {"fail_first": KeyError, "fail_second": LookupError}
    causes = {name: [] for name in errors}

    def work(name):
        system = dd.System(**RIG, friction=dd.law(name))
        for _ in range(150):
            try:
                system.steady_state(drive)
            except dd.NumericalFailure as failure:
                causes[name].append(type(failure.__cause__))

    for name, error in errors.items():
        failing_class(name, error)
    threads = [threading.Thread(target=work, args=(name,)) for name in errors]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert causes == {name: [error] * 150 for name, error in errors.items()}


def test_a_run_inside_a_call_of_another_keeps_the_cause_of_each(drive):
    failing_class("fail_inside", KeyError)
    inside = dd.System(**RIG, friction=dd.law("fail_inside"))
    causes = []

    def force(self, now):
        with pytest.raises(dd.NumericalFailure) as caught:
            inside.steady_state(drive)
        causes.append(type(caught.value.__cause__))
        raise LookupError

    dd.friction_law(law_class("fail_outside", force=force))
    with pytest.raises(dd.NumericalFailure) as caught:
        dd.System(**RIG, friction=dd.law("fail_outside")).steady_state(drive)
    assert causes == [KeyError] and type(caught.value.__cause__) is LookupError


def test_a_law_of_python_is_called_in_one_thread_if_the_number_is_not_stated(drive):
    callers = set()

    def force(self, now):
        callers.add(threading.get_native_id())
        return 2.0 * math.tanh(now.v / 0.05)

    dd.friction_law(law_class("who_calls", force=force))
    system = dd.System(**RIG, friction=dd.law("who_calls"))
    curve = {"excitation": {"type": "base_harmonic", "frequency": "natural"}, "analysis": {"type": "xy_curve", "amplitudes": [0.1, 0.15, 0.2, 0.25]}}
    dd.run({"system": system, **curve})
    dd.run({"system": {**RIG, "friction": {"law": "coulomb", "kinetic": 2}}, **curve}, {"system.friction": {"law": "who_calls"}})
    simulation = {"initial": {"position": 0.1}, "analysis": {"type": "simulate", "duration": 0.2}}
    dd.run({"system": system, **simulation, "sweep": {"system.mass": [1, 2, 3, 4]}})
    assert callers == {threading.get_native_id()}


C_LAW = """
#include <math.h>
#include <stdlib.h>
#include "dualdamp_law.h"
struct law { double level, speed; };
static const struct dualdamp_parameter parameters[] = {
  {"level", "N", "force at high speed", 0.0, INFINITY, 0, 0, 0, 0.0, 1},
  {"speed", "m/s", "width of the step", 0.0, INFINITY, 1, 0, 0, 0.0, 0}};
static int create(const double* values, void** law, char* message, unsigned size) {
  struct law* made = malloc(sizeof *made);
  (void)message; (void)size;
  made->level = values[0]; made->speed = values[1];
  *law = made;
  return 0;
}
static int respond(const void* self, int mode, const double* states, const struct dualdamp_instant* now, double* force, double* rates) {
  const struct law* law = self;
  (void)mode; (void)states; (void)rates;
  *force = dualdamp_limit(now, law->level) * tanh(now->v / law->speed);
  return 0;
}
static const struct dualdamp_law_table table = {
  .size = sizeof table, .abi = DUALDAMP_LAW_ABI, .abilities = DUALDAMP_IS_ODD | DUALDAMP_IS_PASSIVE, .modes = 1,
  .parameter_count = 2, .parameters = parameters, .name = "c_tanh", .version = "1", .summary = "smooth Coulomb friction",
  .equation = "F = level tanh(v/speed)", .create = create, .destroy = free, .respond = respond};
const struct dualdamp_law_table* dualdamp_law(void) { return &table; }
"""


def test_a_law_in_c(drive):
    shutil.which("cc") or pytest.skip("there is no C compiler")
    dd.compile_law(C_LAW)

    @dd.friction_law
    class python_tanh:
        """Smooth Coulomb friction."""

        equation = "F = level tanh(v/speed)"
        parameters = {"level": dd.parameter("N", "force", at_least=0, is_limit=True), "speed": dd.parameter("m/s", "width", above=0)}

        def __init__(self, level, speed):
            self.level, self.speed = level, speed

        def force(self, now):
            return now.limit(self.level) * math.tanh(now.v / self.speed)

    values = {"level": "2 N", "speed": "0.05 m/s"}
    results = [dd.System(**RIG, friction=dd.law(name, **values)).steady_state(drive) for name in ("c_tanh", "python_tanh")]
    assert results[0].amplitude == pytest.approx(results[1].amplitude, rel=1e-12)
    with pytest.raises(RuntimeError, match="error"):
        dd.compile_law("no C\nat all\n")


def test_a_law_that_does_not_compile_or_load_leaves_no_directory(tmp_path, monkeypatch):
    shutil.which("cc") or pytest.skip("there is no C compiler")
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with pytest.raises(RuntimeError):
        dd.compile_law("no C\nat all\n")
    with pytest.raises(OSError):
        dd.compile_law("int x;\n", compiler="/no/compiler")
    with pytest.raises(dd.InvalidScenario):
        dd.compile_law("int no_law;\n")
    with pytest.raises(UnicodeError):
        dd.compile_law("// \ud800\n")
    assert not list(tmp_path.iterdir())


def test_a_plugin_is_known_at_once_although_the_laws_were_listed_before(tmp_path):
    compiler = shutil.which("cc") or pytest.skip("there is no C compiler")
    (tmp_path / "law.c").write_text(C_LAW.replace("c_tanh", "loaded_tanh"))
    subprocess.run([compiler, "-shared", "-fPIC", f"-I{dd.include_directory()}", "law.c", "-lm", "-o", "law.so"], cwd=tmp_path, check=True)
    assert "loaded_tanh" not in dd.laws
    dd.load_plugin(tmp_path / "law.so")
    assert "loaded_tanh" in dd.laws
    assert dd.law("loaded_tanh", level=1, speed=1).level == 1
